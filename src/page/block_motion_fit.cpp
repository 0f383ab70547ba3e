#include "src/page/block_motion_fit.hpp"

#include <algorithm>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// m⁻¹ of a symmetric matrix; zero where it is singular (points in a plane).
Mat3 inverse(const Mat3& m) {
  const Vec3 c0 = cross(m[1], m[2]), c1 = cross(m[2], m[0]), c2 = cross(m[0], m[1]);
  const Real determinant = dot(m[0], c0);
  const Real scale = m[0][0] + m[1][1] + m[2][2];
  if (determinant <= 1e-14 * scale * scale * scale) return {};
  const Real f = 1 / determinant;
  return {{{f * c0[0], f * c1[0], f * c2[0]},
           {f * c0[1], f * c1[1], f * c2[1]},
           {f * c0[2], f * c1[2], f * c2[2]}}};
}

Vec3 displacement_at(const std::vector<float>& displacement, Index p) {
  const auto i = 3 * static_cast<std::size_t>(p);
  return {displacement[i], displacement[i + 1], displacement[i + 2]};
}

}  // namespace

std::vector<Vec3> block_middles(const PageSurface& surface) {
  std::vector<Vec3> middle;
  for (std::size_t b = 0; b < surface.block.size(); ++b) {
    Vec3 sum{};
    const Index from = surface.point_begin[b], to = surface.point_begin[b + 1];
    for (Index p = from; p < to; ++p) sum += surface.point[p];
    middle.push_back((1.0 / std::max<Index>(1, to - from)) * sum);
  }
  return middle;
}

FittedMotion fit_block_motions(const PageSurface& surface, const std::vector<Vec3>& middle,
                               const std::vector<float>& displacement) {
  FittedMotion fitted;
  for (std::size_t b = 0; b < surface.block.size(); ++b) {
    const Index from = surface.point_begin[b], to = surface.point_begin[b + 1];
    Vec3 mean{};
    Mat3 xx{}, ux{};
    for (Index p = from; p < to; ++p) {
      const Vec3 x = surface.point[p] - middle[b], u = displacement_at(displacement, p);
      mean += (1.0 / (to - from)) * u;
      for (int i = 0; i < 3; ++i) xx[i] += x[i] * x, ux[i] += u[i] * x;
    }
    const Mat3 inverse_xx = inverse(xx);
    Mat3 gradient{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) gradient[i][j] = dot(ux[i], inverse_xx[j]);
    for (Index p = from; p < to; ++p) {
      const Vec3 x = surface.point[p] - middle[b];
      const Vec3 moved = mean + Vec3{dot(gradient[0], x), dot(gradient[1], x), dot(gradient[2], x)};
      fitted.miss = std::max(fitted.miss, norm(moved - displacement_at(displacement, p)));
    }
    AffineMotion motion{};
    for (int i = 0; i < 3; ++i) {
      motion[i] = static_cast<float>(mean[i]);
      for (int j = 0; j < 3; ++j) motion[3 + 3 * i + j] = static_cast<float>(gradient[i][j]);
    }
    fitted.block.push_back(motion);
  }
  return fitted;
}

}  // namespace rockfold
