// How densely poles lie on the sphere.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// In multiples of the density of as many uniform poles, which is also per cent of the poles per per cent of the hemisphere: each pole spread
/// out as Fisher's distribution with κ = 2 (1 + N/9), N the effective number. That is Kamb's count (J. Geophys. Res. 64, 1959) at 3σ, where
/// the circle is so large that a uniform density makes a count of three times its deviation, smoothed (Vollmer, Comput. Geosci. 21, 1995).
class PoleDensity {
 public:
  /// Unit vectors of either sign; as many weights > 0.
  PoleDensity(std::vector<Vec3> poles, std::vector<Real> weights);

  /// At a unit direction, the same at its opposite.
  Real at(const Vec3& direction) const;
  Real kappa() const { return kappa_; }

 private:
  std::vector<Vec3> poles_;
  std::vector<Real> weights_;  ///< their sum is 1
  Real kappa_ = 0;
};

}  // namespace rockfold
