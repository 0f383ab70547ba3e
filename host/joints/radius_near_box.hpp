// Radii of the discs that may reach into a box, where discs of all radii lie uniformly in space.
#pragma once

#include <vector>

#include "host/joints/random_stream.hpp"

namespace rockfold {

/// A disc reaches into a box only if its centre lies in the box grown by its radius on each side, of volume
/// V(r) = Π(l + 2r). So the radii of the discs near a box have the density f(r)·V(r), f that of all discs: exactly what
/// drawing centres in unlimited space and leaving out what is too far away would give, for long-tailed f as well.
/// Drawn in ln r by rejection from a bound that is constant on short steps.
class RadiusNearBox {
 public:
  /// f is `radius` on its window; `lengths` (m) of the box. share_in_window(radius) is not small.
  RadiusNearBox(const Distribution& radius, const Vec3& lengths);
  /// No uniform number for a constant; else three a try.
  Real draw(RandomStream& random) const;
  /// m; radii above have a probability below 1e-9.
  Real largest() const { return largest_; }

 private:
  Real density(Real log_radius) const;  // of ln r, to a constant factor
  Real volume(Real radius) const;

  Distribution radius_;
  Vec3 lengths_;
  LogNormal log_normal_{};
  Real mode_ = 0;  // of density()
  Real largest_ = 0;
  Real start_ = 0, step_ = 0;         // of the bound, in ln r
  std::vector<Real> bound_, summed_;  // [steps] of density()·volume(); Σ up to and with each
};

}  // namespace rockfold
