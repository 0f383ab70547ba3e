#include "host/files/bodies/plane_fit.hpp"

#include <Eigen/Eigenvalues>

#include "src/base/vector.hpp"

namespace rockfold {

void PlaneFit::add(const Vec3& x) {
  const Vec3 y = x - origin_;
  sum_ += y;
  square_[0] += y[0] * y[0], square_[1] += y[1] * y[1], square_[2] += y[2] * y[2];
  square_[3] += y[0] * y[1], square_[4] += y[0] * y[2], square_[5] += y[1] * y[2];
  count_ += 1;
}

FittedPlane PlaneFit::plane() const {
  const Vec3 mean = (1 / count_) * sum_;
  Eigen::Matrix3d spread;
  spread << square_[0], square_[3], square_[4],  //
      square_[3], square_[1], square_[5],        //
      square_[4], square_[5], square_[2];
  const Eigen::Vector3d m(mean[0], mean[1], mean[2]);
  spread -= count_ * m * m.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const auto n = axes.eigenvectors().col(0);
  return {origin_ + mean, {n[0], n[1], n[2]}};
}

}  // namespace rockfold
