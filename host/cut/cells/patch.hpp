// Convex polygons on planes of the table: what cuts cells and names the faces of blocks.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "host/exact/plane_table.hpp"

namespace rockfold {

/// An axis-aligned box; empty until something is put into it.
struct Box {
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  static Box everything() {
    return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
  }
  void add(const Vec3& x) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  }
  void add(const Box& box) { add(box.low), add(box.high); }
  bool meets(const Box& other, Real slack) const {
    for (int d = 0; d < 3; ++d)
      if (low[d] > other.high[d] + slack || other.low[d] > high[d] + slack) return false;
    return true;
  }
};

/// A convex polygon: its plane and the half-spaces of its edges, which only classify and clip. Without edges it is the
/// whole plane.
struct Patch {
  Index plane = none;
  std::vector<HalfSpaceId> edges;
  Box box = Box::everything();      ///< m, about the table's centre
  Box corners = Box::everything();  ///< m, of the corners as given, to the last digit
  /// Circles in the plane about one point, to rounding: the patch holds the inner one and lies in the outer one. Where they decide,
  /// edges need not be asked.
  Vec3 middle{};  ///< m, about the table's centre
  Real inner = 0, outer = Box::infinity;

  bool bounded() const { return !edges.empty(); }
};

/// A part of the boundary of a body.
struct Facet {
  Patch patch;
  HalfSpaceId inside = none;  ///< of the patch's plane, that holds the body
  Index origin = none;        ///< into Complex::origins; none = between two parts of one shape
  Index body = none;          ///< into Complex::bodies
};

/// A convex part of a joint.
struct JointPatch {
  Patch patch;
  Index origin = none;    ///< into Complex::origins
  Index instance = none;  ///< the plane, disc or triangle that it is part of
  Index within = none;    ///< into Model::solids: only inside that solid's shape
};

/// Things on planes, found by plane: those of plane p are item[begin[p]] … item[begin[p + 1] − 1].
struct ByPlane {
  std::vector<Index> begin, item;

  template <class Things>
  static ByPlane sort(const Things& things, Index plane_count) {
    ByPlane result;
    result.begin.assign(static_cast<std::size_t>(plane_count) + 1, 0);
    for (const auto& t : things) ++result.begin[t.patch.plane + 1];
    for (Index p = 0; p < plane_count; ++p) result.begin[p + 1] += result.begin[p];
    result.item.resize(things.size());
    std::vector<Index> next(result.begin.begin(), result.begin.end() - 1);
    for (std::size_t i = 0; i < things.size(); ++i)
      result.item[next[things[i].patch.plane]++] = static_cast<Index>(i);
    return result;
  }
  /// Planes added to the table later carry nothing.
  std::span<const Index> on(Index plane) const {
    if (plane + 1 >= static_cast<Index>(begin.size())) return {};
    return std::span(item).subspan(begin[plane], begin[plane + 1] - begin[plane]);
  }
};

}  // namespace rockfold
