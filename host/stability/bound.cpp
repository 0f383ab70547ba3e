#include "host/stability/bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/stability/contact_columns.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Each makes a cone's gap a quarter of what it was: after so many it is rounding.
constexpr Index most_rounds = 40;

class BoundSearch {
 public:
  BoundSearch(const RigidMass& mass, Progress& progress)
      : scaled_(mass), columns_(scaled_), progress_(progress) {}

  Bound find() {
    if (look_at(0) == Answer::stands)
      return {std::numeric_limits<Real>::infinity(), std::move(below_), {}, programs_};
    // Strength is a share 1/F of what there is: too little up to `low_`, enough from `high_` on.
    while (!std::isfinite(high_) || high_ - low_ > bound_tolerance * high_) {
      if (low_ >= most_strength && !std::isfinite(high_))
        return {0, {}, std::move(above_), programs_};
      const Real share = next_share();
      last_ = look_at(share);
      if (last_ == Answer::stands) high_ = share;
      if (last_ == Answer::moves) low_ = share;
      trial_ = share;
    }
    Bound bound;
    bound.factor = 0.5 * (below_.factor + above_.factor);
    bound.below = std::move(below_);
    bound.above = std::move(above_);
    bound.programs = programs_;
    return bound;
  }

 private:
  /// The last: cones have become rounder where areas slip, and the next look tells more.
  enum class Answer : std::uint8_t { stands, moves, moves_on_polygons };

  /// Newton's step, a little beyond so that it may end. Where that leaves the bracket, just below its upper side; where the mass stood
  /// there too, the middle.
  Real next_share() {
    const bool moves = last_ != Answer::stands;
    const Real step = moves && slope_ > 0 ? short_of_ / slope_ : 0;
    const Real most = std::isfinite(high_) ? high_ : most_strength;
    const Real newton = std::min((trial_ + step) * (1 + 0.25 * bound_tolerance), most);
    const bool leads = step > 0 || std::isfinite(high_);
    if (moves && leads && newton > low_ && newton < high_) {
      from_above_ = false;
      return newton;
    }
    if (!std::isfinite(high_)) return std::clamp(10 * std::max(low_, trial_), 1.0, most_strength);
    if (last_ == Answer::moves_on_polygons && trial_ > low_ && trial_ < high_) return trial_;
    const bool again = !moves && from_above_;
    from_above_ = !again;
    return again ? 0.5 * (low_ + high_) : high_ * (1 - 0.75 * bound_tolerance);
  }

  /// Whether the mass stands with this share of its strength; keeps what proves the answer.
  Answer look_at(Real share) {
    const LinearSolution solution =
        solve(columns_.program(share), basis_.x.empty() ? nullptr : &basis_);
    ++programs_;
    basis_ = solution;
    constexpr Real balanced = 1e-9;  // of all loads
    if (solution.cost <= balanced * static_cast<Real>(scaled_.mass().bodies.size())) {
      below_ = {1 / share, columns_.forces(share, solution)};
      return Answer::stands;
    }
    std::vector<Real> reversed = solution.price;
    for (Real& y : reversed) y = -y;
    std::vector<BodyVelocity> velocity = scaled_.velocities(reversed);
    short_of_ = solution.cost;
    slope_ = columns_.slope(solution, velocity);
    rounds_ = share == trial_ ? rounds_ + 1 : 0;
    if (columns_.round_off(share, velocity) > 0 && rounds_ < most_rounds)
      return Answer::moves_on_polygons;
    above_ = {1 / share, std::move(velocity)};
    return Answer::moves;
  }

  ScaledMass scaled_;
  ContactColumns columns_;
  Progress& progress_;
  LinearSolution basis_;
  Balance below_;
  Mechanism above_;
  Real low_ = 0, high_ = std::numeric_limits<Real>::infinity();
  Answer last_ = Answer::moves;    ///< at trial_
  bool from_above_ = false;        ///< the share looked at last was just below high_
  Real trial_ = 0;                 ///< the share looked at last
  Real short_of_ = 0, slope_ = 0;  ///< there, of the least sum of forces to add
  Index programs_ = 0, rounds_ = 0;
};

}  // namespace

Bound find_bound(const RigidMass& mass, Progress& progress) {
  return BoundSearch(mass, progress).find();
}

}  // namespace rockfold
