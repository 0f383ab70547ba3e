#include "src/run/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "kernels/integrate/moments.hpp"
#include "src/base/archive.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/run/records/block_motion.hpp"

namespace rockfold {
namespace {

/// deg, of which tan is `factor` times smaller.
Real divided_angle(Real degrees, Real factor) {
  const Real radian = std::numbers::pi / 180;
  return std::atan(std::tan(degrees * radian) / factor) / radian;
}

bool moved_too_far(const Model& model, const Vec3& displacement, Real volume) {
  return norm(displacement) > model.reduction->max_displacement * std::cbrt(volume);
}

/// Ends a trial once a block has moved too far since displacements count.
class FailureWatch {
 public:
  explicit FailureWatch(const RunInput& input) : input_(input) {}

  Then operator()(const StepDone& done) {
    const std::vector<AnalysisStage>& stages = input_.model.analysis->stages;
    if (done.stage != stage_ && stages[done.stage].reset_displacement) start_ = last_;
    stage_ = done.stage;
    last_ = done.displacement;
    std::vector<Vec3> counted = done.displacement;
    for (std::size_t p = 0; p < start_.size(); ++p) counted[p] -= start_[p];
    const std::vector<BlockMotion> motion = average_block_motion(
        input_.covers, done.moments, counted, input_.blocks.block_count(), true);
    for (std::size_t b = 0; b < motion.size(); ++b)
      failed_ =
          failed_ || moved_too_far(input_.model, motion[b].displacement, input_.blocks.volume[b]);
    return failed_ ? Then::end : Then::go_on;
  }
  bool failed() const { return failed_; }

 private:
  const RunInput& input_;
  Index stage_ = 0;
  std::vector<Vec3> start_, last_;  ///< of the covers, m; start_ empty: all count
  bool failed_ = false;
};

/// A trial's steps are told under its factor.
class TrialProgress : public Progress {
 public:
  TrialProgress(Progress& outer, Real factor)
      : outer_(outer), phase_(fmt::format("strength / {:.4g}", factor)) {}
  void begin(std::string_view, std::int64_t total, std::string_view unit) override {
    outer_.begin(phase_, total, unit);
  }
  void done(std::int64_t count) override { outer_.done(count); }
  void end() override { outer_.end(); }

 private:
  Progress& outer_;
  std::string phase_;
};

RunInput with_model(const RunInput& input, const Model& model) {
  return {model,         input.covers, input.blocks,     input.fixed,          input.monitors,
          input.loads,   input.quiet,  input.velocities, input.block_vertices, input.mesh,
          input.contact, input.water,  input.bolts};
}

/// The search under way.
class Search {
 public:
  Search(const RunInput& input, Progress& progress)
      : input_(input), progress_(progress), weaker_(input.model) {}

  Reduction run() {
    const auto& [least, most] = input_.model.reduction->factors;
    Real low = least, high = most;
    Real next = low < 1 && 1 < high ? 1 : 0.5 * (low + high);
    while (high - low > input_.model.reduction->tolerance) {
      (stands(next) ? low : high) = next;
      if (found_.interrupted) return found_;
      next = 0.5 * (low + high);
    }
    // Ends that the search has not left are not known yet.
    if (!found_.fails()) stands(most);
    if (!found_.stands() && !found_.interrupted) stands(least);
    return found_;
  }

 private:
  bool stands(Real factor) {
    weaker_.joint_materials = with_strength_divided(input_.model.joint_materials, factor);
    const RunInput input = with_model(input_, weaker_);
    TrialProgress progress(progress_, factor);
    FailureWatch watch(input);
    const RunResult run = run_analysis(
        input, [](const StoredState&) {}, progress, {}, std::ref(watch));
    found_.interrupted = run.interrupted;
    if (run.interrupted) return false;
    const bool stands = !watch.failed() && run.rest->at_rest;
    found_.trials.push_back({factor, run.time, run.rest->speed, stands});
    return stands;
  }

  const RunInput& input_;
  Progress& progress_;
  Model weaker_;
  Reduction found_;
};

void pass(Archive& archive, std::vector<ReductionTrial>& trials) {
  auto count = static_cast<std::uint64_t>(trials.size());
  archive.pass(count);
  trials.resize(std::min<std::uint64_t>(count, 1 << 16));
  for (ReductionTrial& t : trials) archive.all(t.factor, t.time, t.speed, t.stands);
}

std::optional<Real> extreme(const std::vector<ReductionTrial>& trials, bool stands) {
  std::optional<Real> found;
  for (const ReductionTrial& trial : trials)
    if (trial.stands == stands && (!found || (trial.factor > *found) == stands))
      found = trial.factor;
  return found;
}

}  // namespace

std::optional<Real> Reduction::stands() const {
  return extreme(trials, true);
}
std::optional<Real> Reduction::fails() const {
  return extreme(trials, false);
}
std::optional<Real> Reduction::factor() const {
  if (!stands() || !fails()) return {};
  return 0.5 * (*stands() + *fails());
}
Real Reduction::shown() const {
  return fails().value_or(stands().value_or(1));
}

std::vector<JointMaterial> with_strength_divided(std::vector<JointMaterial> joints, Real factor) {
  for (JointMaterial& joint : joints) {
    joint.friction_angle = divided_angle(joint.friction_angle, factor);
    if (joint.residual_friction_angle)
      joint.residual_friction_angle = divided_angle(*joint.residual_friction_angle, factor);
    joint.cohesion /= factor;
    joint.residual_cohesion /= factor;
    joint.dilation_angle = std::min(joint.dilation_angle, joint.friction_angle);
  }
  return joints;
}

Reduction find_reduction(const RunInput& input, Progress& progress) {
  if (!input.contact)
    throw Error(ErrorKind::model, {{input.model.reduction->place,
                                    "the rock is one block: there is no joint whose strength "
                                    "could be reduced"}});
  return Search(input, progress).run();
}

Index most_trials(const StrengthReduction& spec) {
  const Real width = (spec.factors[1] - spec.factors[0]) / spec.tolerance;
  return 2 + static_cast<Index>(std::ceil(std::max(0.0, std::log2(width))));
}

std::vector<Index> failing_blocks(const Model& model, const BlockArrays& blocks,
                                  const RunResult& run) {
  std::vector<Index> failing = run.rest->moving;
  for (Index b = 0; b < blocks.block_count(); ++b)
    if (moved_too_far(model, run.blocks[b].displacement, blocks.volume[b])) failing.push_back(b);
  std::sort(failing.begin(), failing.end());
  failing.erase(std::unique(failing.begin(), failing.end()), failing.end());
  return failing;
}

std::vector<std::byte> packed(const Reduction& reduction) {
  Archive archive;
  Reduction copy = reduction;
  pass(archive, copy.trials);
  return archive.bytes();
}

Reduction unpacked_reduction(std::span<const std::byte> bytes) {
  Archive archive(bytes);
  Reduction reduction;
  pass(archive, reduction.trials);
  return reduction;
}

}  // namespace rockfold
