// What must hold in every complex of cells, whatever was cut. In a header, for the tests of several folders.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "host/cut/cells/complex.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

struct ComplexRules {
  /// Through-going joints in convex solids only: cells then meet in whole faces, and the walk around each inner edge,
  /// from cell to cell, comes back to its start after 2π.
  bool whole_faces = false;
  /// Allowed difference between a face's area and the sum of its parts, over L². Rounding of the corners alone gives
  /// some 1e-13; corners identified within the tolerance up to 1e-10 times the face's perimeter.
  Real area_tolerance = 1e-12;
};

class ComplexChecker {
 public:
  ComplexChecker(const Complex& complex, const ComplexRules& rules)
      : complex_(complex), rules_(rules) {}

  std::vector<std::string> run() {
    corner_begin_.push_back(0);
    for (Index c = 0; c < complex_.cells.size(); ++c) {
      corner_begin_.push_back(corner_begin_.back() + complex_.cells[c].corners.size());
      check_cell(c);
    }
    check_parts();
    if (rules_.whole_faces && faults_.empty()) check_walks();
    return std::move(faults_);
  }

 private:
  using HalfEdge =
      std::size_t;  // a corner of the complex: the edge from it to the next one of its face
  static constexpr HalfEdge outside = static_cast<HalfEdge>(-1);

  template <class... Parts>
  void fault(const Parts&... parts) {
    if (faults_.size() >= 20) return;
    std::ostringstream text;
    (text << ... << parts);
    faults_.push_back(text.str());
  }

  void check_cell(Index c) {
    const CellView cell = complex_.cells[c];
    struct Place {
      std::size_t face;
      std::int32_t corner;
    };
    std::map<std::pair<std::int32_t, std::int32_t>, Place> edges;
    face_of_corner_.resize(corner_begin_.back());
    opposite_.resize(corner_begin_.back());
    std::vector<int> uses(cell.vertices.size(), 0);
    for (std::size_t f = 0; f < cell.faces.size(); ++f) {
      const auto& face = cell.faces[f];
      if (face.count < 3) fault("cell ", c, " face ", f, ": ", face.count, " corners");
      for (std::int32_t k = 0; k < face.count; ++k) {
        const std::int32_t u = cell.corners[face.begin + k].vertex,
                           v = cell.corners[face.begin + (k + 1) % face.count].vertex;
        face_of_corner_[corner_begin_[c] + face.begin + k] = {c, static_cast<Index>(f)};
        ++uses[u];
        if (!edges.try_emplace({u, v}, Place{f, face.begin + k}).second)
          fault("cell ", c, ": edge ", u, "→", v, " twice in one sense");
      }
    }
    for (const auto& [ends, place] : edges) {
      const auto back = edges.find({ends.second, ends.first});
      if (back == edges.end()) {
        fault("cell ", c, ": edge ", ends.first, "→", ends.second, " has one face only");
        continue;
      }
      const Place& other = back->second;
      opposite_[corner_begin_[c] + place.corner] = corner_begin_[c] + other.corner;
      if (cell.corners[place.corner].neighbour != cell.faces[other.face].inside)
        fault("cell ", c, ": edge ", ends.first, "→", ends.second, " names half-space ",
              cell.corners[place.corner].neighbour, " and meets ", cell.faces[other.face].inside);
    }
    if (std::count(uses.begin(), uses.end(), 0) > 0) fault("cell ", c, ": a vertex without a face");
    const auto euler = static_cast<std::int64_t>(cell.vertices.size()) -
                       static_cast<std::int64_t>(cell.corners.size() / 2) +
                       static_cast<std::int64_t>(cell.faces.size());
    if (euler != 2) fault("cell ", c, ": V − E + F = ", euler);
    check_convexity(c, cell);
    const Real volume = complex_.moments[c].volume;
    if (complex_.is_sliver[c] != 0 ? !(volume >= 0) : !(volume > 0))
      fault("cell ", c, ": volume ", volume);
  }

  void check_convexity(Index c, const CellView& cell) {
    for (const auto& face : cell.faces) {
      for (const Vertex& v : cell.vertices)
        if (complex_.planes.side(v, plane_of(face.inside)) == (is_above(face.inside) ? -1 : 1))
          fault("cell ", c, ": a vertex on the wrong side of plane ", plane_of(face.inside), " by ",
                complex_.planes.distance(v, plane_of(face.inside)));
      for (const auto& corner : cell.corners.subspan(face.begin, face.count))
        if (complex_.planes.side(cell.vertices[corner.vertex], plane_of(face.inside)) != 0)
          fault("cell ", c, ": a face's corner off its plane ", plane_of(face.inside));
    }
  }

  const ConvexCell::Face& face(Index cell, Index f) const { return complex_.cells[cell].faces[f]; }

  Real area_of(Index cell, Index f) const {
    return polygon_moments(face_polygon(complex_.cells[cell], face(cell, f))).area;
  }
  Real allowed() const {
    return rules_.area_tolerance * complex_.planes.model_size() * complex_.planes.model_size();
  }

  void check_parts() {
    std::vector<Real> covered(complex_.cells.face_begin(complex_.cells.size()), 0);
    const auto cover = [&](Index cell, Index f, Real area) {
      if (!(area >= 0)) fault("cell ", cell, " face ", f, ": a part of area ", area);
      covered[complex_.cells.face_begin(cell) + f] += area;
    };
    for (const Fragment& f : complex_.fragments) {
      const HalfSpaceId below = face(f.cell[0], f.face[0]).inside,
                        above = face(f.cell[1], f.face[1]).inside;
      if (plane_of(below) != plane_of(above) || is_above(below) || !is_above(above))
        fault("cells ", f.cell[0], " and ", f.cell[1], " share an area but lie in half-spaces ",
              below, " and ", above);
      for (int s = 0; s < 2; ++s) {
        cover(f.cell[s], f.face[s], f.area);
        if (rules_.whole_faces && !(std::abs(area_of(f.cell[s], f.face[s]) - f.area) <= allowed()))
          fault("cells ", f.cell[0], " and ", f.cell[1], " share no whole face");
      }
    }
    for (const FreePart& f : complex_.free_parts) {
      cover(f.cell, f.face, f.area);
      if (f.origin == none || complex_.origins[f.origin].kind != FaceOrigin::Kind::solid_face)
        fault("cell ", f.cell, " face ", f.face, ": free, but not on a solid's face");
    }
    for (Index c = 0; c < complex_.cells.size(); ++c) {
      const CellView cell = complex_.cells[c];
      for (std::size_t f = 0; f < cell.faces.size(); ++f) {
        const Real area = area_of(c, static_cast<Index>(f));
        const Real parts = covered[complex_.cells.face_begin(c) + static_cast<std::int64_t>(f)];
        if (!(std::abs(area - parts) <= allowed()))
          fault("cell ", c, " face ", f, ": area ", area, ", its parts ", parts);
      }
    }
  }

  const Vec3& start_of(HalfEdge e) const {
    const CellView cell = complex_.cells[face_of_corner_[e].first];
    return cell.vertices[cell.corners[e - corner_begin_[face_of_corner_[e].first]].vertex].x;
  }

  // The same edge in the cell on the other side of each face, or `outside`.
  void match_across() {
    across_.assign(corner_begin_.back(), outside);
    for (const Fragment& f : complex_.fragments) {
      const auto &a = face(f.cell[0], f.face[0]), &b = face(f.cell[1], f.face[1]);
      if (a.count != b.count) {
        fault("cells ", f.cell[0], " and ", f.cell[1], ": faces of ", a.count, " and ", b.count,
              " corners");
        continue;
      }
      const HalfEdge first_a = corner_begin_[f.cell[0]] + a.begin,
                     first_b = corner_begin_[f.cell[1]] + b.begin;
      // Of slivers' faces all corners may be near to all others: the turn that brings them nearest in all.
      std::int32_t nearest = 0;
      Real least = std::numeric_limits<Real>::infinity();
      for (std::int32_t turn = 0; turn < b.count; ++turn) {
        Real off = 0;
        for (std::int32_t k = 0; k < a.count; ++k)
          off += norm(start_of(first_b + (turn - k + b.count) % b.count) - start_of(first_a + k));
        if (off < least) least = off, nearest = turn;
      }
      for (std::int32_t k = 0; k < a.count; ++k) {
        // a's corner k is b's corner nearest − k; the edge that leaves it in a enters it in b.
        const HalfEdge in_a = first_a + k,
                       in_b = first_b + (nearest - k - 1 + 2 * b.count) % b.count;
        const HalfEdge same_corner = first_b + (nearest - k + b.count) % b.count;
        if (norm(start_of(same_corner) - start_of(in_a)) > complex_.planes.width_tolerance())
          fault("cells ", f.cell[0], " and ", f.cell[1], ": corners of the shared face differ");
        across_[in_a] = in_b;
        across_[in_b] = in_a;
      }
    }
  }

  // Dihedral angle inside the cell at an edge.
  Real angle_at(HalfEdge e) const {
    const auto normal = [&](HalfEdge h) {
      const HalfSpaceId inside = face(face_of_corner_[h].first, face_of_corner_[h].second).inside;
      const Vec3& n = complex_.planes.normal(plane_of(inside));
      return is_above(inside) ? -n : n;
    };
    const Vec3 a = normal(e), b = normal(opposite_[e]);
    return std::numbers::pi - std::atan2(norm(cross(a, b)), dot(a, b));
  }

  // Around each edge: through a face into the next cell, to that cell's other face at the edge, and on.
  void check_walks() {
    match_across();
    for (HalfEdge start = 0; start < across_.size(); ++start) {
      Real turned = 0;
      HalfEdge e = start;
      int steps = 0;
      do {
        turned += angle_at(e);
        e = across_[opposite_[e]];
      } while (e != outside && e != start && ++steps < 1000);
      if (e == outside) continue;  // an edge of the solid
      if (e != start || std::abs(turned - 2 * std::numbers::pi) > 1e-9)
        fault("cell ", face_of_corner_[start].first, ": the walk around an edge turns by ", turned,
              " in ", steps, " steps");
    }
  }

  const Complex& complex_;
  const ComplexRules rules_;
  std::vector<std::string> faults_;
  std::vector<HalfEdge> corner_begin_;                   // [cells + 1]
  std::vector<std::pair<Index, Index>> face_of_corner_;  // cell, face
  std::vector<HalfEdge> opposite_;                       // the reversed edge in the same cell
  std::vector<HalfEdge> across_;  // the reversed edge in the neighbouring cell
};

/// One line for each rule broken (at most 20); empty if the complex is consistent.
///   cells:      every edge has two faces that run it in opposite senses and name each other; V − E + F = 2; no vertex
///               lies outside of a face's plane; positive volume.
///   fragments:  the two faces lie on the two sides of one plane; each face's parts add up to its area.
inline std::vector<std::string> faults_of(const Complex& complex, const ComplexRules& rules = {}) {
  return ComplexChecker(complex, rules).run();
}

}  // namespace rockfold::test
