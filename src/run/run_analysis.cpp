#include "src/run/run_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "host/direct/multifrontal.hpp"
#include "kernels/constraints/held_parts.hpp"
#include "kernels/integrate/moments.hpp"
#include "kernels/time/motion.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/timer.hpp"
#include "src/base/vector.hpp"
#include "src/run/block_motion.hpp"
#include "src/run/block_stress.hpp"
#include "src/run/recorder.hpp"
#include "src/run/rigid_motion.hpp"

namespace rockfold {
namespace {

/// Each doubling of the substeps halves the way of a substep; this many and the motion is not a motion any more.
constexpr int most_substeps = 1024;

std::vector<ElasticMaterial> elastic_materials(const Model& model) {
  std::vector<ElasticMaterial> materials;
  for (const Material& m : model.materials)
    materials.push_back({m.density, m.young_modulus, m.poisson_ratio});
  return materials;
}

MotionSetup make_setup(const RunInput& input, const PieceMoments& moments,
                       const std::vector<ElasticMaterial>& materials) {
  const Analysis& analysis = *input.model.analysis;
  MotionSetup setup{input.covers, moments, materials, input.fixed};
  setup.gravity = input.model.gravity;
  setup.loads = input.loads;
  setup.beta = analysis.newmark_beta;
  setup.gamma = analysis.newmark_gamma;
  setup.damping = {analysis.rayleigh_alpha, analysis.rayleigh_beta};
  setup.quiet = input.quiet;
  setup.initial_stress = input.model.initial_stress;
  setup.base_acceleration = base_acceleration(input.model);
  setup.large = analysis.large();
  setup.dynamic_ratio = analysis.type == AnalysisType::quasi_static ? 0 : analysis.dynamic_ratio;
  setup.solver.tolerance = input.model.solver.tolerance;
  setup.solver.max_iterations = input.model.solver.max_iterations;
  setup.preconditioner = input.model.solver.preconditioner;
  setup.direct = [] { return host::make_direct_solver(); };
  return setup;
}

/// Half the extent of the blocks' vertices in z: what max_displacement_ratio refers to.
Real half_height(const RunInput& input) {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  const MaterialPoints& points = input.block_vertices;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Real z = point_position(input.covers, points, n)[2];
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return 0.5 * (high - low);
}

std::string number(Real value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

Index block_of(const CoverArrays& covers, Index element) {
  const Index parts = covers.parts_per_cell(), whole = parts * covers.regular_count();
  return element < whole ? covers.regular_block[element / parts]
                         : covers.piece_block[covers.piece_begin[element - whole]];
}

[[noreturn]] void refuse(const SolveReport& report, Index step, Real time, const RunInput& input) {
  std::string what = "step " + std::to_string(step) + ", time " + number(time) + " s: ";
  if (report.inverted != none) {
    const Vec3 at =
        input.covers.lattice.cell_centre(element_nodes(input.covers, report.inverted).cell);
    what += "block " + std::to_string(block_of(input.covers, report.inverted) + 1) +
            " is turned inside out near (" + number(at[0]) + ", " + number(at[1]) + ", " +
            number(at[2]) +
            "): loads or velocities are too large for its stiffness (material.young_modulus)";
  } else if (!std::isfinite(report.residual)) {
    what += input.model.analysis->type == AnalysisType::static_
                ? "the solver broke down (solver.preconditioner), or nothing resists the loads"
                : "the motion grew beyond all numbers: it is not stable (analysis.time_step, "
                  "analysis.newmark), or nothing resists it";
  } else {
    const SolverSpec& solver = input.model.solver;
    if (report.residual <= solver.tolerance)
      what += "the forces are balanced (residual " + number(report.residual) +
              "), but supports are still " + number(report.gap) +
              " of the largest displacement from their places after " +
              std::to_string(report.iterations) +
              " iterations: held points contradict each other "
              "([[fixed]]), or are too many for the covers near them (cover.spacing)";
    else
      what += "the solver did not converge: residual " + number(report.residual) + " after " +
              std::to_string(report.iterations) + " iterations, tolerance " +
              number(solver.tolerance) + " (solver.tolerance, solver.max_iterations)";
  }
  throw Error(ErrorKind::analysis, what);
}

/// The analysis under way: what its three kinds share.
class Run {
 public:
  Run(const RunInput& input, const PieceMoments& moments, const StoreState& store,
      RunResult& result, Motion& motion)
      : input_(input),
        analysis_(*input.model.analysis),
        result_(result),
        motion_(motion),
        recorder_(input, moments, store, result) {
    if (!analysis_.max_displacement_ratio) return;
    watched_.emplace(input.block_vertices);
    limit_ = *analysis_.max_displacement_ratio * half_height(input);
  }

  void solve_static();
  void require_stable_step();
  void march(Progress& progress);

 private:
  bool take_step(Index step);
  bool accept(const SolveReport& report, Index step, Real time);

  const RunInput& input_;
  const Analysis& analysis_;
  RunResult& result_;
  Motion& motion_;
  Recorder recorder_;
  std::optional<TrackedPoints> watched_;
  Real limit_ = 0;
};

/// Counts a solve; where it failed, goes back to the last good state (step 0: the start, before anything was solved), stores it and
/// throws. False where a signal ended it: the same, without the throw.
bool Run::accept(const SolveReport& report, Index step, Real time) {
  result_.iterations.pcg += report.iterations;
  result_.iterations.fallbacks += report.fallbacks;
  result_.preconditioner = report.preconditioner;
  result_.support_gap = report.gap;
  if (report.converged) return true;
  motion_.restore();
  recorder_.store(motion_, std::max<Index>(step - 1, 0));
  if (interrupt_signal == 0) refuse(report, step, time, input_);
  result_.interrupted = true;
  return false;
}

void Run::solve_static() {
  recorder_.record(motion_, 0, false);
  motion_.save();
  const Timer timer;
  const SolveReport report = motion_.solve_static();
  result_.seconds.solve += timer.seconds();
  if (!accept(report, 1, motion_.time())) return;
  result_.steps = 1;
  recorder_.record(motion_, 1, true);
}

/// One step, in as many equal parts as it takes to converge and as max_displacement_ratio asks for. False where a signal ended it.
bool Run::take_step(Index step) {
  const Timer timer;
  const Real start = motion_.time();
  const Real dt = step == analysis_.steps ? analysis_.last_time_step.value_or(analysis_.time_step)
                                          : analysis_.time_step;
  motion_.save();
  Index inverted = none;  // by a try with fewer substeps
  int needed = 1;         // substeps, for want of convergence
  for (int substeps = 1;; substeps *= 2) {
    if (substeps > most_substeps)
      throw Error(ErrorKind::analysis,
                  "step " + std::to_string(step) + ", time " + number(start) + " s: even " +
                      std::to_string(most_substeps) + " substeps move a block vertex by " +
                      number(motion_.largest_increment()) + " m each, more than " + number(limit_) +
                      " m (analysis.max_displacement_ratio)");
    SolveReport report = motion_.step(dt, substeps, watched_ ? &*watched_ : nullptr, limit_);
    if (report.inverted != none) inverted = report.inverted;
    // Newton's method may find its way by shorter steps.
    if (!report.converged && analysis_.large() && substeps < most_substeps && !interrupt_signal) {
      result_.iterations.pcg += report.iterations;
      result_.iterations.fallbacks += report.fallbacks;
      needed = 2 * substeps;
      motion_.restore();
      continue;
    }
    if (!report.converged) report.inverted = inverted;
    if (!accept(report, step, start + dt)) break;
    result_.largest_substeps = std::max(result_.largest_substeps, substeps);
    if (!watched_ || motion_.largest_increment() <= limit_) break;
    motion_.restore();
  }
  if (needed > 1 && !result_.interrupted) {
    ++result_.divided_steps;
    result_.most_parts = std::max(result_.most_parts, needed);
  }
  result_.seconds.solve += timer.seconds();
  return !result_.interrupted;
}

/// Schemes that are stable for short steps only blow up beyond them.
void Run::require_stable_step() {
  const Real beta = analysis_.newmark_beta, gamma = analysis_.newmark_gamma;
  if (analysis_.type != AnalysisType::dynamic || gamma < 0.5 || beta >= gamma / 2) return;
  const Real frequency = motion_.largest_frequency(analysis_.time_step);
  const Real critical = 1 / (frequency * std::sqrt(gamma / 2 - beta));
  if (analysis_.time_step <= critical) return;
  throw Error(ErrorKind::model,
              "found " + number(analysis_.time_step) + " s, longer than the critical step " +
                  number(critical) + " s of newmark = {beta = " + number(beta) +
                  ", gamma = " + number(gamma) + "} on these covers (largest natural frequency " +
                  number(frequency) +
                  " rad/s): use a shorter one, or beta >= gamma / 2, which is stable for any step",
              Place{analysis_.place.file, analysis_.place.line, analysis_.place.column,
                    "analysis.time_step"});
}

void Run::march(Progress& progress) {
  const Timer timer;
  motion_.save();
  accept(motion_.start(analysis_.time_step), 0, 0);
  result_.seconds.solve += timer.seconds();
  if (!result_.interrupted) require_stable_step();
  recorder_.record(motion_, 0, result_.interrupted);
  progress.begin("analysis", analysis_.steps, "steps");
  for (Index step = 1; step <= analysis_.steps && !result_.interrupted; ++step) {
    if (!take_step(step)) break;
    result_.steps = step;
    result_.interrupted = interrupt_signal != 0;
    recorder_.record(motion_, step, step == analysis_.steps || result_.interrupted);
    progress.done(step);
  }
  progress.end();
}

}  // namespace

RunResult run_analysis(const RunInput& input, const StoreState& store, Progress& progress) {
  RunResult result;
  const Timer timer;
  if (input.model.analysis->type == AnalysisType::static_) require_held(input.covers, input.fixed);
  const PieceMoments moments = piece_moments(input.covers);
  const std::vector<ElasticMaterial> materials = elastic_materials(input.model);
  Motion motion(make_setup(input, moments, materials));
  if (!input.velocities.empty())
    motion.set_motion(initial_motion(input.covers, moments, materials, input.velocities));
  result.seconds.assemble = timer.seconds();

  Run run(input, moments, store, result, motion);
  if (input.model.analysis->type == AnalysisType::static_)
    run.solve_static();
  else
    run.march(progress);

  result.time = motion.time();
  result.energy = result.energies.back();
  result.reactions = motion.reactions();
  const std::vector<Vec3> displacement = motion.state().displacement;
  const bool large = input.model.analysis->large();
  result.conditions = sum_reactions(input.covers, input.fixed, result.reactions,
                                    large ? displacement : std::vector<Vec3>{},
                                    static_cast<Index>(input.model.fixed.size()));
  result.off_place =
      find_farthest_off_place(input.fixed, input.model.fixed, displacement, result.time);
  result.blocks =
      average_block_motion(input.covers, moments, displacement, input.blocks.block_count(), large);
  const std::vector<Stress> stress = motion.element_stress();
  result.block_stress =
      average_block_stress(input.covers, moments, stress, input.blocks.block_count());
  result.strength = find_strength(input.covers, moments, stress, input.model.materials);
  result.largest_displacement = find_largest_displacement(input.covers, moments, displacement);
  return result;
}

}  // namespace rockfold
