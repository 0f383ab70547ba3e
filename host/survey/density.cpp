#include "host/survey/density.hpp"

#include <utility>

#include "host/survey/fisher.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

PoleDensity::PoleDensity(std::vector<Vec3> poles, std::vector<Real> weights)
    : poles_(std::move(poles)), weights_(std::move(weights)) {
  Real sum = 0, squares = 0;
  for (const Real w : weights_) sum += w, squares += w * w;
  for (Real& w : weights_) w /= sum;
  constexpr Real deviations = 3;
  kappa_ = poles_.empty() ? 0 : 2 * (1 + sum * sum / squares / (deviations * deviations));
}

Real PoleDensity::at(const Vec3& direction) const {
  Real density = 0;
  for (std::size_t i = 0; i < poles_.size(); ++i)
    density += weights_[i] * axial_density(kappa_, dot(poles_[i], direction));
  return density;
}

}  // namespace rockfold
