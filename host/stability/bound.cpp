#include "host/stability/bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/stability/contact_columns.hpp"
#include "host/stability/part_of_mass.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Each makes a cone's gap a quarter of what it was: after so many it is rounding.
constexpr Index most_rounds = 40;
/// Of the largest jump, by which slips may dilate too little: while the factor is looked for, and where it is proved, a hundredth of
/// what the verifier allows.
constexpr Real coarse = 1e-3, fine = 1e-9;
/// Sum of forces that are left over, each of the load of its body.
constexpr Real balanced = 1e-9;

/// Brings the two sides of the bound together, for a mass that is solved as a whole each time.
class BoundSearch {
 public:
  explicit BoundSearch(const RigidMass& mass) : scaled_(mass), columns_(scaled_) {}

  using Units = ContactColumns::Units;

  /// Whether it stands with this share 1/F of its strength, by cones that are round to `gap`; keeps what proves the answer.
  bool stands(Real share, Real gap, Units units) {
    const bool near_by = units == units_ && basis_.near_by(share);
    LinearSolution& solution = basis_.solution;
    const LinearSolution* before = near_by ? &solution : nullptr;
    basis_.share = share;
    units_ = units;
    for (Index round = 0;; ++round) {
      const LinearProgram program = columns_.program(share, units);
      solution = before ? solve(program, before) : columns_.solve_anew(program);
      before = &solution;
      ++programs_;
      if (columns_.imbalance(solution) <= balanced) {
        below_ = {1 / share, columns_.forces(share, solution), columns_.tensions(solution)};
        return true;
      }
      std::vector<Real> reversed = solution.price;
      for (Real& y : reversed) y = -y;
      above_ = {1 / share, scaled_.velocities(reversed)};
      if (columns_.round_off(share, above_.velocity, gap) == 0 || round == most_rounds)
        return false;
    }
  }

  Bound find() {
    if (stands(0, coarse, Units::common)) return bound(std::numeric_limits<Real>::infinity());
    if (stands(1 / most_factor, coarse, Units::own)) return bound(most_factor);
    return find_from(1 / most_factor);
  }

  /// It failed with this share, which was looked at last.
  Bound find_from(Real share) {
    low_ = share;
    for (;;) {
      while (!std::isfinite(high_) || high_ - low_ > bound_tolerance * high_) {
        if (low_ >= most_strength && !std::isfinite(high_)) return bound(0);
        const Real next = next_share();
        (stands(next, coarse, Units::common) ? high_ : low_) = next;
      }
      if (proves_failure_below(low_)) break;
      // Rounder cones bear it. What they bear less of is not far.
      for (Real back = 10 * bound_tolerance; stands(low_, coarse, Units::common);
           back = std::min(10 * back, 0.5)) {
        high_ = low_;
        low_ *= 1 - back;
      }
    }
    const Mechanism above = above_;
    while (!stands(high_, coarse, Units::own)) high_ *= 1 + bound_tolerance;
    above_ = above;
    return bound(0.5 * (below_.factor + above_.factor));
  }

  const Balance& below() const { return below_; }
  BalanceBasis basis() const { return {basis_.share, columns_.columns(), basis_.solution}; }
  const Mechanism& above() const { return above_; }
  Index programs() const { return programs_; }

 private:
  /// Failure by a hair proves nothing: slips that dilate too little, by `fine`, could hide it. False where it stands below, which is `low_` then.
  bool proves_failure_below(Real share) {
    for (Real margin = 0.5 * bound_tolerance; margin < 0.5; margin *= 4) {
      low_ = share * (1 - margin);
      if (stands(low_, fine, Units::common)) return false;
      Real fastest = 0;
      for (const ForcePoint& point : scaled_.points())
        fastest = std::max(fastest, norm(scaled_.jump(point, above_.velocity)));
      const Real hidden = fine * fastest * static_cast<Real>(scaled_.mass().bodies.size());
      if (basis_.solution.cost > 2 * hidden) break;
    }
    return true;
  }

  /// Strength is a share of what there is: too little up to `low_`, enough from `high_` on. Newton's step from the lower side, a little
  /// beyond so that it may end; where that leaves the bracket, its middle.
  Real next_share() const {
    const Real slope =
        low_ > 0 || programs_ == 1 ? columns_.slope(low_, basis_.solution, above_.velocity) : 0;
    const Real step = basis_.share == low_ && slope > 0 ? basis_.solution.cost / slope : 0;
    const Real newton = (low_ + step) * (1 + 0.25 * bound_tolerance);
    const Real most = std::isfinite(high_) ? high_ : most_strength;
    if (step > 0 && newton < most) return newton;
    return std::isfinite(high_) ? 0.5 * (low_ + high_) : std::clamp(10 * low_, 1.0, most_strength);
  }

  Bound bound(Real factor) {
    Bound bound{factor, std::move(below_), std::move(above_), programs_, basis()};
    if (factor >= most_factor) bound.above = {};
    if (factor == 0) bound.below = {};
    return bound;
  }

  ScaledMass scaled_;
  ContactColumns columns_;
  BalanceBasis basis_;  ///< of the share looked at last; its columns are columns_
  Units units_ = Units::own;
  Balance below_;
  Mechanism above_;
  Real low_ = 0, high_ = std::numeric_limits<Real>::infinity();
  Index programs_ = 0;
};

/// From the parts that fail to the whole: what moves most easily is mostly one block, or a few, and the whole need only be shown to bear as
/// much. If it does not, what moves is the next part.
class WholeSearch {
 public:
  explicit WholeSearch(const RigidMass& mass) : mass_(mass), parts_(mass), whole_(mass) {}

  Bound find() {
    Real share = 0;
    for (Index b = 0; b < static_cast<Index>(mass_.bodies.size()); ++b) look_at_part({b});
    std::vector<Index> last;
    while (factor_ > 0 && std::isfinite(factor_)) {
      share = (1 + 0.25 * bound_tolerance) / below_factor_;
      if (whole_.stands(share, fine, ContactColumns::Units::own))
        return {0.5 * (1 / share + above_.factor), whole_.below(), std::move(above_), programs(),
                whole_.basis()};
      std::vector<Index> moving = moving_bodies();
      if (moving == last || moving.size() == mass_.bodies.size()) break;
      last = moving;
      look_at_part(std::move(moving));
    }
    if (factor_ == 0) return {0, {}, std::move(above_), programs(), {}};
    Bound bound = share > 0 ? whole_.find_from(share) : whole_.find();
    bound.programs = programs();
    return bound;
  }

 private:
  Index programs() const { return of_parts_ + whole_.programs(); }

  void look_at_part(std::vector<Index> bodies) {
    const PartOfMass part = parts_.part(std::move(bodies));
    BoundSearch search(part.mass);
    const bool safer = std::isfinite(factor_) && factor_ > 0 &&
                       search.stands(1 / above_.factor, coarse, ContactColumns::Units::common);
    if (!safer && factor_ > 0) {
      const Bound bound = search.find();
      if (bound.factor < std::min(factor_, most_factor)) {
        factor_ = bound.factor;
        below_factor_ = bound.below.factor;
        above_ = part.of_whole(bound.above, mass_.bodies.size());
      }
    }
    of_parts_ += search.programs();
  }

  /// Those that move in the mechanism found last.
  std::vector<Index> moving_bodies() const {
    constexpr Real at_rest = 1e-6;
    const std::vector<BodyVelocity>& velocity = whole_.above().velocity;
    std::vector<Index> moving;
    for (Index b = 0; b < static_cast<Index>(velocity.size()); ++b)
      if (norm(velocity[b].velocity) > at_rest || norm(velocity[b].spin) > at_rest)
        moving.push_back(b);
    return moving;
  }

  const RigidMass& mass_;
  PartsOfMass parts_;
  BoundSearch whole_;
  Real factor_ = std::numeric_limits<Real>::infinity();  ///< the least of the parts
  Real below_factor_ = 0;                                ///< at which that part stands
  Mechanism above_;                                      ///< of that part
  Index of_parts_ = 0;
};

}  // namespace

Bound find_bound(const RigidMass& mass, Progress& progress) {
  progress.begin("the whole mass", 0, "programmes");
  Bound bound = WholeSearch(mass).find();
  progress.end();
  return bound;
}

}  // namespace rockfold
