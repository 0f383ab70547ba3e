#include "src/check/needs.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "host/files/load_files.hpp"
#include "host/flatten/lost_contact.hpp"
#include "host/joints/missed_rock.hpp"
#include "host/keyblock/thin_contacts.hpp"
#include "host/shapes/extents.hpp"
#include "src/app/examples.hpp"
#include "src/app/process/signals.hpp"
#include "src/base/error.hpp"
#include "src/base/place_text.hpp"
#include "src/base/seeds.hpp"
#include "src/base/vector.hpp"
#include "src/check/key_use.hpp"
#include "src/check/whole_model.hpp"
#include "src/model/jointed.hpp"
#include "src/model/openings.hpp"
#include "src/model/read/read_model.hpp"
#include "src/report/error_text.hpp"
#include "src/report/names.hpp"
#include "src/store/output_path.hpp"

namespace rockfold {

namespace {

/// A rotation θ that is taken for linear strains feigns a strain of 1 − cos θ: 2e-4 at this one, as
/// much as the elastic strain of rock near failure.
constexpr Real largest_small_rotation = 0.02;  // rad
/// Energy / largest energy of the motion that average acceleration, which keeps it, may lose.
constexpr Real largest_lost_share = 0.01;
/// m: rock that moves less is at rest but for rounding.
constexpr Real least_motion = 1e-10;

/// Of the largest displacement: above it the answer differs visibly from that of points held exactly; and in analyses that close gaps,
/// where it tells of supports that cannot all be kept.
constexpr Real largest_support_gap = 1e-3, largest_gap_at_rest = 1e-5;
/// Of the largest displacement, prescribed or found: springs as stiff as Rockfold makes them give way by that much only where another support pulls at them.
constexpr Real largest_share_off_place = 0.1;

Purpose purpose_of(Command command) {
  if (command == Command::support || command == Command::stability) return Purpose::support;
  if (command == Command::theory) return Purpose::theory;
  return command == Command::run || command == Command::demo ? Purpose::run : Purpose::cut;
}

void find_outside(const std::string& what, const Vec3& point, Index element, const Place& place,
                  std::vector<Diagnostic>& outside) {
  if (element != none) return;
  Place of_point = place;
  of_point.key += ".point";
  outside.push_back(
      {of_point, fmt::format("{}{} is not in the rock", given_place_text(point), what)});
}

/// The table of --table, which stands beside those of the model.
void add_table(Model& model, const Options& options) {
  if (!wants_support(options, model))
    throw Error(ErrorKind::usage,
                "lists key blocks, which `run` finds where the model has a [support]; `support` "
                "finds them without",
                Place{"--table", 0, 0, {}});
  const std::filesystem::path folder = std::filesystem::path(result_path(options)).parent_path();
  TableFile table;
  table.file = folder.empty() ? options.table : std::filesystem::absolute(options.table).string();
  model.tables.push_back(table);
}

/// Of two sets that draw the same numbers: their joints have the same relative places.
void warn_of_equal_seeds(const Model& model, Terminal& terminal) {
  std::map<std::uint64_t, const JointSet*> first;
  for (const JointSet& set : model.joint_sets) {
    if (!set.random) continue;
    const auto [before, is_new] = first.emplace(set.random->seed, &set);
    if (is_new) continue;
    Place place = set.place;
    place.key += ".random.seed";
    terminal.warn(diagnostic_line(
        {place,
         fmt::format("is {}, that of joint set '{}' too: both draw the same numbers, and their "
                     "joints lie alike; give each set its own",
                     set.random->seed, before->second->name)}));
  }
}

void warn_of_stiffness_without_springs(const Model& model, Terminal& terminal) {
  for (const Fixed& fixed : model.fixed) {
    if (!fixed.stiffness || fixed.method == FixMethod::penalty) continue;
    Place place = fixed.place;
    place.key += ".stiffness";
    terminal.warn(diagnostic_line(
        {place, "is of no use: points are held exactly. Springs are method = \"penalty\""}));
  }
}

}  // namespace

bool wants_run(const Options& options) {
  return options.command == Command::run || options.command == Command::demo;
}

bool wants_support(const Options& options, const Model& model) {
  return options.command == Command::support || (wants_run(options) && model.support);
}

bool wants_measures(const Options& options, const Model& model) {
  return options.command == Command::cut || model.cut.min_volume || model.cut.max_aspect_ratio ||
         (model.classification && wants_support(options, model));
}

void reseed(Model& model, std::uint64_t seed) {
  bool random = false;
  for (std::size_t s = 0; s < model.joint_sets.size(); ++s)
    if (auto& set = model.joint_sets[s]; set.random) {
      set.random->seed = seed_of_set(seed, s + 1);
      random = true;
    }
  if (model.theory && model.theory->monte_carlo) {
    model.theory->monte_carlo->seed = seed;
    random = true;
  }
  if (!random) return;
  if (!model.text.empty() && model.text.back() != '\n') model.text += '\n';
  model.text +=
      fmt::format("\n# Random joint sets drawn with --seed {} on the command line.\n", seed);
}

Model load_model(const Options& options, Terminal& terminal) {
  const Purpose purpose = purpose_of(options.command);
  Model model =
      options.command == Command::demo
          ? parse_model(find_example("slope").text, "slope.toml", options.overrides, purpose)
          : read_whole_model(options.input, options.model_text, options.overrides, purpose);
  if (options.seed) reseed(model, *options.seed);
  load_files(model);
  if (options.command == Command::support && !model.support) {
    model.support = SupportSpec{};
    model.support->stress = usual_joint_stress(model);
  }
  if (wants_support(options, model)) check_for(model, Purpose::support);
  if (!options.table.empty()) add_table(model, options);
  if (options.command != Command::theory &&
      std::filesystem::path(result_path(options)).extension() != ".vtkhdf")
    terminal.warn("ParaView knows result files by their name: let it end in .vtkhdf");
  require_loads_used(options, model, terminal);
  warn_of_model(model, terminal);
  if (options.command != Command::theory) warn_of_joints_beside_rock(model, terminal);
  if (wants_support(options, model)) warn_of_free_rock(model, terminal);
  return model;
}

void warn_of_model(const Model& model, Terminal& terminal) {
  for (const Diagnostic& warning : model.warnings) terminal.warn(diagnostic_line(warning));
  warn_of_equal_seeds(model, terminal);
}

void warn_of_joints_beside_rock(const Model& model, Terminal& terminal) {
  for (const Diagnostic& warning : files_out_of_scale(model))
    terminal.warn(diagnostic_line(warning));
  for (const Diagnostic& warning : joints_beside_rock(model))
    terminal.warn(diagnostic_line(warning));
}

void warn_of_free_rock(const Model& model, Terminal& terminal) {
  const SupportSpec spec = model.support.value_or(SupportSpec{});
  const auto continues = [](const Solid& solid) {
    return std::find(solid.continues.begin(), solid.continues.end(), true) != solid.continues.end();
  };
  if (!has_joints(model) || model.solids.empty() ||
      (!spec.joint_faces_only && !model.fixed.empty()) ||
      std::any_of(model.solids.begin(), model.solids.end(), continues))
    return;
  Place place = model.solids.front().place;
  place.key += ".continues";
  terminal.warn(diagnostic_line(
      {place,
       "no solid has any: all faces are free, the underside too, and blocks fall out of it. "
       "Name the faces beyond which the rock goes on, as in continues = [\"zmin\"]"}));
}

std::vector<Vec3> monitor_points(const Model& model) {
  std::vector<Vec3> points;
  for (const auto& monitor : model.monitors)
    if (monitor.is_of_rock()) points.push_back(monitor.point);
  return points;
}

void require_in_rock(const Model& model, const MaterialPoints& monitors) {
  std::vector<Diagnostic> outside;
  std::size_t n = 0;
  for (const Monitor& monitor : model.monitors)
    if (monitor.is_of_rock())
      find_outside(" of monitor " + monitor.name, monitor.point, monitors.element[n++],
                   monitor.place, outside);
  if (!outside.empty()) throw Error(ErrorKind::model, outside);
}

void warn_of_keys_without_use(const Model& model, Terminal& terminal) {
  warn_of_stiffness_without_springs(model, terminal);
  const Analysis given = *model.analysis, usual;
  if (given.has(AnalysisType::dynamic) || given.has(AnalysisType::quasi_static)) return;
  std::string keys;
  const auto name = [&](const char* key, bool is_given) {
    if (is_given) keys += (keys.empty() ? "analysis." : ", analysis.") + std::string(key);
  };
  name("dynamic_ratio", given.stages[0].dynamic_ratio != usual.stages[0].dynamic_ratio);
  name("max_displacement_ratio", given.max_displacement_ratio.has_value());
  name("newmark",
       given.newmark_beta != usual.newmark_beta || given.newmark_gamma != usual.newmark_gamma);
  name("rayleigh", given.rayleigh_alpha != 0 || given.rayleigh_beta != 0);
  if (!keys.empty()) terminal.warn("of no use in a static analysis, which has no time: " + keys);
}

void warn_of_conditional_stability(const Model& model, Terminal& terminal) {
  const Analysis& analysis = *model.analysis;
  const Real beta = analysis.newmark_beta, gamma = analysis.newmark_gamma;
  if (!analysis.has(AnalysisType::dynamic) || gamma >= 0.5) return;
  terminal.warn(
      fmt::format("newmark = {{beta = {}, gamma = {}}} adds energy to every vibration that damping "
                  "does not take: "
                  "gamma >= 0.5 does not",
                  beta, gamma));
}

void warn_of_cutting(const IntentReport& intent, Terminal& terminal) {
  if (!intent.doubts_decide) return;
  std::string names;
  for (const auto& name : intent.near_planes) names += (names.empty() ? "" : ", ") + name;
  const std::string what = intent.doubts == 1
                               ? "a cell or opening of the rock is"
                               : fmt::format("{} cells or openings of the rock are", intent.doubts);
  terminal.warn(
      fmt::format("{} about as wide as 1e-9 of the model's size, and blocks depend on it: what is "
                  "narrower is no block and no connection. They lie between: {}; the narrowest, "
                  "{:.2g} m wide, lies at {}. A joint that ends on another surface "
                  "should "
                  "reach past it",
                  what, names, intent.least_doubt, place_text(intent.doubt_at)));
}

void require_whole_contact(const BlockArrays& blocks, const Model& model) {
  const std::vector<LostContact> list = lost_contact(blocks);
  if (list.empty()) return;
  const auto off = [](const LostContact& c) { return std::max(c.lost, c.surplus); };
  const LostContact& worst = *std::max_element(
      list.begin(), list.end(),
      [&](const LostContact& a, const LostContact& b) { return off(a) < off(b); });
  const std::string& name = blocks.origins[worst.origin].name;
  Place place;
  for (const JointMesh& mesh : model.joint_meshes)
    if (mesh.name == name) place = mesh.place;
  throw Error(
      ErrorKind::analysis,
      fmt::format(
          "the contact of joint {} does not add up to its area: of {:.6g} m2 on block {}, {:.4g} "
          "m2 lean on nothing and {:.4g} m2 are counted twice, near {}{}. Factors of safety there "
          "would be wrong. Corners of its triangles that are given to fewer decimals make fewer "
          "slivers; please report the model",
          name, worst.area, worst.block + 1, worst.lost, worst.surplus, place_text(worst.place),
          list.size() > 1 ? fmt::format(" (one of {} places)", list.size()) : ""),
      place);
}

void warn_of_flagged_blocks(const BlockStatistics& statistics, const Model& model,
                            Terminal& terminal) {
  if (statistics.small_blocks > 0)
    terminal.warn(fmt::format("{} blocks are smaller than cut.min_volume = {} m3",
                              statistics.small_blocks, *model.cut.min_volume));
  if (statistics.elongated_blocks > 0)
    terminal.warn(fmt::format("{} blocks are more elongated than cut.max_aspect_ratio = {}",
                              statistics.elongated_blocks, *model.cut.max_aspect_ratio));
}

void warn_of_immobile_blocks(const BlockArrays& blocks, Terminal& terminal) {
  bool finite = blocks.block_count() == 0, free = finite;
  for (Index b = 0; b < blocks.block_count() && !free; ++b) {
    if (blocks.finite[b] == 0) continue;
    finite = true;
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
      free |= blocks.origins[blocks.face_origin[f]].kind != FaceOrigin::Kind::joint;
  }
  if (free) return;
  terminal.warn(
      finite
          ? "no block can move: every finite one is enclosed by other blocks, none has a free "
            "face. A face of a solid left out of continues, or an [[excavation]], would free some"
          : "no block can move: none is finite, each touches a face beyond which the rock "
            "continues. Fewer faces in continues, or more joints, would make finite blocks");
}

void warn_of_thin_contacts(const KeyblockReport& keyblocks, Terminal& terminal) {
  constexpr std::size_t most = 5;
  const std::vector<ThinContact> thin = thin_contacts(keyblocks);
  for (std::size_t i = 0; i < std::min(most, thin.size()); ++i)
    terminal.warn(fmt::format(
        "block {} leans with {:.1f} kN on {:.3g} m2 of {}, {:.2g} % of the area of its joints: "
        "the rock there may not bear it, and without it the block may move otherwise",
        thin[i].block + 1, thin[i].normal_force / 1e3, thin[i].area, thin[i].joint,
        100 * thin[i].share));
  if (thin.size() > most)
    terminal.warn(
        fmt::format("{} more contacts carry their blocks on less than {:g} % of the area "
                    "of their joints",
                    thin.size() - most, 100 * thin_contact_share));
}

void warn_of_partly_held(const StabilityReport& stability, Terminal& terminal) {
  if (stability.partly_held.empty()) return;
  terminal.warn(
      fmt::format("[[fixed]] holds block {}{} in some directions alone, and not at all for "
                  "`stability`, which knows held and "
                  "free blocks: on the safe side",
                  stability.partly_held.front() + 1,
                  stability.partly_held.size() > 1
                      ? fmt::format(" and {} more", stability.partly_held.size() - 1)
                      : ""));
}

void warn_of_large_rotation(const Model& model, const RunResult& run, Terminal& terminal) {
  if (model.analysis->large()) return;
  Real largest = 0;
  std::size_t at = 0;
  for (std::size_t b = 0; b < run.blocks.size(); ++b)
    if (norm(run.blocks[b].rotation) > largest) largest = norm(run.blocks[at = b].rotation);
  if (largest > largest_small_rotation)
    terminal.warn(fmt::format(
        "block {} turns by {:.3g} rad, but strains are those of small rotations: above {} rad "
        "its size and stress are not to be trusted",
        at + 1, largest, largest_small_rotation));
}

void warn_of_lost_energy(const Model& model, const RunResult& run, Terminal& terminal) {
  const Analysis& analysis = *model.analysis;
  const auto keeps_energy = [](const AnalysisStage& stage) {
    return stage.type == AnalysisType::dynamic && stage.dynamic_ratio == 1;
  };
  if (!std::all_of(analysis.stages.begin(), analysis.stages.end(), keeps_energy) ||
      analysis.newmark_beta != 0.25 || analysis.newmark_gamma != 0.5 ||
      run.largest_displacement.length < least_motion)
    return;
  Real largest = 0, lost = 0;
  for (const Energy& e : run.energies) {
    largest =
        std::max({largest, e.kinetic, std::abs(e.strain + e.numerical), std::abs(e.potential)});
    lost = std::max(lost, std::abs(e.numerical));
  }
  if (lost <= largest_lost_share * largest) return;
  terminal.warn(fmt::format(
      "the energy does not close: {:.3g} J have come or gone where the rock moves {:.3g} J about. "
      "The motion is not to be trusted: choose a solver.tolerance of 1e-8 to 1e-10, a shorter "
      "analysis.time_step, or covers of a lower order",
      lost, largest));
}

void warn_of_divided_steps(const Model& model, const RunResult& run, Terminal& terminal) {
  if (run.divided_steps == 0) return;
  std::string keys;
  for (std::size_t s = 0; s < run.divided_in_stage.size(); ++s) {
    const AnalysisStage& stage = model.analysis->stages[s];
    if (run.divided_in_stage[s] == 0) continue;
    const std::string of_stage =
        fmt::format("{} of {} in \"{}\", ", run.divided_in_stage[s], stage.steps, stage.name);
    keys += fmt::format("{}{}{}.time_step = {:.3g} s", keys.empty() ? "" : "; ",
                        stage.name.empty() ? "" : of_stage, stage.place.key, stage.time_step);
  }
  terminal.warn(fmt::format(
      "{} of {} steps did not converge at once and were divided, into {} parts at most ({}): with "
      "a shorter one all steps would be alike",
      run.divided_steps, run.steps, run.most_parts, keys));
}

void warn_of_support_gap(const Model& model, const RunResult& run, Terminal& terminal) {
  const OffPlace& off = run.off_place;
  const Real motion = std::max(off.prescribed, run.largest_displacement.length);
  if (off.other != none && off.prescribed > 0 && off.distance > largest_share_off_place * motion) {
    terminal.warn(
        fmt::format("fixed[{}] is {:.2g} m off its place, on rock that fixed[{}] holds as well: "
                    "they contradict each other (reactions and stress there mean nothing)",
                    off.condition + 1, off.distance, off.other + 1));
    return;
  }
  const bool moving = model.analysis->stages.back().type == AnalysisType::dynamic;
  if (run.support_gap <= (moving ? largest_support_gap : largest_gap_at_rest)) return;
  terminal.warn(fmt::format(
      "fixed points are off their places by {:.2g} of the largest displacement: they "
      "cannot all be kept on these covers ({}more than so few covers can do; a smaller "
      "cover.spacing can do more)",
      run.support_gap,
      model.fixed.size() > 1 ? "[[fixed]] contradict each other, or hold " : "[[fixed]] holds "));
}

void warn_of_missing_factors(const Model& model, const RunResult& run, Terminal& terminal) {
  if (model.solver.preconditioner != Preconditioner::direct || run.interrupted ||
      run.preconditioner == Preconditioner::direct ||
      run.preconditioner == Preconditioner::automatic)
    return;
  terminal.warn(
      fmt::format("solver.preconditioner = \"direct\": this system's factors are out of reach "
                  "(3e11 operations, 3 GB) or did not help; it was solved with {}",
                  preconditioner_name(run.preconditioner)));
}

void warn_of_guessed_material(const Model& model, const RunResult& run, Terminal& terminal) {
  for (const MetSurfaces& met : run.met)
    if (met.by == MetSurfaces::By::guess)
      terminal.warn(fmt::format(
          "faces without a joint material met each other and took that of \"{}\", the first of {}: "
          "set contact.material to the one that holds there, or solid.interface",
          model.joint_materials[met.material].name, model.joint_materials.size()));
}

void warn_of_imbalance(const Model& model, const RunResult& run, Terminal& terminal) {
  if (run.interrupted || !run.unbalanced || !is_far_from_balance(*run.unbalanced)) return;
  const AnalysisStage& stage = model.analysis->stages.back();
  terminal.warn(
      fmt::format("the last quasi-static step is far from equilibrium: {:.2g} % of the load is not "
                  "balanced, most "
                  "of it on block {} ({:.4g} N). Reactions and joint stresses are those of rock "
                  "that moves. More "
                  "{}.steps, or longer ones, find the rest of what can stand",
                  100 * run.unbalanced->share, run.unbalanced->block + 1, run.unbalanced->force,
                  stage.place.key.empty() ? "analysis" : stage.place.key));
}

void warn_of_interruption(const RunResult& run, const Model& model, const Options& options,
                          Terminal& terminal) {
  if (!run.interrupted || stop_error("")) return;  // the error of a limit says so itself
  terminal.warn(fmt::format("interrupted after {} of {} steps: the {} ends at t = {:.6g} s",
                            run.steps, model.analysis->steps(),
                            options.no_result ? "answer" : "result", run.time));
}

}  // namespace rockfold
