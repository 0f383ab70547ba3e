// What large kinematics add to a deformation.
#pragma once

#include "kernels/finite/deformation_kernel.hpp"
#include "kernels/update/deformation_kernel.hpp"

namespace rockfold::update {

class LargeDeformation : public Deformation {
 public:
  /// A step starts from d; its forces and tangents follow `rule`.
  virtual void begin_step(const Field& d, const finite::ForceRule& rule) = 0;
  /// After begin_step: what the strain rate that damps takes from the rates at the step's start (finite::carry_rate).
  virtual void carry_rate(const Field& velocity, Real of_velocity, const Field& acceleration,
                          Real of_acceleration) = 0;
  /// J that this viscosity takes in the step that ends at d (finite::viscous_work).
  virtual Real viscous_work(const Field& d, Real viscosity) const = 0;
  /// Takes the tangent of the last linearise() again without the part of the stress, which compression may make negative.
  virtual void soften() = 0;
  /// Turns a correction to the end of the step, where forces are taken in its middle.
  virtual void turn(const Field& x) const = 0;
  /// An element that d turns inside out, or none; those whose forces at a strain of 1 are below `least`, N, do not count.
  virtual Index inverted(const Field& d, Real least) const = 0;
  /// Sizes of the terms of ∂u/∂X, which cancel where idle motion (idle_motion.cpp) has grown: rounding grows with them.
  virtual Real largest_terms(const Field& d) const = 0;
};

std::unique_ptr<LargeDeformation> make_finite_strain(const MotionSetup& setup,
                                                     const solve::HeldSystem& held);

}  // namespace rockfold::update
