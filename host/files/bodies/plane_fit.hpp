// The plane nearest to points, by least squares, one point after another.
#pragma once

#include <array>

#include "src/base/types.hpp"

namespace rockfold {

struct FittedPlane {
  Vec3 centre{}, normal{};  ///< m; unit, of either sense

  Real above(const Vec3& x) const {
    return normal[0] * (x[0] - centre[0]) + normal[1] * (x[1] - centre[1]) +
           normal[2] * (x[2] - centre[2]);
  }
};

/// Moments of points about `origin`, which lies among them, so that far coordinates cost no digits.
class PlaneFit {
 public:
  explicit PlaneFit(const Vec3& origin) : origin_(origin) {}
  void add(const Vec3& x);
  /// Through the mean of the points, along the two directions in which they spread most.
  FittedPlane plane() const;

 private:
  Vec3 origin_, sum_{};
  std::array<Real, 6> square_{};  ///< xx, yy, zz, xy, xz, yz
  Real count_ = 0;
};

}  // namespace rockfold
