// The forces that contact points may pass on, as columns of a linear programme: at a corner the edges of its friction cone; over a triangle of
// area A, whose strength is cohesion and tension t, −t A along the normal, a polygon of the radius that the cone has there, and the cone from
// there. The corners of a polygon share its radius: a row more for each.
#pragma once

#include <cmath>
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

/// Where the search for a balance may start: columns with their programme's solution, in units of each body's own.
struct BalanceBasis {
  Real share = 0;
  std::vector<ContactColumn> columns;
  LinearSolution solution;

  /// The basis of a share that is far off is a worse start than none.
  bool near_by(Real other_share) const {
    constexpr Real near_share = 0.2;
    return std::abs(other_share - share) < near_share * share;
  }
};

class ContactColumns {
 public:
  explicit ContactColumns(const ScaledMass& scaled);
  /// Those that a search for the same mass ended with.
  ContactColumns(const ScaledMass& scaled, std::vector<ContactColumn> columns);

  /// What a programme's numbers count in: forces in loads of each body, so that light ones balance as well as heavy ones, or in a mean load, so
  /// that velocities are as exact for all.
  enum class Units : std::uint8_t { own, common };
  const std::vector<ContactColumn>& columns() const { return columns_; }
  /// The programme at strength times `share` = 1/F: the least sum of forces to add to the loads for a balance, each in these units.
  LinearProgram program(Real share, Units units) const;
  /// Of a programme for which no basis is near by.
  LinearSolution solve_anew(const LinearProgram& program) const;
  /// Sum of what is added to the loads of a solution for a balance, each of the load of its body.
  Real imbalance(const LinearSolution& solution) const;
  /// What the dual of a solution takes up less for more strength: −d(cost)/d(share).
  Real slope(Real share, const LinearSolution& solution,
             const std::vector<BodyVelocity>& velocity) const;
  /// N on the first bodies, [points].
  std::vector<Vec3> forces(Real share, const LinearSolution& solution) const;
  /// N, of the ties.
  std::vector<Real> tensions(const LinearSolution& solution) const;
  /// More edges where a mechanism parts areas by less than a round cone asks for, by more than `gap` of its largest jump; how many. With
  /// `priced`: of a programme of these costs, whose dual is `priced` − `velocity`.
  Index round_off(Real share, const std::vector<BodyVelocity>& velocity, Real gap,
                  const std::vector<BodyVelocity>* priced = nullptr);
  /// Costs of a programme: what a column's force lacks of the work that strength could take up of these slips. `unbalanced`: of what is
  /// added to the loads.
  void price(LinearProgram& program, Real share, const std::vector<BodyVelocity>& slips,
             Real unbalanced) const;

 private:
  std::vector<Real> right_side(Real share) const;
  std::vector<Index> layer_of_rows() const;
  Vec3 direction(const ContactColumn& column) const;
  /// Of force_scale(), and its derivative by the share of strength.
  struct Pull {
    Real force = 0, slope = 0;
  };
  /// What a point bears in tension: its strength, up to the apex of the cone, c / tan φ, which is the same at every share.
  Pull pull(const ForcePoint& point, Real share) const;
  Pull disc_radius(const ForcePoint& point, Real share) const;

  const ScaledMass& scaled_;
  std::vector<ContactColumn> columns_;
  std::vector<Index> disc_row_;  ///< [points] none where there is no polygon
  Index rows_ = 0;               ///< of the balance and of polygons
  Index slack_ =
      0;  ///< columns before those of ties: what is added to the loads, and what polygons leave
  Index ties_ = 0;
};

}  // namespace rockfold
