#include <algorithm>
#include <list>
#include <utility>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/partition_2.h>
#include <CGAL/property_map.h>

#include "host/shapes/convex_pieces_exact.hpp"

namespace rockfold {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_2;
using PointMap = CGAL::Pointer_property_map<Point>::type;
using Traits = CGAL::Partition_traits_2<Kernel, PointMap>;
using Ring = std::vector<std::size_t>;  // corners of the polygon, counter-clockwise

constexpr std::size_t most_corners_optimal = 40;  // some 0.1 s

class Partition {
 public:
  explicit Partition(const ExactPolygon& polygon) {
    for (const auto& p : polygon) points_.emplace_back(Kernel::FT(p[0]), Kernel::FT(p[1]));
  }

  std::vector<ConvexPiece> pieces() {
    const CGAL::Polygon_2<Kernel> polygon(points_.begin(), points_.end());
    if (points_.size() < 3 || !polygon.is_simple()) return {};
    const auto sense = polygon.orientation();
    if (sense == CGAL::COLLINEAR) return {};
    reversed_ = sense == CGAL::CLOCKWISE;
    if (strictly_convex(sense)) {
      ConvexPiece whole;
      for (std::size_t i = 0; i < size(); ++i) whole.push_back(edge(i, (i + 1) % size(), i));
      return {whole};
    }
    std::vector<ConvexPiece> result;
    for (const Ring& ring : partition())
      add_with_one_side_a_line(with_points_on_edges(ring), result);
    return result;
  }

 private:
  std::size_t size() const { return points_.size(); }

  static PieceEdge edge(std::size_t from, std::size_t to, std::size_t side) {
    return {static_cast<Index>(from), static_cast<Index>(to), static_cast<Index>(side)};
  }

  // The polygon's side that runs from one corner to another in counter-clockwise sense.
  Index side_between(std::size_t from, std::size_t to) const {
    if (reversed_) std::swap(from, to);
    return to == (from + 1) % size() ? static_cast<Index>(from) : none;
  }

  CGAL::Orientation turn(std::size_t i, std::size_t j, std::size_t k) const {
    return CGAL::orientation(points_[i], points_[j], points_[k]);
  }

  bool strictly_convex(CGAL::Orientation sense) const {
    for (std::size_t i = 0; i < size(); ++i)
      if (turn(i, (i + 1) % size(), (i + 2) % size()) != sense) return false;
    return true;
  }

  // CGAL's partition of the polygon without its straight corners.
  std::vector<Ring> partition() {
    std::list<std::size_t> ring;
    for (std::size_t i = 0; i < size(); ++i) {
      const std::size_t before = (i + size() - 1) % size();
      if (turn(before, i, (i + 1) % size()) == CGAL::COLLINEAR) continue;
      reversed_ ? ring.push_front(i) : ring.push_back(i);
    }
    const Traits traits(CGAL::make_property_map(points_));
    std::list<Traits::Polygon_2> polygons;
    if (ring.size() <= most_corners_optimal)
      CGAL::optimal_convex_partition_2(ring.begin(), ring.end(), std::back_inserter(polygons),
                                       traits);
    else
      CGAL::approx_convex_partition_2(ring.begin(), ring.end(), std::back_inserter(polygons),
                                      traits);
    std::vector<Ring> rings;
    for (const auto& p : polygons) rings.emplace_back(p.vertices_begin(), p.vertices_end());
    return rings;
  }

  Ring with_points_on_edges(const Ring& ring) const {
    Ring all;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t a = ring[k], b = ring[(k + 1) % ring.size()];
      all.push_back(a);
      if (side_between(a, b) != none) continue;
      Ring between;
      for (std::size_t i = 0; i < size(); ++i)
        if (i != a && i != b &&
            CGAL::collinear_are_strictly_ordered_along_line(points_[a], points_[i], points_[b]) &&
            turn(a, b, i) == CGAL::COLLINEAR)
          between.push_back(i);
      std::sort(between.begin(), between.end(), [&](std::size_t i, std::size_t j) {
        return CGAL::has_smaller_distance_to_point(points_[a], points_[i], points_[j]);
      });
      all.insert(all.end(), between.begin(), between.end());
    }
    return all;
  }

  // Starts the ring at a corner that is not straight.
  void start_at_corner(Ring& ring) const {
    const std::size_t n = ring.size();
    for (std::size_t k = 0; k < n; ++k)
      if (turn(ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]) != CGAL::COLLINEAR) {
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(k), ring.end());
        return;
      }
  }

  // Where two sides of the polygon lie on one line of the piece it is cut from the corner between them.
  void add_with_one_side_a_line(Ring ring, std::vector<ConvexPiece>& result) const {
    start_at_corner(ring);
    const std::size_t n = ring.size();
    ConvexPiece piece;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t a = ring[k], b = ring[(k + 1) % n];
      const PieceEdge e{static_cast<Index>(a), static_cast<Index>(b), side_between(a, b)};
      const bool goes_on = k > 0 && turn(ring[k - 1], a, b) == CGAL::COLLINEAR;
      if (!goes_on) {
        piece.push_back(e);
      } else if (piece.back().side == none) {
        piece.back() = e;
      } else if (e.side != none) {
        return split(ring, k, result);
      }
    }
    result.push_back(std::move(piece));
  }

  // Cuts the ring from its straight corner k to one off that line.
  void split(const Ring& ring, std::size_t k, std::vector<ConvexPiece>& result) const {
    const std::size_t n = ring.size();
    Ring opposite;
    for (std::size_t j = 2; j + 1 < n; ++j)
      if (turn(ring[k - 1], ring[k], ring[(k + j) % n]) != CGAL::COLLINEAR) opposite.push_back(j);
    const std::size_t reach = opposite[opposite.size() / 2];
    Ring first, second;
    for (std::size_t j = 0; j <= reach; ++j) first.push_back(ring[(k + j) % n]);
    for (std::size_t j = reach; j <= n; ++j) second.push_back(ring[(k + j) % n]);
    add_with_one_side_a_line(std::move(first), result);
    add_with_one_side_a_line(std::move(second), result);
  }

  std::vector<Point> points_;
  bool reversed_ = false;
};

}  // namespace

std::vector<ConvexPiece> convex_pieces(const ExactPolygon& polygon) {
  return Partition(polygon).pieces();
}

}  // namespace rockfold
