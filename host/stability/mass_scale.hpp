// A rigid mass in numbers near 1: forces in mean loads of a body, lengths in the body's own size. And the columns that forces at contact
// points are in the balance of all bodies.
#pragma once

#include <array>
#include <vector>

#include "host/stability/certificate.hpp"
#include "host/stability/linear_program.hpp"
#include "host/stability/rigid_mass.hpp"

namespace rockfold {

class ScaledMass {
 public:
  /// `mass` must live as long.
  explicit ScaledMass(const RigidMass& mass);

  const RigidMass& mass() const { return mass_; }
  const std::vector<ForcePoint>& points() const { return points_; }
  const ContactArea& contact(const ForcePoint& point) const {
    return mass_.contacts[static_cast<std::size_t>(point.contact)];
  }
  /// Two unit vectors across the normal of a contact, the first down its steepest slope against the loads, if there is one.
  const std::array<Vec3, 2>& tangents(const ForcePoint& point) const {
    return tangents_[static_cast<std::size_t>(point.contact)];
  }
  Real force_scale() const { return force_; }          ///< N
  Real load(Index body) const { return load_[body]; }  ///< of one body, of force_scale(); never 0
  /// The smaller one of two bodies; none has no load.
  Real load(const std::array<Index, 2>& body) const;
  Real load(const ForcePoint& point) const { return load(contact(point).body); }

  Index rows() const { return 6 * static_cast<Index>(mass_.bodies.size()); }
  /// Of the balance: minus the loads.
  std::vector<Real> right_side() const;
  /// The entries of a force (of force_scale()) on the first body of a point's contact, for the column that is added next.
  void add_force(LinearProgram& program, const ForcePoint& point, const Vec3& force) const;

  /// The entries of the tension 1 in a tie, likewise.
  void add_tension(LinearProgram& program, const BoltTie& tie) const;
  /// How fast a tie lengthens, m/s.
  Real lengthening(const BoltTie& tie, const std::vector<BodyVelocity>& velocity) const;

  /// Velocities, m/s, of prices of the rows.
  std::vector<BodyVelocity> velocities(const std::vector<Real>& price) const;
  /// Of the first body of a point's contact from the second.
  Vec3 jump(const ForcePoint& point, const std::vector<BodyVelocity>& velocity) const;
  /// The part of a jump that is no opening.
  Real slip(const ForcePoint& point, const Vec3& jump) const;
  /// W of the loads.
  Real power(const std::vector<BodyVelocity>& velocity) const;

 private:
  void add_pull(LinearProgram& program, Index body, const Vec3& at, const Vec3& force) const;
  Vec3 apart(const std::array<Index, 2>& body, const Vec3& at,
             const std::vector<BodyVelocity>& velocity) const;

  const RigidMass& mass_;
  std::vector<ForcePoint> points_;
  std::vector<std::array<Vec3, 2>> tangents_;  ///< [contacts]
  std::vector<Real> size_;                     ///< [bodies] m
  std::vector<Real> load_;                     ///< [bodies] of force_
  Real force_ = 1;
};

}  // namespace rockfold
