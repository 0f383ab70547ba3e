#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include "host/files/meshes/mesh_surface.hpp"

namespace rockfold {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using SizeT = std::size_t;

/// Intersections are looked for until so many have been found.
constexpr unsigned most_intersections = 1000;

/// Side i of triangle t, from its corner i to the next, has the number 3t + i.
struct Side {
  Index low = 0, high = 0;  ///< its vertices
  Index number = 0;
  bool ascending = false;  ///< runs from low to high
};

std::vector<Side> sorted_sides(const TriangleSurface& surface) {
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (const auto& triangle : surface.triangles)
    for (SizeT i = 0; i < 3; ++i) {
      const Index a = triangle[i], b = triangle[(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(sides.size()), a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.number) < std::tie(b.low, b.high, b.number);
  });
  return sides;
}

/// A kind of fault: how often it was found, and where first.
struct Found {
  SizeT count = 0;
  int line = 0;
  std::string where;

  void add(int at_line, const std::string& place) {
    if (count++ > 0) return;
    line = at_line;
    where = place;
  }
};

class SolidCheck {
 public:
  SolidCheck(const MeshTriangles& mesh, Faults& faults, MeshHint hint)
      : mesh_(mesh), surface_(mesh.surface), faults_(faults), hint_(hint) {}

  void run() {
    pair_sides();
    find_touching_vertices();
    build_mesh();
    find_intersections();
    find_inverted_shells();
  }

 private:
  /// Behind what several bodies in one look like.
  const char* hint() const {
    switch (hint_) {
      case MeshHint::nothing:
        break;
      case MeshHint::may_be_bodies:
        return "; if these are several bodies: bodies = \"separate\"";
      case MeshHint::bodies_share_corners:
        return "; bodies that share corners need a line `o` each, or corners of their own";
    }
    return "";
  }
  std::string point(Index v) const { return point_text(surface_.vertices[static_cast<SizeT>(v)]); }
  int line_of(Index side) const { return mesh_.line[static_cast<SizeT>(side / 3)]; }
  std::string edge_text(const Side& side) const {
    return fmt::format("from {} to {}", point(side.low), point(side.high));
  }

  /// Fills opposite_: each side must have one partner of the opposite sense.
  void pair_sides() {
    const auto sides = sorted_sides(surface_);
    opposite_.assign(sides.size(), none);
    Found open, crowded, clashing;
    for (SizeT begin = 0, end = 0; begin < sides.size(); begin = end) {
      const Side& first = sides[begin];
      while (end < sides.size() && sides[end].low == first.low && sides[end].high == first.high)
        ++end;
      const int line = line_of(first.number);
      if (end - begin == 1) {
        open.add(line, edge_text(first));
      } else if (end - begin > 2) {
        crowded.add(line, fmt::format("{} ({} triangles)", edge_text(first), end - begin));
      } else if (first.ascending == sides[begin + 1].ascending) {
        clashing.add(line, edge_text(first));
      } else {
        opposite_[static_cast<SizeT>(first.number)] = sides[begin + 1].number;
        opposite_[static_cast<SizeT>(sides[begin + 1].number)] = first.number;
      }
    }
    if (open.count > 0)
      faults_.add(open.line, 0,
                  fmt::format("the surface of a solid must be closed: it has {}, the first {}",
                              counted(open.count, "open edge"), open.where));
    if (crowded.count > 0)
      faults_.add(
          crowded.line, 0,
          fmt::format("two triangles of a solid's surface must meet at each edge: more do at "
                      "{}, the first {}{}",
                      counted(crowded.count, "edge"), crowded.where, hint()));
    if (clashing.count > 0)
      faults_.add(clashing.line, 0,
                  fmt::format("neighbouring triangles must be oriented alike (counter-clockwise "
                              "from outside): they are not at {}, the first {}",
                              counted(clashing.count, "edge"), clashing.where));
    faults_.throw_if_any();
  }

  /// The triangles at a vertex must form one fan.
  void find_touching_vertices() {
    std::vector<bool> visited(opposite_.size(), false);
    std::vector<bool> has_fan(surface_.vertices.size(), false);
    Found touching;
    for (SizeT start = 0; start < opposite_.size(); ++start) {
      if (visited[start]) continue;
      const Index v = surface_.triangles[start / 3][start % 3];
      if (has_fan[static_cast<SizeT>(v)])
        touching.add(line_of(static_cast<Index>(start)), point(v));
      has_fan[static_cast<SizeT>(v)] = true;
      for (SizeT side = start; !visited[side];) {
        visited[side] = true;
        const SizeT before = side - side % 3 + (side % 3 + 2) % 3;
        side = static_cast<SizeT>(opposite_[before]);
      }
    }
    if (touching.count == 0) return;
    faults_.fail(touching.line, 0,
                 fmt::format("the surface of a solid must not touch itself: it does at {}, the "
                             "first {}",
                             counted(touching.count, "point"), touching.where));
  }

  void build_mesh() {
    for (const auto& p : surface_.vertices) cgal_.add_vertex({p[0], p[1], p[2]});
    for (const auto& [a, b, c] : surface_.triangles)
      cgal_.add_face(CGAL::SM_Vertex_index(static_cast<unsigned>(a)),
                     CGAL::SM_Vertex_index(static_cast<unsigned>(b)),
                     CGAL::SM_Vertex_index(static_cast<unsigned>(c)));
    if (cgal_.number_of_faces() != surface_.triangles.size())
      faults_.fail("the surface of a solid must be a closed manifold");
  }

  std::string triangle_text(SizeT t) const {
    const auto& [a, b, c] = surface_.triangles[t];
    return fmt::format("{} {} {}", point(a), point(b), point(c));
  }

  void find_intersections() {
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    pmp::self_intersections(cgal_, std::back_inserter(pairs),
                            CGAL::parameters::maximum_number(most_intersections));
    if (pairs.empty()) return;
    for (auto& [a, b] : pairs)
      if (b < a) std::swap(a, b);
    const auto [a, b] = *std::min_element(pairs.begin(), pairs.end());
    faults_.fail(mesh_.line[a], 0,
                 fmt::format("the surface of a solid must not intersect itself: {}{} of triangles "
                             "do, the first {} and {}{}",
                             counted(pairs.size(), "pair"),
                             pairs.size() == most_intersections ? " or more" : "", triangle_text(a),
                             triangle_text(b), hint()));
  }

  void find_inverted_shells() {
    auto shell = cgal_.add_property_map<Mesh::Face_index, SizeT>("f:shell").first;
    auto volume = cgal_.add_property_map<Mesh::Face_index, SizeT>("f:volume").first;
    std::vector<SizeT> depth;
    std::vector<bool> outward;
    pmp::volume_connected_components(cgal_, volume,
                                     CGAL::parameters::do_orientation_tests(true)
                                         .nesting_levels(std::ref(depth))
                                         .is_cc_outward_oriented(std::ref(outward))
                                         .face_connected_component_map(shell));
    depth.resize(outward.size(), 0);  // empty for one shell
    std::vector<bool> told(outward.size(), false);
    Found outer, inner;
    for (const auto face : cgal_.faces()) {
      const SizeT s = shell[face];
      const bool is_cavity = depth[s] % 2 == 1;
      if (told[s] || outward[s] != is_cavity) continue;
      told[s] = true;
      (is_cavity ? inner : outer).add(mesh_.line[face], point(surface_.triangles[face][0]));
    }
    if (outer.count > 0)
      faults_.add(outer.line, 0,
                  fmt::format("the triangles of a solid must be counter-clockwise seen from "
                              "outside: {} of {} inside out, the first with the corner {}",
                              counted(outer.count, "part"), outward.size(), outer.where));
    if (inner.count > 0)
      faults_.add(inner.line, 0,
                  fmt::format("the triangles of a cavity must be counter-clockwise seen from "
                              "within it: {} of {} the other way round, the first with the corner "
                              "{}",
                              counted(inner.count, "part"), outward.size(), inner.where));
    faults_.throw_if_any();
  }

  const MeshTriangles& mesh_;
  const TriangleSurface& surface_;
  Faults& faults_;
  MeshHint hint_;
  std::vector<Index> opposite_;  ///< [sides] the side of the neighbour
  Mesh cgal_;
};

}  // namespace

void check_solid(const MeshTriangles& mesh, Faults& faults, MeshHint hint) {
  SolidCheck(mesh, faults, hint).run();
}

}  // namespace rockfold
