#include "src/run/run_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "host/bolting/bolt_elements.hpp"
#include "host/cover/points/joint_water.hpp"
#include "host/direct/multifrontal.hpp"
#include "kernels/integrate/moments.hpp"
#include "kernels/time/motion.hpp"
#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/timer.hpp"
#include "src/base/vector.hpp"
#include "src/run/base_motion.hpp"
#include "src/run/contact_setup.hpp"
#include "src/run/gone_rock.hpp"
#include "src/run/letting_go.hpp"
#include "src/run/loose_parts.hpp"
#include "src/run/made_energy.hpp"
#include "src/run/moving_water.hpp"
#include "src/run/records/block_motion.hpp"
#include "src/run/records/block_stress.hpp"
#include "src/run/records/recorder.hpp"
#include "src/run/records/rest.hpp"
#include "src/run/refusal.hpp"
#include "src/run/rigid_motion.hpp"
#include "src/run/speck_advice.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

/// Of its energy, what contact may make out of nothing in a step; more, and it is taken in parts, in these at most.
constexpr Real most_energy_made = 1e-3;
constexpr Index most_exact_parts = 16;

std::vector<ElasticMaterial> elastic_materials(const Model& model) {
  std::vector<ElasticMaterial> materials;
  for (const Material& m : model.materials)
    materials.push_back({m.density, m.young_modulus, m.poisson_ratio});
  return materials;
}

MotionSetup make_setup(const RunInput& input, const PieceMoments& moments,
                       const std::vector<ElasticMaterial>& materials, const MovingWater& water) {
  const Analysis& analysis = *input.model.analysis;
  MotionSetup setup{input.covers, moments, materials, input.fixed};
  setup.gravity = input.model.gravity;
  setup.loads = input.loads;
  setup.beta = analysis.newmark_beta;
  setup.gamma = analysis.newmark_gamma;
  setup.damping = {analysis.rayleigh_alpha, analysis.rayleigh_beta};
  setup.quiet = input.quiet;
  setup.water = water.at_start();
  if (input.water) setup.water_sides = static_cast<Index>(input.water->sides().size());
  setup.initial_stress = input.model.initial_stress;
  setup.base_acceleration = ground_acceleration(input.model);
  setup.large = analysis.large();
  setup.dynamic_ratio = analysis.stages[0].share_handed_on();
  setup.solver.tolerance = input.model.solver.tolerance;
  setup.solver.max_iterations = input.model.solver.max_iterations;
  setup.preconditioner = input.model.solver.preconditioner;
  setup.direct = [] { return host::make_direct_solver(); };
  if (input.bolts) setup.bolts = &input.bolts->arrays;
  if (input.contact) {
    setup.surfaces = &input.contact->surfaces;
    setup.surface_points = input.contact->points;
    setup.contact = contact_options(input.model, input.blocks);
    setup.contact_iterations = input.model.contact.max_iterations;
  }
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

/// The analysis under way: what its three kinds share.
class Run {
 public:
  Run(const RunInput& input, const PieceMoments& moments, const StoreState& store,
      RunResult& result, Motion& motion, MovingWater& water, const Checkpoints& checkpoints,
      const Watch& watch)
      : input_(input),
        moments_(moments),
        analysis_(*input.model.analysis),
        result_(result),
        motion_(motion),
        water_(water),
        recorder_(input, moments, store, result),
        checkpoints_(checkpoints),
        watch_(watch),
        letting_go_(input, moments) {
    if (!analysis_.max_displacement_ratio) return;
    watched_.emplace(input.block_vertices);
    limit_ = *analysis_.max_displacement_ratio * half_height(input);
  }

  /// Goes back to a checkpoint.
  void restore(std::span<const std::byte> checkpoint);
  void go(Progress& progress);
  /// What the result says of the end.
  void summarise();

 private:
  std::vector<BlockMotion> unbalanced_acceleration() const;
  void begin(const AnalysisStage& stage, Progress& progress);
  void excavate();
  void settle(const AnalysisStage& stage, Progress& progress);
  void begin_phase(Progress& progress);
  StepCourse course_to(Real end) const;
  void record_start();
  void watch_energy(Index step);
  void go_on(const AnalysisStage& stage, Progress& progress);
  void pass(Archive& archive);
  void save_checkpoint();
  void save_checkpoint_if_due();
  bool may_choose_scheme() const;
  /// Where a step ends or has been divided: whether the rest is explicit.
  void choose_scheme(Real dt, bool ends);
  /// Counts those of an explicit step.
  void note_substeps(const SolveReport& report, Index step);
  void save_motion();
  void solve_static();
  void start(const AnalysisStage& stage);
  void record_contacts();
  void require_stable_step(const AnalysisStage& stage);
  bool take_step(Index step, Real dt);
  void count(const SolveReport& report);
  bool accept(const SolveReport& report, Index step, Real time);

  const RunInput& input_;
  const PieceMoments& moments_;
  const Analysis& analysis_;
  RunResult& result_;
  Motion& motion_;
  MovingWater& water_;
  Recorder recorder_;
  const Checkpoints& checkpoints_;
  const Watch& watch_;
  Then then_ = Then::go_on;  ///< what the watch says
  Timer since_checkpoint_;
  RunPosition at_;
  Index told_from_ = 0;   ///< steps before the phase of progress under way
  LettingGo letting_go_;  ///< of the stage
  /// What save_motion() keeps of the counts: a part of a step that a signal ends has not been.
  struct Counts {
    RunResult::Iterations iterations;
    Preconditioner preconditioner;
    Real support_gap;
    Index newton;
  } counts_{};
  Index substeps_ = 0;  ///< of the last step
  std::optional<TrackedPoints> watched_;
  Real limit_ = 0;
  std::vector<ContactPoint> start_;  ///< at step 0
};

void Run::count(const SolveReport& report) {
  result_.iterations.pcg += report.iterations;
  result_.iterations.fallbacks += report.fallbacks;
  at_.newton += report.newton;
}

/// Counts a solve; where it failed, goes back to the last good state (step 0: the start, before anything was solved), stores it and
/// throws. False where a signal came in the meantime: the same, without the throw. Solves that a signal ends early may still come to balance,
/// in other last digits than without it.
bool Run::accept(const SolveReport& report, Index step, Real time) {
  count(report);
  if (report.iterations > 0) result_.preconditioner = report.preconditioner;
  result_.support_gap = report.gap;
  const bool interrupted = interrupt_signal != 0;
  if (report.converged && !interrupted) return true;
  const Trouble trouble =
      input_.contact && !interrupted ? find_trouble(input_, motion_) : Trouble{};
  motion_.restore();
  if (interrupted) {
    result_.iterations = counts_.iterations;
    result_.preconditioner = counts_.preconditioner;
    result_.support_gap = counts_.support_gap;
    at_.newton = counts_.newton;
    save_checkpoint();
  }
  recorder_.store(motion_, result_.steps);
  if (!interrupted) refuse(report, trouble, step, time, input_);
  result_.interrupted = true;
  return false;
}

void Run::note_substeps(const SolveReport& report, Index step) {
  if (report.substeps == 0) return;
  std::vector<BySubsteps>& all = result_.by_substeps;
  if (all.empty() || all.back().stage != at_.stage)
    all.push_back({at_.stage, step, 0, 0, 0, 0, 0, at_.work.iterated, at_.work.instead,
                   at_.by_substeps == 2 ? 1 : 0});
  BySubsteps& stage = all.back();
  stage.steps = step - stage.first + 1;
  stage.substeps += report.substeps;
  stage.visits += report.visits;
  stage.shortest = stage.shortest > 0 ? std::min(stage.shortest, report.shortest) : report.shortest;
  stage.added_mass = std::max(stage.added_mass, report.added_mass);
}

bool Run::may_choose_scheme() const {
  return at_.by_substeps == 0 && input_.contact &&
         may_choose(input_.model, analysis_.stages[at_.stage]);
}

void Run::choose_scheme(Real dt, bool ends) {
  if (!may_choose_scheme()) return;
  const ContactCount points = motion_.contact_count();
  SchemeWork work = at_.work;
  work.iterated += visits_of_iteration * static_cast<Real>(at_.newton) *
                   static_cast<Real>(points.open + points.stick + points.slide);
  if (is_dear(work)) {
    // To the end of the step, as far as iterations have been after.
    work.instead = motion_.substep_visits(dt, analysis_.stages[at_.stage].mass_scaling) *
                   (at_.end - at_.stage_began);
    at_.by_substeps = is_dear(work) ? 1 : 0;
  }
  if (ends || at_.by_substeps != 0) at_.work = work;
}

void Run::save_motion() {
  motion_.save();
  counts_ = {result_.iterations, result_.preconditioner, result_.support_gap, at_.newton};
}

void Run::solve_static() {
  save_motion();
  const Timer timer;
  const SolveReport report = motion_.solve_static();
  result_.seconds.solve += timer.seconds();
  accept(report, result_.steps + 1, motion_.time());
}

/// One step. Where a part of it does not converge, or moves further than max_displacement_ratio allows, what is left of it is taken in
/// parts half as long. False where a signal ended it.
bool Run::take_step(Index step, Real dt) {
  const Timer timer;
  RunPosition& at = at_;
  if (!at.under_way) {
    at.parts = at.needed = at.under_way = 1;
    at.done = 0;
    at.inverted = none;
    at.end = motion_.time() + dt;
  }
  const auto halve = [&] {
    motion_.restore();
    at.parts *= 2;
    at.done *= 2;
  };
  while (at.done < at.parts) {
    if (at.parts > 1) save_checkpoint_if_due();
    save_motion();
    water_.begin_step(motion_, at.settled ? motion_.time() + dt / at.parts : motion_.time(),
                      result_.steps == 0);
    SolveReport report = motion_.step(dt / at.parts, at.done == 0, watched_ ? &*watched_ : nullptr,
                                      course_to(motion_.time() + dt / at.parts));
    // Newton's method may find its way by shorter steps.
    if (!report.converged && analysis_.large() && at.parts < most_substeps && !interrupt_signal) {
      if (report.inverted != none) at.inverted = report.inverted;
      count(report);
      halve();
      at.needed = at.parts;
      choose_scheme(dt, false);
      continue;
    }
    if (!report.converged && may_choose_scheme() && !interrupt_signal) {
      motion_.restore();
      at.by_substeps = 2;
      continue;
    }
    if (!report.converged && report.inverted == none) report.inverted = at.inverted;
    if (!accept(report, step, at.end)) break;
    const bool makes_energy =
        motion_.energy_made() > most_energy_made && at.parts < most_exact_parts;
    const bool goes_far = watched_ && motion_.largest_increment() > limit_;
    const bool crosses = motion_.crossing() > 1 && at.parts < most_substeps;
    if (!makes_energy && !goes_far && !crosses) {
      ++at.done;
      note_gain(input_, motion_, result_.made);
      note_substeps(report, step);
    } else if (makes_energy || crosses || at.parts < most_substeps) {
      halve();
    } else {
      throw Error(ErrorKind::analysis,
                  "step " + std::to_string(step) + ", time " + three_digits(at.end - dt) +
                      " s: even " + std::to_string(most_substeps) +
                      " substeps move a block vertex by " +
                      three_digits(motion_.largest_increment()) + " m each, more than " +
                      three_digits(limit_) + " m (analysis.max_displacement_ratio)" +
                      speck_advice(input_.blocks, input_.model.cut, none));
    }
  }
  if (!result_.interrupted) at.under_way = 0;
  substeps_ = at.parts;
  if (!result_.interrupted) choose_scheme(dt, true);
  result_.largest_substeps = std::max(result_.largest_substeps, at.parts);
  if (at.needed > 1 && !result_.interrupted) {
    ++result_.divided_steps;
    result_.divided_in_stage.resize(analysis_.stages.size());
    ++result_.divided_in_stage[at_.stage];
    result_.most_parts = std::max(result_.most_parts, at.needed);
  }
  result_.seconds.solve += timer.seconds();
  return !result_.interrupted;
}

/// Schemes that are stable for short steps only blow up beyond them.
void Run::require_stable_step(const AnalysisStage& stage) {
  const Real beta = analysis_.newmark_beta, gamma = analysis_.newmark_gamma;
  if (stage.type != AnalysisType::dynamic || gamma < 0.5 || beta >= gamma / 2) return;
  const Real frequency = motion_.largest_frequency();
  const Real critical = 1 / (frequency * std::sqrt(gamma / 2 - beta));
  if (stage.time_step <= critical) return;
  throw Error(ErrorKind::model,
              "found " + three_digits(stage.time_step) + " s, longer than the critical step " +
                  three_digits(critical) + " s of newmark = {beta = " + three_digits(beta) +
                  ", gamma = " + three_digits(gamma) +
                  "} on these covers (largest natural frequency " + three_digits(frequency) +
                  " rad/s): use a shorter one, or beta >= gamma / 2, which is stable for any step",
              Place{stage.place.file, stage.place.line, stage.place.column,
                    stage.place.key + ".time_step"});
}

/// Of a stage that goes on in time: its first acceleration.
void Run::start(const AnalysisStage& stage) {
  const Timer timer;
  save_motion();
  accept(motion_.start(stage.time_step), result_.steps, motion_.time());
  result_.seconds.solve += timer.seconds();
  if (!result_.interrupted) require_stable_step(stage);
}

void Run::record_contacts() {
  if (!input_.contact) return;
  result_.contacts = motion_.contact_count();
  ContactHistory& history = result_.contact_history;
  history.open.push_back(result_.contacts.open);
  history.stick.push_back(result_.contacts.stick);
  history.slide.push_back(result_.contacts.slide);
  history.iterations.push_back(at_.newton);
  history.substeps.push_back(substeps_);
  result_.iterations.open_close += at_.newton;
  at_.newton = substeps_ = 0;
}

/// Takes away the rock that the stage now begun takes; there may be none.
void Run::excavate() {
  const GoneRock gone = gone_rock(input_, at_.stage);
  if (gone.block.empty()) return;
  motion_.excavate(gone);
  at_.walls_before = 1;
  recorder_.leave_out(gone);
}

void Run::begin(const AnalysisStage& stage, Progress& progress) {
  if (!at_.begun) {
    const bool settles = lets_go(stage, input_.blocks);
    at_.stage_began = motion_.time();
    if (at_.stage > 0) motion_.begin_stage(settles ? 0 : stage.share_handed_on());
    if (stage.excavate != 0) {
      excavate();
    } else if (!stage.release.empty()) {
      at_.walls_before *= motion_.walls();
      motion_.begin_release();
    }
    motion_.install_bolts(at_.stage);
    at_.by_substeps = 0;
    at_.work = {};
    if (stage.reset_displacement) recorder_.count_from(motion_.state().displacement);
    at_.settled = settles ? 0 : 1;
    if (settles)
      letting_go_.begin(stage, motion_.state().displacement);
    else
      motion_.set_walls(course_to(motion_.time()).walls);
    at_.begun = 1;
  }
  if (!at_.settled) settle(stage, progress);
  if (!at_.started && !result_.interrupted && stage.type != AnalysisType::static_) start(stage);
  if (!result_.interrupted) at_.started = 1;
}

/// Tells of the steps that are left from here on, at their own rate.
void Run::begin_phase(Progress& progress) {
  told_from_ = result_.steps;
  progress.begin("analysis", analysis_.steps() - told_from_, "steps");
}

/// Quasi-static steps, while time stands still, until the rock that the stage excavates has been let go.
void Run::settle(const AnalysisStage& stage, Progress& progress) {
  const Settling& settling = letting_go_.settling();
  progress.begin("letting go stage " + std::to_string(stage.excavate), 0, "steps");
  while (!settling.done()) {
    progress.done(settling.settled().steps);
    if (!take_step(result_.steps + 1, settling.time_step())) return;
    letting_go_.add(motion_.state().displacement, substeps_);
    result_.interrupted = interrupt_signal != 0;
    save_checkpoint_if_due();
    if (result_.interrupted) return recorder_.store(motion_, result_.steps);
  }
  progress.done(settling.settled().steps);
  result_.settled.push_back(settling.settled());
  result_.settled.back().stage = at_.stage;
  motion_.begin_stage(stage.share_handed_on());
  at_.settled = 1;
  begin_phase(progress);
}

/// Of a step, or a part of one, to `end` s.
StepCourse Run::course_to(Real end) const {
  const AnalysisStage& stage = analysis_.stages[at_.stage];
  if (!at_.settled) {
    const Real start = motion_.walls(), left = static_cast<Real>(at_.parts - at_.done);
    return {true, false, 0, 0, start + (letting_go_.settling().walls() - start) / left};
  }
  const bool substeps = stage.scheme == Scheme::explicit_ || at_.by_substeps != 0;
  const bool relaxes = substeps && stage.type == AnalysisType::quasi_static;
  StepCourse course{false, substeps, relaxes ? stage.tolerance_of_balance : 0, stage.mass_scaling};
  if (!stage.release.empty())
    course.walls = walls_left(stage.release, end - at_.stage_began);
  else if (stage.excavate == 0)
    course.walls = motion_.walls();
  return course;
}

/// Step 0.
void Run::record_start() {
  start_ = motion_.contact_points();
  record_contacts();
  recorder_.record(motion_, 0, result_.interrupted);
  count_made_energy(nullptr, result_.energies.front(), result_.made);
}

/// Ends the run where contact makes energy, with the states so far.
void Run::watch_energy(Index step) {
  if (!input_.contact) return;
  const auto n = result_.energies.size();
  count_made_energy(&result_.energies[n - 2], result_.energies[n - 1], result_.made);
  try {
    require_little_made(result_.made, step, motion_.time());
  } catch (const Error&) {
    recorder_.store(motion_, step);
    throw;
  }
}

/// Where, how far and what has been recorded; the motion's own bytes follow.
void Run::pass(Archive& archive) {
  archive.pass(at_);
  pass_stages(archive, analysis_, at_.stage, at_.step);
  archive.pass(start_);
  letting_go_.pass(archive);
  water_.pass(archive);
  pass_histories(archive, result_);
  recorder_.pass(archive);
}

void Run::save_checkpoint() {
  if (!checkpoints_.save) return;
  const Timer timer;
  Archive archive;
  CheckpointFacts facts =
      make_checkpoint_facts(result_.steps, recorder_.stored_states(), motion_.time());
  archive.pass(facts);
  pass(archive);
  std::vector<std::byte> motion = motion_.bytes();
  archive.pass(motion);
  checkpoints_.save(archive.bytes());
  since_checkpoint_ = {};
  result_.seconds.output += timer.seconds();
}

void Run::save_checkpoint_if_due() {
  if (result_.interrupted || since_checkpoint_.seconds() >= checkpoints_.every) save_checkpoint();
}

void Run::restore(std::span<const std::byte> checkpoint) try {
  Archive archive(checkpoint);
  CheckpointFacts facts;
  archive.pass(facts);
  pass(archive);
  std::vector<std::byte> motion;
  archive.pass(motion);
  motion_.restore(motion);
  water_.restore(motion_);
  const GoneRock gone = gone_rock(input_, at_.begun ? at_.stage : at_.stage - 1);
  if (gone.block.empty()) return;
  motion_.leave_out(gone);
  recorder_.leave_out(gone);
} catch (const Error&) {
  throw;
} catch (const std::exception& error) {
  throw Error(ErrorKind::io,
              std::string("the checkpoint is not one of this analysis (") + error.what() + ")");
}

/// Takes the steps of a stage that are left.
void Run::go_on(const AnalysisStage& stage, Progress& progress) {
  while (at_.step < stage.steps && !result_.interrupted && then_ == Then::go_on) {
    const bool last = at_.step + 1 == stage.steps;
    const Index step = result_.steps + 1;
    if (stage.type == AnalysisType::static_)
      solve_static();
    else
      take_step(step, last ? stage.last_time_step.value_or(stage.time_step) : stage.time_step);
    if (result_.interrupted) return;
    result_.steps = step;
    ++at_.step;
    record_contacts();
    recorder_.record(motion_, step, last);
    watch_energy(step);
    if (watch_)
      then_ = watch_(
          {at_.stage, at_.step, motion_.time(), start_, motion_.state().displacement, moments_});
    result_.interrupted = interrupt_signal != 0;
    save_checkpoint_if_due();
    if (result_.interrupted) recorder_.store(motion_, step);
    progress.done(step - told_from_);
  }
}

void Run::go(Progress& progress) {
  if (!checkpoints_.from.empty()) restore(checkpoints_.from);
  begin_phase(progress);
  while (at_.stage < std::ssize(analysis_.stages) && !result_.interrupted && then_ != Then::end) {
    const AnalysisStage& stage = analysis_.stages[at_.stage];
    then_ = Then::go_on;
    begin(stage, progress);
    if (result_.energies.empty()) record_start();
    go_on(stage, progress);
    if (result_.interrupted) break;
    ++at_.stage;
    at_.step = at_.begun = at_.settled = at_.started = 0;
  }
  progress.end();
}

/// Of blocks at the end of a quasi-static step, which begins at rest, m/s²; empty where the run ends with another.
std::vector<BlockMotion> Run::unbalanced_acceleration() const {
  const auto last = std::min<std::size_t>(at_.stage, analysis_.stages.size() - 1);
  if (analysis_.stages[last].type != AnalysisType::quasi_static) return {};
  return average_block_motion(input_.covers, moments_, motion_.state().acceleration,
                              input_.blocks.block_count());
}

void Run::summarise() {
  const Model& model = input_.model;
  RunResult& result = result_;
  result.time = motion_.time();
  result.seconds.contact = motion_.contact_seconds();
  result.seconds.solve -= result.seconds.contact;
  result.energy = motion_.energy();
  if (input_.contact) result.contacts = motion_.contact_count();
  if (at_.begun && !at_.settled) {
    result.settling = letting_go_.settling().settled();
    result.settling->stage = at_.stage;
  }
  result.reactions = motion_.reactions();
  const std::vector<Vec3> whole = motion_.state().displacement, counted = recorder_.counted(whole);
  result.gone = recorder_.gone();
  result.walls = at_.walls_before * motion_.walls();
  const Index blocks = input_.blocks.block_count();
  const bool large = analysis_.large();
  result.conditions =
      sum_reactions(input_.covers, input_.fixed, result.reactions,
                    large ? whole : std::vector<Vec3>{}, static_cast<Index>(model.fixed.size()));
  result.off_place = find_farthest_off_place(input_.fixed, model.fixed, whole, result.time);
  result.blocks = average_block_motion(input_.covers, moments_, counted, blocks, large);
  const auto in_all = average_block_motion(input_.covers, moments_, whole, blocks, large);
  for (std::size_t b = 0; b < in_all.size(); ++b) result.blocks[b].volume = in_all[b].volume;
  const std::vector<Stress> stress = motion_.element_stress();
  result.block_stress = average_block_stress(input_.covers, moments_, stress, blocks);
  result.strength = find_strength(input_.covers, moments_, stress, model.materials);
  const std::vector<BlockMotion> acceleration = unbalanced_acceleration();
  if (!acceleration.empty())
    result.unbalanced = find_unbalanced(input_, acceleration, result.conditions, result.gone);
  recorder_.find_support(motion_, result);
  if (input_.contact) {
    result.met = met_surfaces(model, motion_.surfaces_that_met());
    result.water = water_.at_end(motion_);
    result.rest =
        find_rest(input_, result.blocks, in_all,
                  average_block_motion(input_.covers, moments_, motion_.state().velocity, blocks),
                  acceleration, start_, whole, result.gone);
    result.rest->since = recorder_.at_rest_since();
    for (const Index e : input_.fixed.points.element)
      if (e != none) result.courses[block_of(input_.covers, e)].held = 1;
  }
  result.largest_displacement = find_largest_displacement(input_.covers, moments_, counted);
  if (large && result.largest_displacement.length <= way_of_rounding(input_))
    result.largest_displacement = {};
}

}  // namespace

StageKeys keys_of_analysis(const Model& model) {
  StageKeys keys{"the analysis",
                 {"gravity", "material", "cover", "fixed", "traction", "point_load",
                  "quiet_boundary", "initial_velocity", "initial_stress", "base_acceleration",
                  "monitor", "analysis", "step", "solver", "output"}};
  if (has_bolts(model))
    for (const char* section : {"bolt_type", "bolt", "bolt_pattern"})
      keys.keys.emplace_back(section);
  if (has_shotcrete(model)) keys.keys.emplace_back("shotcrete");
  if (has_contact(model))
    for (const char* section : {"joint_material", "contact", "contact_pair", "reduction", "water"})
      keys.keys.emplace_back(section);
  if (std::any_of(model.tables.begin(), model.tables.end(), std::mem_fn(&TableFile::is_history)))
    keys.keys.emplace_back("table");
  return keys;
}

RunResult run_analysis(const RunInput& input, const StoreState& store, Progress& progress,
                       const Checkpoints& checkpoints, const Watch& watch) {
  RunResult result;
  const Timer timer;
  if (input.model.analysis->has(AnalysisType::static_))
    require_no_loose_parts(input.covers, input.fixed);
  const PieceMoments moments = piece_moments(input.covers);
  const std::vector<ElasticMaterial> materials = elastic_materials(input.model);
  MovingWater water(input);
  Motion motion(make_setup(input, moments, materials, water));
  if (!input.velocities.empty())
    motion.set_motion(initial_motion(input.covers, moments, materials, input.velocities));
  result.seconds.assemble = timer.seconds();

  Run run(input, moments, store, result, motion, water, checkpoints, watch);
  run.go(progress);
  run.summarise();
  return result;
}

}  // namespace rockfold
