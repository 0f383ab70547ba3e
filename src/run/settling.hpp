// How rock that an excavation has unbalanced is brought to rest before a dynamic step goes on: quasi-statically, while time stands still.
//
// Rock is dug round by round over days, and what its walls bear changes as slowly. Let go at once, the energy that stress had stored in joints
// and rock throws blocks out that are clamped. So what the excavated rock pressed its walls with is taken away in equal parts, a quasi-static
// step each; then steps go on until each block is at rest, or accelerates steadily and no faster than what acts on it alone would have it:
// nothing holds it, and the dynamic step is for it. What is faster is still pushed by stress that its joints give back.
//
// A quasi-static step of Δt brings a mode of frequency ω nearer to rest by 1/(1 + ω²Δt²/4), and moves a block that nothing holds by a Δt²/4. Long
// steps bring rest, short ones keep loose blocks where they are: Δt doubles while accelerations fall, and is what moves the fastest block by a
// ten thousandth of the blocks' size where one does not.
#pragma once

#include <array>
#include <vector>

#include "src/base/archive.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Share of the forces on walls that is left `time` s after the release began. Rows of `release`: s, and the share that is gone by then, linear in
/// between from nothing at 0 on; the last one stays.
Real walls_left(const std::vector<std::array<Real, 2>>& release, Real time);

/// What settling came to.
struct Settled {
  Index stage = 0;       ///< into Analysis::stages
  Index steps = 0;       ///< quasi-static ones
  Real largest = 0;      ///< m, how far a block went meanwhile
  Index block = none;    ///< that went so far; none: nothing moved
  Index moving = 0;      ///< blocks that accelerate steadily
  Index fastest = none;  ///< of them the one that accelerates most
  bool ended = true;     ///< false: others were not at rest after the most steps there are
};

class Settling {
 public:
  /// `time_step`: s, that it begins with. `size`: m, of a block. `gravity`: m/s², ≥ 0. `free`: m/s², with which a block that nothing holds
  /// accelerates at most; infinite where loads may push it as fast as they like. `rounding`: m, that of what has not moved.
  void begin(Real time_step, Real size, Real gravity, Real free, Real rounding = 0);
  bool done() const { return done_; }
  Real time_step() const { return time_step_; }
  /// Share of the forces on walls that is left at the end of the next step.
  Real walls() const;
  /// [B] m: how far blocks have gone in a step, which was divided into so many parts, and since settling began.
  void add(const std::vector<Vec3>& way, const std::vector<Vec3>& since, Index parts = 1);
  const Settled& settled() const { return settled_; }
  void pass(Archive& archive);

 private:
  bool is_at_rest(Real acceleration) const;
  void judge(const std::vector<Vec3>& acceleration);
  void choose_time_step(Real acceleration, Real way);

  Settled settled_;
  Real time_step_ = 0, size_ = 0, gravity_ = 0, free_ = 0, rounding_ = 0;
  Real largest_before_ = 0;         ///< m/s², of the step before
  Real largest_ever_ = 0;           ///< m/s²
  std::vector<Vec3> acceleration_;  ///< [B] m/s², of the step before; empty: none
  bool done_ = true;
};

}  // namespace rockfold
