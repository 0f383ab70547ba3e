// What acts on the rock from outside, on the device: loads, dashpots, and where supports ought to be.
#pragma once

#include <functional>

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/time/motion.hpp"

namespace rockfold::motion {

using device::Array;
using device::Field;

/// The points at which `wanted` says yes.
MaterialPoints choose_points(const MaterialPoints& all,
                             const std::function<bool(std::size_t)>& wanted);
/// Whether a pressure acts on a load point; under large kinematics it follows its face (following.cpp).
bool under_pressure(const LoadPoints& loads, std::size_t n);

/// The values of tables at one time, side by side.
class DeviceTables {
 public:
  DeviceTables() = default;
  explicit DeviceTables(std::vector<TimeTable> tables);
  bool any() const { return !tables_.empty(); }
  /// [tables][3] at t, or the slopes after t.
  Array<Real> at(Real t) const;
  Array<Real> slope_after(Real t) const;
  /// At t; before `start` as if they had always moved as they do just after it.
  Array<Real> at_or_before(Real t, Real start) const;
  /// Whether one of them moves just after t.
  bool moving_after(Real t) const;

 private:
  std::vector<TimeTable> tables_;
};

/// Forces that change in time: of points with a table, and of the accelerated base.
struct VaryingLoads {
  solve::PointRows points;
  Array<Index> table;
  Array<Real> scale;  ///< force = scale · table …
  Field by_x;         ///< … + by_x · the table's x component: pressures
  Field force;        ///< of the points, work space
  DeviceTables tables;
  TimeTable base;
  Field mass;  ///< M 1, where the base is accelerated
  bool any() const { return points.any() || !base.empty(); }
};
VaryingLoads make_varying_loads(const MotionSetup& setup, const Field& mass);
/// f = the loads at t, N.
void varying_load(const VaryingLoads& loads, Real t, const Field& f);

/// The loads that do not change: gravity (`mass` is M 1), forces and pressures without a table.
std::vector<Vec3> constant_load(const MotionSetup& setup, const std::vector<Vec3>& mass);

/// C of quiet boundaries: N^T (c_n n nᵀ + c_s (I − n nᵀ)) N.
struct Dashpots {
  solve::PointRows points;
  Field normal;
  Array<Real> normal_damping, shear_damping;
  Field force;  ///< work space
  bool any() const { return points.any(); }
};
Dashpots make_dashpots(const QuietPoints& quiet, Index unknowns);
/// y += factor · C x.
void add_dashpots(const Dashpots& dashpots, Real factor, const Field& x, const Field& y);
/// factor · C as tangents of the points of `terms` from `first` on.
void set_tangents(const Dashpots& dashpots, Real factor, const solve::PointTerms& terms,
                  Index first);

/// Tables of fixed points: which each follows.
struct MovingSupports {
  DeviceTables tables;
  Array<Index> table;  ///< [merged points] or none
};
MovingSupports make_moving_supports(const FixedPoints& fixed,
                                    const solve::ConstrainedSystem& system);
/// Sets the targets of the springs at t.
void move_supports(const MovingSupports& supports, Real t, const solve::Springs& springs);

}  // namespace rockfold::motion
