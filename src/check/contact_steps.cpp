#include "src/check/contact_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "src/base/vector.hpp"
#include "src/model/openings.hpp"
#include "src/report/error_text.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

using Flags = std::vector<std::uint8_t>;
constexpr Real infinite = std::numeric_limits<Real>::infinity();

/// Of their size, by which blocks move in a step that contact finds its way through, and in one that it hardly does.
constexpr Real good_way = 0.02, long_way = 0.2;

/// Blocks on their way, as one of them decides.
struct Motion {
  Real size =
      1;  ///< m, that a step's way is compared with; of a flight: from centre to centre as the two touch
  Real speed = 0;                       ///< m/s
  Index block = none, obstacle = none;  ///< of a flight: it, and the thinnest one it may hit
  Real block_thickness = 0, obstacle_thickness = 0;  ///< m, along the way
  bool falls = false;
  /// 1/s
  Real rate() const { return speed / size; }
};

/// [B] m: the mean length of a block's chords of one direction, its volume over its shadow (Cauchy: half of Σ area |n · direction|).
/// For a plate at an angle its thickness as seen along the direction; infinite for blocks that are not `there`.
std::vector<Real> thicknesses(const BlockArrays& blocks, const Vec3& direction,
                              const Flags& there) {
  std::vector<Real> thickness(blocks.volume.size(), infinite);
  for (Index b = 0; b < blocks.block_count(); ++b) {
    if (!there[b]) continue;
    Real shadow = 0;
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
      shadow += 0.5 * blocks.face_area[f] * std::abs(dot(blocks.face_normal[f], direction));
    if (shadow > 0) thickness[b] = blocks.volume[b] / shadow;
  }
  return thickness;
}

/// What the model's blocks are and do as the analysis begins.
class Start {
 public:
  Start(const Model& model, const BlockArrays& blocks, const CoverArrays& covers,
        const FixedPoints& fixed)
      : model_(model),
        blocks_(blocks),
        there_(blocks.volume.size()),
        held_(there_),
        touches_(there_) {
    for (std::size_t b = 0; b < there_.size(); ++b)
      there_[b] = is_there_at_first(model, blocks.stage[b]);
    std::array<Flags, 3> component{held_, held_, held_};
    for (std::size_t i = 0; i < fixed.points.size(); ++i)
      if (const Index e = fixed.points.element[i]; e != none)
        for (std::size_t d = 0; d < 3; ++d)
          component[d][block_of(covers, e)] |= fixed.component[i][d];
    for (std::size_t b = 0; b < held_.size(); ++b)
      held_[b] = component[0][b] & component[1][b] & component[2][b];
    for (const auto& shared : blocks.interfaces)
      if (there_[shared.block[0]] && there_[shared.block[1]])
        for (const Index b : shared.block) touches_[b] = 1;
  }

  bool holds_several() const { return std::count(there_.begin(), there_.end(), 1) > 1; }

  /// Blocks that rest on others, fallen by their own size: the cube root of the mean volume of those that are not held, if there are any.
  Motion of_rest() const {
    Real volume[2] = {0, 0};  // of those that are not held, and of those that are
    Index count[2] = {0, 0};
    for (std::size_t b = 0; b < there_.size(); ++b) {
      if (!there_[b]) continue;
      volume[held_[b]] += blocks_.volume[b];
      ++count[held_[b]];
    }
    const int kind = count[0] > 0 ? 0 : 1;
    Motion rest;
    rest.size = std::cbrt(volume[kind] / static_cast<Real>(count[kind]));
    rest.speed = std::sqrt(2 * norm(model_.gravity) * rest.size);
    return rest;
  }

  Motion of_thrown(const RigidVelocity& given) const {
    std::vector<Real> speed(there_.size());
    for (const Index b : given.blocks) speed[b] = norm(given.velocity);
    return of_fastest(std::move(speed), given.velocity);
  }

  /// Blocks that touch nothing, as fast as they are at the height of the lowest rock or at the end of the analysis.
  Motion of_fallen(Real duration) const {
    const Real gravity = norm(model_.gravity);
    std::vector<Real> speed(there_.size()), level(there_.size());
    for (std::size_t b = 0; b < there_.size(); ++b) level[b] = deepest(static_cast<Index>(b));
    const Real bottom = *std::max_element(level.begin(), level.end());
    for (std::size_t b = 0; b < there_.size(); ++b)
      if (there_[b] && !touches_[b])
        speed[b] = std::min(std::sqrt(2 * (bottom - level[b])), std::sqrt(gravity) * duration) *
                   std::sqrt(gravity);
    Motion fallen = of_fastest(std::move(speed), model_.gravity);
    fallen.falls = true;
    return fallen;
  }

 private:
  /// m, how far down along gravity a block reaches.
  Real deepest(Index b) const {
    Real most = -infinite;
    if (there_[b])
      for (Index v = blocks_.vertex_begin[b]; v < blocks_.vertex_begin[b + 1]; ++v)
        most = std::max(most, dot(blocks_.vertex[v], normalized(model_.gravity)));
    return most;
  }

  /// The block that moves farthest beside what it has to pass: half its thickness and half that of the thinnest block which does not
  /// move so. A step that is longer takes its centre to the other side.
  Motion of_fastest(std::vector<Real> speed, const Vec3& way) const {
    Motion fastest;
    if (way == Vec3{}) return fastest;
    const std::vector<Real> thickness = thicknesses(blocks_, normalized(way), there_);
    for (std::size_t b = 0; b < speed.size(); ++b) {
      if (held_[b] || !there_[b]) speed[b] = 0;
      if (speed[b] == 0 && thickness[b] < infinite &&
          (fastest.obstacle == none || thickness[b] < thickness[fastest.obstacle]))
        fastest.obstacle = static_cast<Index>(b);
    }
    if (fastest.obstacle == none) return fastest;
    fastest.obstacle_thickness = thickness[fastest.obstacle];
    for (std::size_t b = 0; b < speed.size(); ++b) {
      const Real size = 0.5 * (thickness[b] + fastest.obstacle_thickness);
      if (speed[b] == 0 || speed[b] / size <= fastest.rate()) continue;
      fastest.size = size;
      fastest.speed = speed[b];
      fastest.block = static_cast<Index>(b);
      fastest.block_thickness = thickness[b];
    }
    return fastest;
  }

  const Model& model_;
  const BlockArrays& blocks_;
  Flags there_, held_, touches_;  ///< [B] as the analysis begins; held: in x, y and z
};

const AnalysisStage* longest_dynamic_step(const Analysis& analysis) {
  const AnalysisStage* longest = nullptr;
  for (const AnalysisStage& stage : analysis.stages)
    if (stage.type == AnalysisType::dynamic && (!longest || stage.time_step > longest->time_step))
      longest = &stage;
  return longest;
}

/// s
Real dynamic_duration(const Analysis& analysis) {
  Real duration = 0;
  for (const AnalysisStage& stage : analysis.stages)
    if (stage.type == AnalysisType::dynamic)
      duration += stage.time_step * static_cast<Real>(stage.steps);
  return duration;
}

std::string told(const Motion& motion, Real time_step) {
  const Real way = time_step * motion.speed;
  if (motion.block == none)
    return fmt::format(
        "blocks of {:.2g} m at {:.2g} m/s (a fall by their size) move by {:.2g} of their size in a "
        "step, which takes many iterations or is divided",
        motion.size, motion.speed, way / motion.size);
  const std::string obstacle = fmt::format("rock like block {} ({:.2g} m thick)",
                                           motion.obstacle + 1, motion.obstacle_thickness);
  return fmt::format(
      "block {} ({:.2g} m thick) {} {:.2g} m/s and moves by {:.2g} m in a step; {}",
      motion.block + 1, motion.block_thickness, motion.falls ? "may fall at" : "starts at",
      motion.speed, way,
      way > motion.size
          ? "a step that would take it through " + obstacle + " is divided"
          : "an impact on " + obstacle + " takes many iterations, or the step is divided");
}

}  // namespace

void warn_of_long_contact_steps(const Model& model, const BlockArrays& blocks,
                                const CoverArrays& covers, const FixedPoints& fixed,
                                const std::vector<RigidVelocity>& velocities, Terminal& terminal) {
  if (!has_contact(model)) return;
  const AnalysisStage* stage = longest_dynamic_step(*model.analysis);
  const Start start(model, blocks, covers, fixed);
  if (!stage || !start.holds_several()) return;
  std::vector<Motion> motions{start.of_rest()};
  for (const RigidVelocity& given : velocities) motions.push_back(start.of_thrown(given));
  if (model.gravity != Vec3{})
    motions.push_back(start.of_fallen(dynamic_duration(*model.analysis)));
  const Motion& worst =
      *std::max_element(motions.begin(), motions.end(),
                        [](const Motion& a, const Motion& b) { return a.rate() < b.rate(); });
  if (stage->time_step * worst.rate() <= long_way) return;
  Place place = stage->place;
  place.key += ".time_step";
  terminal.warn(diagnostic_line(
      {place,
       fmt::format("is {:.3g} s, long for contact: {}. {:.1g} s is a good start", stage->time_step,
                   told(worst, stage->time_step), good_way / worst.rate())}));
}

}  // namespace rockfold
