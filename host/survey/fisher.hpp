// Fisher's distribution on the sphere, of poles that point either way. With θ the angle from the mean and κ the concentration,
//
//   p(θ) = κ/(2 sinh κ) exp(κ cos θ) sin θ,   1/κ ≈ the variance (rad²) of a pole's angle along either of two directions.
//
// R. A. Fisher, Dispersion on a sphere, Proc. R. Soc. Lond. A 217, 1953; N. I. Fisher, T. Lewis & B. J. J. Embleton, Statistical
// analysis of spherical data, Cambridge 1987.
#pragma once

#include <span>

#include "src/base/types.hpp"

namespace rockfold {

/// What poles of a set say of it. With weights w and chances c that a pole belongs to the set, N is the effective number
/// (Σ w c)²/Σ w² c (Kish, Survey sampling, 1965): the count of poles that belong surely and weigh alike.
struct FisherStatistics {
  Vec3 mean{};               ///< unit, upward
  Real effective_count = 0;  ///< N
  Real resultant = 0;        ///< R = N |Σ w c x| / Σ w c, all poles turned to the mean's side
  Real kappa = 0;  ///< Fisher's (N − 1)/(N − R); infinite where all coincide, NaN of one
  Real kappa_unbiased =
      0;  ///< (N − 2)/(N − R): 2κ(N − R) is χ² with 2(N − 1) degrees of freedom; NaN of N ≤ 2
  Real confidence_cone =
      0;  ///< deg: about the mean, which holds the true mean in 95 of 100 samples; NaN of one
  Vec3
      eigenvalues{};  ///< of Σ w c x xᵀ / Σ w c, descending, sum 1: a cluster has one, a girdle two large ones
};

/// Of unit vectors of either sign; as many weights > 0, and chances from 0 to 1. The mean is that of the poles turned to its own side, from
/// the principal axis of Σ w c x xᵀ on. Where no pole has a chance all is NaN, and N is 0.
FisherStatistics fisher_statistics(std::span<const Vec3> poles, std::span<const Real> weights,
                                   std::span<const Real> chances);

/// Fisher's cone of confidence in degrees: cos α = 1 − (N − R)/R (p^(−1/(N−1)) − 1), p the chance that the mean lies outside; 180 where
/// the cone is the whole sphere.
Real confidence_cone(Real count, Real resultant, Real outside);

/// deg: the angle about the mean that holds a share of the distribution: cos θ = 1 + ln(1 − share (1 − exp(−2κ)))/κ.
Real cone_of_share(Real kappa, Real share);

/// Fisher's density about an axis, half about each end, over that of uniform poles: κ cosh(κ t)/sinh κ, t the cosine of the angle to it.
Real axial_density(Real kappa, Real t);

/// The κ whose mean resultant length coth κ − 1/κ is `length`, 0 ≤ length < 1: the most likely one.
Real kappa_of_mean_length(Real length);

}  // namespace rockfold
