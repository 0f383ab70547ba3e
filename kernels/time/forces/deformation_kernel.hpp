// How the rock answers to its deformation: all that small and large kinematics do not share.
#pragma once

#include <memory>

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/finite/deformation_kernel.hpp"
#include "kernels/operator/elements/sampled_elements_kernel.hpp"
#include "kernels/time/motion.hpp"

namespace rockfold {

struct TrackedPoints::Data {
  solve::DevicePoints points;
  device::Array<Index> element;
  device::Field local;         ///< m, from the centre of the element's lattice cell
  device::Field value;         ///< work space
  device::Array<Real> stress;  ///< [N][6] work space
};

namespace motion {

using device::Array;
using device::Field;

class Deformation {
 public:
  Deformation() = default;
  virtual ~Deformation() = default;
  Deformation(const Deformation&) = delete;
  Deformation& operator=(const Deformation&) = delete;

  /// Whether the force is linear in d up to a constant: then one solve makes a step.
  virtual bool linear() const = 0;
  /// f(d): the internal force of the displacement d, that of the initial stress included, N.
  virtual void force(const Field& d, const Field& f) const = 0;
  /// Takes the tangent at d from here on.
  virtual void linearise(const Field& d) = 0;
  /// y = (α ∂f/∂d + β M) x and its diagonal blocks.
  virtual void apply(const solve::Combination& c, const Field& x, const Field& y) const = 0;
  virtual void diagonal(const solve::Combination& c, const solve::Blocks& d) const = 0;
  /// J stored by the displacement d, 0 in place.
  virtual Real energy(const Field& d) const = 0;
  /// N: what rounding alone leaves of balanced forces at d.
  virtual Real rounding(const Field& d) const = 0;

  // Where the force is not linear:

  /// A step starts from d; its forces and tangents follow `rule`.
  virtual void begin_step(const Field& /*d*/, const finite::ForceRule& /*rule*/) {}
  /// After begin_step: what the strain rate that damps takes from the rates at the step's start (finite::carry_rate).
  virtual void carry_rate(const Field& /*velocity*/, Real /*of_velocity*/,
                          const Field& /*acceleration*/, Real /*of_acceleration*/) {}
  /// Elements of this step have `factor` · viscosity(e) more (finite::ForceRule::stiffening); viscosity(e) is that of viscous_work.
  virtual void stiffen(const Array<Real>& /*viscosity*/, Real /*factor*/) {}
  /// J that this viscosity takes in the step that ends at d (finite::viscous_work).
  virtual Real viscous_work(const Field& /*d*/, Real /*viscosity*/) const { return 0; }
  /// Takes the tangent of the last linearise() again without the part of the stress, which compression may make negative.
  virtual void drop_geometric_stiffness() {}
  /// Turns a correction to the end of the step, where forces are taken in its middle.
  virtual void turn(const Field& /*x*/) const {}
  /// Finite strain as it is on the device; null: there is none.
  virtual const finite::Deformation* finite_strain() const { return nullptr; }
  /// An element that d turns inside out, or none; those whose forces at a strain of 1 are below `least`, N, do not count.
  virtual Index inverted(const Field& /*d*/, Real /*least*/) const { return none; }

  /// [elements][6] Pa, the mean of each element.
  virtual void element_stress(const Field& d, const Array<Real>& stress) const = 0;
  /// Writes at.stress.
  virtual void point_stress(const Field& d, const TrackedPoints::Data& at) const = 0;
};

/// The slopes of all functions at the points; `sampled`: null but for covers whose elements differ in their functions, which the host evaluates.
inline solve::PointSlopes sampled_slopes_at(const CoverArrays* sampled,
                                            const TrackedPoints::Data& at) {
  if (sampled == nullptr) return {};
  return solve::sampled_slopes(*sampled, device::to_host(at.element),
                               device::copy_to_host(at.local));
}

std::unique_ptr<Deformation> make_small_strain(const MotionSetup& setup,
                                               const solve::ConstrainedSystem& system);
std::unique_ptr<Deformation> make_finite_strain(const MotionSetup& setup,
                                                const solve::ConstrainedSystem& system);

}  // namespace motion
}  // namespace rockfold
