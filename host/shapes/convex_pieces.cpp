#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "host/shapes/convex_pieces_exact.hpp"
#include "host/shapes/triangles_inside_exact.hpp"

namespace rockfold {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Ring = std::vector<Index>;  // corners of the polygon, counter-clockwise

// Of the angle by which a corner turns. Planes closer than the first are one (decision 5, rule 2), and then the second of
// two edges would lose its name; corners flatter than the second are not made where there is a choice.
constexpr Real least_sine = 1e-10, good_sine = 1e-7;

class Partition {
 public:
  explicit Partition(const ExactPolygon& polygon) {
    for (const auto& p : polygon) {
      points_.emplace_back(Kernel::FT(p[0]), Kernel::FT(p[1]));
      near_.push_back({CGAL::to_double(Exact(p[0] - polygon[0][0])),
                       CGAL::to_double(Exact(p[1] - polygon[0][1]))});
    }
  }

  std::vector<ConvexPiece> pieces() {
    const CGAL::Polygon_2<Kernel> polygon(points_.begin(), points_.end());
    if (points_.size() < 3 || !polygon.is_simple()) return {};
    const auto sense = polygon.orientation();
    if (sense == CGAL::COLLINEAR) return {};
    reversed_ = sense == CGAL::CLOCKWISE;
    if (convex(sense)) {
      ConvexPiece whole;
      for (Index i = 0; i < size(); ++i) whole.push_back({i, after(i), i});
      return {whole};
    }
    triangulate();
    merge();
    std::vector<ConvexPiece> result;
    for (const Ring& ring : rings_) {
      if (ring.empty()) continue;
      ConvexPiece& piece = result.emplace_back();
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Index a = ring[k], b = ring[(k + 1) % ring.size()];
        piece.push_back({a, b, side_between(a, b)});
      }
    }
    return result;
  }

 private:
  Index size() const { return static_cast<Index>(points_.size()); }
  Index after(Index i) const { return i + 1 < size() ? i + 1 : 0; }

  // The polygon's side that runs from one corner to another in counter-clockwise sense.
  Index side_between(Index from, Index to) const {
    if (reversed_) std::swap(from, to);
    return to == after(from) ? from : none;
  }

  bool turns(Index i, Index j, Index k, CGAL::Orientation sense, Real sine) const {
    const auto &p = near_[i], &q = near_[j], &r = near_[k];
    const Real ax = q[0] - p[0], ay = q[1] - p[1], bx = r[0] - q[0], by = r[1] - q[1];
    return CGAL::orientation(points_[i], points_[j], points_[k]) == sense &&
           std::abs(ax * by - ay * bx) > sine * std::hypot(ax, ay) * std::hypot(bx, by);
  }

  bool convex(CGAL::Orientation sense) const {
    for (Index i = 0; i < size(); ++i)
      if (!turns(i, after(i), after(after(i)), sense, least_sine)) return false;
    return true;
  }

  void triangulate() {
    OutlineTriangulation<Kernel> plan;
    std::vector<OutlineTriangulation<Kernel>::Vertex_handle> handle;
    for (Index i = 0; i < size(); ++i) {
      handle.push_back(plan.insert(points_[i]));
      handle.back()->info() = i;
    }
    for (Index i = 0; i < size(); ++i) plan.insert_constraint(handle[i], handle[after(i)]);
    for (const auto& t : triangles_inside(plan)) rings_.emplace_back(t.begin(), t.end());
  }

  // Takes diagonals away, the longest first, where both corners stay convex.
  void merge() {
    struct Diagonal {
      Index a, b;
      Real length;
    };
    std::map<std::pair<Index, Index>, std::size_t> ring_of;  // directed edge → the ring to its left
    std::vector<Diagonal> diagonals;
    for (std::size_t r = 0; r < rings_.size(); ++r)
      for (int k = 0; k < 3; ++k) {
        const Index a = rings_[r][k], b = rings_[r][(k + 1) % 3];
        ring_of[{a, b}] = r;
        if (a < b && side_between(a, b) == none && side_between(b, a) == none)
          diagonals.push_back(
              {a, b, std::hypot(near_[a][0] - near_[b][0], near_[a][1] - near_[b][1])});
      }
    std::sort(diagonals.begin(), diagonals.end(), [](const Diagonal& d, const Diagonal& e) {
      return d.length != e.length ? d.length > e.length : std::pair(d.a, d.b) < std::pair(e.a, e.b);
    });
    for (const Diagonal& d : diagonals) {
      const std::size_t left = ring_of.at({d.a, d.b}), right = ring_of.at({d.b, d.a});
      // Both from b on, once around to a: the merged ring is one after the other.
      Ring first = rings_[left], second = rings_[right];
      std::rotate(first.begin(), std::find(first.begin(), first.end(), d.b), first.end());
      std::rotate(second.begin(), std::find(second.begin(), second.end(), d.a), second.end());
      const bool at_a = turns(first[first.size() - 2], d.a, second[1], CGAL::LEFT_TURN, good_sine);
      const bool at_b = turns(second[second.size() - 2], d.b, first[1], CGAL::LEFT_TURN, good_sine);
      if (!at_a || !at_b) continue;
      first.insert(first.end(), second.begin() + 1, second.end() - 1);
      for (std::size_t k = 0; k < second.size(); ++k)
        ring_of[{second[k], second[(k + 1) % second.size()]}] = left;
      rings_[left] = std::move(first);
      rings_[right].clear();
    }
  }

  std::vector<Kernel::Point_2> points_;
  std::vector<std::array<Real, 2>> near_;  // relative to the first point
  bool reversed_ = false;
  std::vector<Ring> rings_;
};

}  // namespace

std::vector<ConvexPiece> convex_pieces(const ExactPolygon& polygon) {
  return Partition(polygon).pieces();
}

}  // namespace rockfold
