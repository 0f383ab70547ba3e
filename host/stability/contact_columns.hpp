// The forces that contact points may pass on, as columns of a linear programme: at a corner the edges of its friction cone; over a triangle of
// area A, whose strength is cohesion and tension t, −t A along the normal, a polygon of the radius that the cone has there, and the cone from
// there. The corners of a polygon share its radius: a row more for each.
#pragma once

#include <vector>

#include "host/stability/mass_scale.hpp"

namespace rockfold {

/// Columns that do not depend on the strength but by their numbers: which edge of which point's polygon.
struct ContactColumn {
  enum class Kind : std::uint8_t { edge, disc };
  Index point = none;
  Kind kind = Kind::edge;
  Real angle = 0;  ///< from the contact's first tangent
};

class ContactColumns {
 public:
  explicit ContactColumns(const ScaledMass& scaled);

  /// The programme at strength times `share` = 1/F, and how its parts move with it.
  LinearProgram program(Real share) const;
  /// What the dual of a solution takes up less for more strength: −d(cost)/d(share).
  Real slope(const LinearSolution& solution, const std::vector<BodyVelocity>& velocity) const;
  /// N on the first bodies, [points].
  std::vector<Vec3> forces(Real share, const LinearSolution& solution) const;
  /// More edges where a mechanism parts areas by less than a round cone asks for, by more than `gap` of its largest jump; how many.
  Index round_off(Real share, const std::vector<BodyVelocity>& velocity, Real gap);

 private:
  Vec3 direction(const ContactColumn& column) const;
  Real disc_radius(const ForcePoint& point) const;    ///< at full strength, of force_scale()
  Real tension_force(const ForcePoint& point) const;  ///< likewise

  const ScaledMass& scaled_;
  std::vector<ContactColumn> columns_;
  std::vector<Index> disc_row_;  ///< [points] none where there is no polygon
  Index rows_ = 0;               ///< of the balance and of polygons
  Index slack_ = 0;  ///< columns before these: what is added to the loads, and what polygons leave
};

}  // namespace rockfold
