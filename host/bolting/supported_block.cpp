#include "host/bolting/supported_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Of a falling block's loads, where doubling them ends. They lift the block off all planes, so that any support of less than this
/// times their size is passed before. Norms square what is added: of loads up to 1e54 N that stays a double (1e308).
constexpr Real most_factor = 1e100;

/// Of the active bolts on one block.
struct Pull {
  Vec3 force{};   ///< N
  Vec3 moment{};  ///< N m, about the block's centroid
  Real size = 0;  ///< N: Σ of their tensions
};

Turning turning_of(const Rotation& r) {
  return {r.point, r.axis, r.driving, r.resisting, norm(r.velocity)};
}

/// NaN: nothing resists.
bool is_less_safe(const HeldBlock& a, const HeldBlock& b) {
  const auto safety = [](Real f) { return std::isnan(f) ? -std::numeric_limits<Real>::max() : f; };
  return safety(a.factor_of_safety) < safety(b.factor_of_safety);
}

class SupportedBlock {
 public:
  SupportedBlock(const Keyblock& key, std::span<const BoltAtBlock> bolts,
                 const ShotcreteHold& shotcrete, Real target)
      : key_(key), bolts_(bolts), shotcrete_(shotcrete), target_(target) {
    for (const BoltAtBlock& bolt : bolts) {
      if (bolt.type->action != BoltAction::active) continue;
      const Vec3 force = bolt.axial * bolt.axis;
      pull_.force += force;
      pull_.moment += cross(bolt.point - key.body.centroid, force);
      pull_.size += bolt.axial;
    }
  }

  SupportedMotion governing() const {
    const bool falls = key_.movement && key_.movement->mode == SlidingMode::lifting;
    if (pull_.size == 0) return least_safe(key_.movement, key_.rotations);
    if (falls) return falling();
    return least_safe(governing_movement(key_.contact, resultant(1)), rotations());
  }

 private:
  /// factor × r + P_a, N; zero where that is the rounding of forces that cancel.
  Vec3 resultant(Real factor) const {
    const Vec3 sum = factor * key_.resultant + pull_.force;
    const Real size = factor * norm(key_.resultant) + pull_.size;
    return norm(sum) <= 1e-12 * size ? Vec3{} : sum;
  }

  std::vector<Rotation> rotations() const {
    RigidBody body = key_.body;
    body.pull = pull_.force;
    body.pull_moment = pull_.moment;
    return find_rotations(key_.patches, body);
  }

  /// `motion` tells the unit direction in which the block moves at a point; zero: not at all.
  template <class Motion>
  std::vector<BoltForce> forces_against(const Motion& motion) const {
    std::vector<BoltForce> forces;
    for (const BoltAtBlock& bolt : bolts_) {
      const Vec3 s = motion(bolt.point);
      if (bolt.type->action == BoltAction::active)
        forces.push_back(anchor_force(bolt.axis, bolt.axial, s));
      else
        forces.push_back(norm(s) > 0 ? bolt_force(*bolt.type, bolt.axis, bolt.axial, s)
                                     : BoltForce{});
    }
    return forces;
  }

  std::vector<SupportElement> elements(const std::vector<BoltForce>& forces) const {
    std::vector<SupportElement> elements;
    for (std::size_t i = 0; i < bolts_.size(); ++i) {
      const BoltType& type = *bolts_[i].type;
      const bool active = type.action == BoltAction::active;
      elements.push_back({forces[i].force, active, type.stiffness, bolts_[i].point});
    }
    if (norm(shotcrete_.force) > 0)
      elements.push_back({shotcrete_.force, false, 0, shotcrete_.point});
    return elements;
  }

  SupportedMotion translating(const Movement& movement) const {
    SupportedMotion motion{movement.mode, {}, {}};
    motion.forces = forces_against([&](const Vec3&) { return movement.direction; });
    motion.held = hold(key_.contact, movement, elements(motion.forces), target_);
    return motion;
  }

  SupportedMotion turning(const Rotation& rotation) const {
    const Turning turning = turning_of(rotation);
    SupportedMotion motion{SlidingMode::rotation, {}, {}};
    motion.forces = forces_against([&](const Vec3& at) {
      const Vec3 v = turning.motion(at);
      return norm(v) > 0 ? normalized(v) : v;  // on the axis: it does not move the bolt
    });
    motion.held = hold(turning, elements(motion.forces), target_);
    return motion;
  }

  /// The bolts are shown against the motion without anchors.
  SupportedMotion resting() const {
    SupportedMotion motion;
    const Vec3 s = key_.movement ? key_.movement->direction : key_.direction;
    motion.forces = forces_against([&](const Vec3&) { return s; });
    motion.held = at_rest(elements(motion.forces));
    return motion;
  }

  /// Support may hold one motion and not another: the one that is least safe with it counts, and what is missing is the
  /// most that any of them lacks.
  SupportedMotion least_safe(const std::optional<Movement>& movement,
                             std::span<const Rotation> rotations) const {
    std::optional<SupportedMotion> worst;
    Real missing = 0;
    const auto look_at = [&](SupportedMotion motion) {
      missing = std::max(missing, motion.held.missing_force);
      if (!worst || is_less_safe(motion.held, worst->held)) worst = std::move(motion);
    };
    if (movement) look_at(translating(*movement));
    for (const Rotation& rotation : rotations) look_at(turning(rotation));
    if (!worst) return resting();
    worst->held.adequate = missing == 0;
    worst->held.missing_force = missing;
    return *std::move(worst);
  }

  SupportedMotion with_loads(Real factor) const {
    return least_safe(governing_movement(key_.contact, resultant(factor)), {});
  }

  /// The least factor on the loads, from `low`, at which they are not held; `low` if they are held there, else `high`, must
  /// be.
  Real limit_factor(Real low, Real high) const {
    for (int step = 0; step < 200; ++step) {
      const Real middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (with_loads(middle).held.in_balance ? low : high) = middle;
    }
    return low;
  }

  /// Where r + P_a still lifts the block off all planes, along s': −(P_a + P_p)·s' / r·s'. `safety` is that of r + P_a.
  Real factor_of_fall(Real safety) const {
    const Vec3 rest = resultant(1);
    const Real driving = norm(rest);
    const Real resisting = std::isnan(safety) ? 0 : safety * driving;
    const Real carried = std::max(Real{0}, -dot(pull_.force, rest) / driving);
    return (resisting + carried) / (driving + carried);
  }

  /// Rotations are not looked at, as of a block that falls without support.
  SupportedMotion falling() const {
    SupportedMotion motion = with_loads(1);
    const bool held = motion.held.in_balance;
    Real factor = 0;
    if (held) {
      Real high = 2;
      while (high < most_factor && with_loads(high).held.in_balance) high *= 2;
      factor = limit_factor(0.5 * high, high);
    } else if (with_loads(0).held.in_balance) {
      factor = limit_factor(0, 1);
    } else if (motion.mode == SlidingMode::lifting) {
      factor = factor_of_fall(motion.held.factor_of_safety);
    } else {
      factor = motion.held.factor_of_safety;  // the anchors alone would drive it
    }
    const Real missing = (target_ - factor) * key_.movement->driving;
    motion.held.factor_of_safety = factor;
    motion.held.adequate = factor >= (1 - 1e-12) * target_;
    motion.held.missing_force = motion.held.adequate ? 0 : missing;
    if (motion.mode == SlidingMode::at_rest) motion.mode = key_.movement->mode;
    return motion;
  }

  const Keyblock& key_;
  std::span<const BoltAtBlock> bolts_;
  const ShotcreteHold& shotcrete_;
  Real target_;
  Pull pull_;
};

}  // namespace

SupportedMotion supported_motion(const Keyblock& key, std::span<const BoltAtBlock> bolts,
                                 const ShotcreteHold& shotcrete, Real target) {
  return SupportedBlock(key, bolts, shotcrete, target).governing();
}

}  // namespace rockfold
