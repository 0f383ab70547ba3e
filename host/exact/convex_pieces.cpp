#include "host/exact/convex_pieces.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/partition_2.h>
#include <CGAL/property_map.h>

namespace rockfold {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Kernel::Point_2>;
using PointMap = CGAL::Pointer_property_map<Kernel::Point_2>::const_type;
using Traits = CGAL::Partition_traits_2<Kernel, PointMap>;

bool is_convex(const Points& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (CGAL::orientation(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) == CGAL::RIGHT_TURN)
      return false;
  return true;
}

}  // namespace

std::vector<std::vector<Index>> convex_pieces(const std::vector<std::array<Real, 2>>& polygon) {
  Points points;
  for (const auto& x : polygon) points.emplace_back(x[0], x[1]);
  std::vector<Index> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  if (is_convex(points)) return {all};

  const std::vector<std::size_t> ids(all.begin(), all.end());
  const Traits traits(CGAL::make_property_map(std::as_const(points)));
  std::vector<Traits::Polygon_2> parts;
  CGAL::approx_convex_partition_2(ids.begin(), ids.end(), std::back_inserter(parts), traits);
  std::vector<std::vector<Index>> pieces;
  for (const auto& part : parts) {
    std::vector<Index> piece;
    for (const auto& id : part.container()) piece.push_back(static_cast<Index>(id));
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace rockfold
