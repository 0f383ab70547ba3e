#include "host/stability/sliding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "host/stability/collapse_forces.hpp"
#include "host/stability/part_of_mass.hpp"
#include "host/stability/spring_mass.hpp"
#include "host/stability/verify.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Of velocities from step to step: enough to see which parts move, and to write down how.
constexpr Real about = 5e-2, exact = 1e-6;
constexpr Index most_trials = 40;
/// Of a factor: what the whole mass may fail below the weakest block without its being looked for.
constexpr Real a_little = 0.01;
constexpr Real unlimited = std::numeric_limits<Real>::infinity();

/// Failure of a mass on springs, all of it at once.
struct Failure {
  enum class Answer : std::uint8_t { fails, stands, undecided };
  Answer answer = Answer::undecided;
  Real factor = 0;  ///< that its motion can bear; 0: it falls
  Mechanism mechanism;
  Real stood_at = 0;  ///< the factor at which it was seen to stand
};

/// The fastest point of a contact, or centre of a body, moves with 1 m/s.
std::vector<BodyVelocity> at_unit_speed(const ScaledMass& scaled,
                                        std::vector<BodyVelocity> velocity) {
  Real fastest = 0;
  for (const ForcePoint& point : scaled.points())
    fastest = std::max(fastest, norm(scaled.jump(point, velocity)));
  for (const BodyVelocity& v : velocity) fastest = std::max(fastest, norm(v.velocity));
  for (BodyVelocity& v : velocity) {
    v.velocity = (1 / fastest) * v.velocity;
    v.spin = (1 / fastest) * v.spin;
  }
  return velocity;
}

class FailureSearch {
 public:
  /// `basis`: of a balance of this mass.
  explicit FailureSearch(const RigidMass& mass, const BalanceBasis& basis = {})
      : scaled_(mass), springs_(scaled_), basis_(basis) {}

  /// From `first` down: the creeping mass tells what its own motion can bear, and a little below is tried next, until it stands; then between
  /// the two. Joints that stick may hold a mass a little above what its motion can bear, as friction at rest does; that motion is its failure all
  /// the same, if a state of collapse proves it. Stands, if the motion at `first` can bear `most` or more.
  Failure find(Real first, Real most) {
    Real next = first, own = 0;
    bool tried = false;
    for (Index n = 0; n < most_trials; ++n) {
      SpringMass::State state = springs_.settle(1 / next, springs_.start(), about);
      if (state.ending == Ending::undecided) return {};
      if (state.ending == Ending::stands) {
        stood_at_ = next;
        if (n == 0) return {Failure::Answer::stands, 0, {}, stood_at_};
      } else {
        fails_ = next;
        creeping_ = std::move(state);
        own = std::min(springs_.factor(creeping_), fails_);
        if (n == 0 && own >= most) return {Failure::Answer::stands, 0, {}, 0};
        if (fails_ < least_factor) return motion(0);
      }
      if (fails_ <= stood_at_ * (1 + 3 * sliding_tolerance)) return motion(stood_at_);
      if (!tried && own > 0.5 * stood_at_ && own < stood_at_) {
        tried = true;
        Failure moves = motion(own);
        if (find_collapse_forces(scaled_.mass(), at_unit_speed(moves), basis_)) return moves;
      }
      next = between(own);
    }
    return {};
  }

 private:
  /// A little below or above what the motion can bear, by its own account, which is poor far above; where that is known already, the middle.
  Real between(Real own) const {
    const Real low = own * (1 - 0.5 * sliding_tolerance), high = own * (1 + 2 * sliding_tolerance);
    if (stood_at_ == 0) return std::max(low, 0.5 * fails_);
    if (low > stood_at_ * (1 + sliding_tolerance) && low < fails_) return low;
    if (high > stood_at_ && high < fails_) return high;
    return std::sqrt(stood_at_ * fails_);
  }

  /// Of the mass that creeps, as exact as can be: so near its limit that it comes to rest after all, as it was seen to creep.
  Failure motion(Real least) {
    const SpringMass::State longer = springs_.settle(1 / fails_, creeping_, exact);
    const SpringMass::State& state = longer.ending == Ending::creeps ? longer : creeping_;
    const Real own = fails_ < least_factor ? 0 : std::clamp(springs_.factor(state), least, fails_);
    return {Failure::Answer::fails, own, {own, springs_.velocities(state)}, stood_at_};
  }

  Mechanism at_unit_speed(const Failure& failure) const {
    return {failure.factor, rockfold::at_unit_speed(scaled_, failure.mechanism.velocity)};
  }

  ScaledMass scaled_;
  SpringMass springs_;
  BalanceBasis basis_;
  Real stood_at_ = 0, fails_ = unlimited;
  SpringMass::State creeping_;  ///< at fails_
};

/// The failure at the least factor of any block with all others held; `most` where none fails below.
Failure weakest_block(const RigidMass& mass, Real most, Progress& progress) {
  const PartsOfMass parts(mass);
  Failure weakest{Failure::Answer::stands, most, {}, 0};
  progress.begin("blocks without dilation", static_cast<std::int64_t>(mass.bodies.size()),
                 "blocks");
  for (Index b = 0; b < static_cast<Index>(mass.bodies.size()) && weakest.factor > 0; ++b) {
    const PartOfMass part = parts.part({b});
    constexpr Real far_above = 2;  // there friction at rest holds nothing that could move below
    Failure failure = FailureSearch(part.mass).find(far_above * weakest.factor, weakest.factor);
    if (failure.answer == Failure::Answer::fails && failure.factor < weakest.factor) {
      failure.mechanism = part.of_whole(failure.mechanism, mass.bodies.size());
      weakest = std::move(failure);
    }
    progress.done(b + 1);
  }
  progress.end();
  return weakest;
}

Sliding failing(const RigidMass& mass, const Failure& failure, const BalanceBasis& basis,
                bool stands_below) {
  const std::vector<BodyVelocity> velocity =
      at_unit_speed(ScaledMass(mass), failure.mechanism.velocity);
  if (failure.factor == 0) return {Sliding::Answer::falls, 0, {0, velocity}, {}, false};
  Sliding sliding{
      Sliding::Answer::fails, failure.factor, {failure.factor, velocity}, {}, stands_below};
  std::optional<Balance> balance = find_collapse_forces(mass, sliding.mechanism, basis);
  if (balance) {
    Mechanism mechanism{balance->factor, sliding.mechanism.velocity};
    if (verify_sliding(mass, *balance, mechanism).holds()) {
      sliding.factor = balance->factor;
      sliding.mechanism = std::move(mechanism);
      sliding.balance = *std::move(balance);
    }
  }
  if (!sliding.proved()) sliding.factor = std::max(sliding.factor, failure.stood_at);
  sliding.mechanism.factor = sliding.factor;
  return sliding;
}

}  // namespace

Sliding find_sliding(const RigidMass& mass, const Bound& bound, Progress& progress) {
  using Answer = Failure::Answer;
  if (std::isinf(bound.factor)) return {Sliding::Answer::stands, bound.factor, {}, {}, true};
  if (bound.factor == 0) return {Sliding::Answer::falls, 0, bound.above, {}, false};
  const Failure block = weakest_block(mass, bound.factor, progress);
  if (block.answer == Answer::fails && block.factor == 0)
    return failing(mass, block, bound.basis, false);
  Sliding alone;
  if (block.answer == Answer::fails) alone = failing(mass, block, bound.basis, false);
  // What others put on a block may hold it: then its motion is none of the mass, and the mass is looked at from its bound on, where it
  // fails for sure.
  const Real first =
      alone.proved() ? alone.factor * (1 - a_little) : bound.factor * (1 + 2 * sliding_tolerance);
  progress.begin("the whole mass without dilation", 0, "trials");
  const Failure whole = FailureSearch(mass, bound.basis).find(first, unlimited);
  progress.end();
  const bool settled = whole.answer != Answer::undecided;
  if (whole.answer == Answer::fails &&
      (!alone.proved() || whole.factor < block.factor * (1 - sliding_tolerance)))
    return failing(mass, whole, bound.basis, whole.stood_at > 0);
  alone.stands_below = settled && alone.proved();
  return alone;
}

}  // namespace rockfold
