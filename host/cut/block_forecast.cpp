#include "host/cut/block_forecast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real draws = 200'000;
constexpr Real parallel = 1e-9;  // sine of the angle under which two planes meet nowhere near

bool holds(const Box& box, const Vec3& x) {
  for (int d = 0; d < 3; ++d)
    if (x[d] < box.low[d] || x[d] > box.high[d]) return false;
  return true;
}

class Forecast {
 public:
  Forecast(const std::vector<ForecastJoint>& joints, const std::vector<ForecastRegion>& regions)
      : joints_(joints), regions_(regions) {}

  Real blocks() {
    const auto n = static_cast<Real>(joints_.size());
    Real count = 1;
    for (const ForecastJoint& joint : joints_) count += std::isinf(joint.radius);
    count += counted(2, n * (n - 1) / 2, [&](const auto& i) { return meets_along(i[0], i[1]); });
    count += counted(3, n * (n - 1) * (n - 2) / 6,
                     [&](const auto& i) { return share_at(i[0], i[1], i[2]); });
    return count;
  }

 private:
  using Choice = std::array<std::size_t, 3>;

  /// The sum of `of` over all choices of `k` joints, of which there are `all`.
  template <class Of>
  Real counted(int k, Real all, const Of& of) {
    if (all < 1) return 0;
    if (all <= draws) return sum_over_all(k, of);
    std::mt19937_64 random(1);
    const std::size_t n = joints_.size();
    Real sum = 0;
    for (int draw = 0; draw < static_cast<int>(draws); ++draw) {
      Choice i{};
      for (int d = 0; d < k; ++d) i[d] = random() % n;
      if (i[0] == i[1] || (k == 3 && (i[0] == i[2] || i[1] == i[2]))) continue;
      sum += of(i);
    }
    // Choices with a joint twice are none: all k-tuples are n^k, k! of which are one choice.
    const Real per_draw = std::pow(static_cast<Real>(n), k) / (k == 2 ? 2 : 6) / draws;
    return std::max(0.0, sum - 2 * std::sqrt(sum)) * per_draw;
  }

  template <class Of>
  Real sum_over_all(int k, const Of& of) const {
    Real sum = 0;
    const std::size_t n = joints_.size();
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b) {
        if (k == 2) sum += of(Choice{a, b, 0});
        for (std::size_t c = b + 1; k == 3 && c < n; ++c) sum += of(Choice{a, b, c});
      }
    return sum;
  }

  /// 1 if two through-going planes meet in the rock's box: the part of their line in it.
  Real meets_along(std::size_t i, std::size_t j) const {
    const ForecastJoint &a = joints_[i], &b = joints_[j];
    if (std::isfinite(a.radius) || std::isfinite(b.radius)) return 0;
    const Vec3 along = cross(a.normal, b.normal);
    const Real sine2 = dot(along, along);
    if (sine2 < parallel * parallel) return 0;
    const Vec3 point =
        (1 / sine2) * (a.offset * cross(b.normal, along) + b.offset * cross(along, a.normal));
    Real from = -Box::infinity, to = Box::infinity;
    for (const std::size_t region : {a.region, b.region})
      for (int d = 0; d < 3; ++d) {
        const Box& box = regions_[region].box;
        if (std::abs(along[d]) < parallel) {
          if (point[d] < box.low[d] || point[d] > box.high[d]) return 0;
          continue;
        }
        const Real low = (box.low[d] - point[d]) / along[d],
                   high = (box.high[d] - point[d]) / along[d];
        from = std::max(from, std::min(low, high));
        to = std::min(to, std::max(low, high));
      }
    return from < to ? 1 : 0;
  }

  /// Of the least of the three regions: the share of its box that rock fills, if the joints meet in the boxes of all.
  Real share_at(std::size_t i, std::size_t j, std::size_t k) const {
    const ForecastJoint &a = joints_[i], &b = joints_[j], &c = joints_[k];
    const Vec3 bc = cross(b.normal, c.normal);
    const Real det = dot(a.normal, bc);
    if (std::abs(det) < parallel) return 0;
    const Vec3 x = (1 / det) * (a.offset * bc + b.offset * cross(c.normal, a.normal) +
                                c.offset * cross(a.normal, b.normal));
    Real share = 1;
    for (const ForecastJoint* joint : {&a, &b, &c}) {
      const ForecastRegion& region = regions_[joint->region];
      if (!holds(region.box, x)) return 0;
      if (std::isfinite(joint->radius) && norm(x - joint->middle) > joint->radius) return 0;
      const Vec3 size = region.box.high - region.box.low;
      share = std::min(share, region.volume / (size[0] * size[1] * size[2]));
    }
    return share;
  }

  const std::vector<ForecastJoint>& joints_;
  const std::vector<ForecastRegion>& regions_;
};

}  // namespace

Real forecast_blocks(const std::vector<ForecastJoint>& joints,
                     const std::vector<ForecastRegion>& regions) {
  return Forecast(joints, regions).blocks();
}

}  // namespace rockfold
