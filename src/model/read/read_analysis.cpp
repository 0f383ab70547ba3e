// [analysis], [solver] and [output].
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "src/model/read/draft.hpp"
#include "src/model/read/read_loads.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

/// What [analysis] says of the stages, and what a [[step]] takes where it is silent.
struct StageDefaults {
  AnalysisStage stage;
  std::optional<Index> steps;
  Real end_time = 1.0;  // s
};

/// How many steps reach end_time, the last of which may be shorter. 1e-9: a quotient like 0.3 / 0.1, which no rounding brings to exactly 3, is 3.
std::optional<Index> whole_steps(TableReader& in, Real end_time, Real time_step) {
  const Real exact = end_time / time_step;
  const Real nearest = std::round(exact);
  const Real steps = std::abs(exact - nearest) <= 1e-9 * nearest ? nearest : std::ceil(exact);
  constexpr Index most = std::numeric_limits<Index>::max();
  const std::string of_step = "time_step (" + number_text(time_step) + " s)";
  if (exact < 1 && nearest < 1) {
    in.wrong("end_time", "found " + number_text(end_time) + ", must be at least one " + of_step);
  } else if (steps > most) {
    in.wrong("end_time", "found " + number_text(end_time) + ": more than " + std::to_string(most) +
                             " times " + of_step);
  } else {
    return static_cast<Index>(steps);
  }
  return {};
}

/// `given`: steps and end_time where the table says nothing; what it says stands there afterwards.
void read_duration(TableReader& in, AnalysisStage& stage, StageDefaults& given) {
  const bool step =
      in.read("time_step", stage.time_step, positive("s"), Need::optional) || !in.has("time_step");
  const bool both = in.has("steps") && in.has("end_time");
  if (both) in.wrong("steps", "give either steps or end_time, not both");
  if (in.has("end_time")) given.steps.reset();
  const bool end =
      in.read("end_time", given.end_time, positive("s"), Need::optional) || !in.has("end_time");
  if (in.has("steps")) {
    const bool known = in.read("steps", stage.steps, IntegerRange{.low = 1}, Need::optional);
    if (known) given.steps = stage.steps;
    if (known && stage.type == AnalysisType::static_ && stage.steps != 1)
      in.wrong("steps", "found " + std::to_string(stage.steps) +
                            ", must be 1: a static analysis takes its loads in one step");
  } else if (given.steps) {
    stage.steps = *given.steps;
  } else if (end && step && stage.type != AnalysisType::static_) {
    if (const auto steps = whole_steps(in, given.end_time, stage.time_step)) {
      stage.steps = *steps;
      const Real rest = given.end_time - (*steps - 1) * stage.time_step;
      if (rest < (1 - 1e-6) * stage.time_step) stage.last_time_step = rest;
    }
  }
  if (stage.type == AnalysisType::static_) stage.steps = 1;
}

void read_type(TableReader& in, AnalysisStage& analysis) {
  const auto type = in.choose("type", {{"static", "quasi_static", "dynamic"}, {}}, Need::optional);
  constexpr AnalysisType types[] = {AnalysisType::static_, AnalysisType::quasi_static,
                                    AnalysisType::dynamic};
  if (type) analysis.type = types[*type];
}

void read_dynamic_ratio(TableReader& in, AnalysisStage& analysis) {
  const bool quasi_static = analysis.type == AnalysisType::quasi_static;
  if (quasi_static) analysis.dynamic_ratio = 0;
  if (!in.read("dynamic_ratio", analysis.dynamic_ratio, between(0, 1, ""), Need::optional)) return;
  if (quasi_static && analysis.dynamic_ratio != 0)
    in.wrong("dynamic_ratio",
             "found " + number_text(analysis.dynamic_ratio) +
                 ", a quasi_static analysis has 0; use type = \"dynamic\" for others");
}

void read_scheme(TableReader& in, AnalysisStage& stage) {
  const auto given = in.choose("scheme", {{"auto", "implicit", "explicit"}, {}}, Need::optional);
  constexpr Scheme schemes[] = {Scheme::automatic, Scheme::implicit, Scheme::explicit_};
  if (given) stage.scheme = schemes[*given];
  in.read("mass_scaling", stage.mass_scaling, between(0, 1, "of the mass of all rock"),
          Need::optional);
  if (stage.mass_scaling > 0 &&
      (stage.type != AnalysisType::dynamic || stage.scheme == Scheme::implicit))
    in.wrong("mass_scaling",
             "is for type = \"dynamic\" with scheme = \"explicit\" or \"auto\"; steps that relax "
             "scale masses by themselves");
  if (!in.read("tolerance_of_balance", stage.tolerance_of_balance, between(1e-12, 0.1, ""),
               Need::optional))
    return;
  if (stage.type != AnalysisType::quasi_static || stage.scheme != Scheme::explicit_)
    in.wrong("tolerance_of_balance", "is for type = \"quasi_static\" with scheme = \"explicit\"");
}

void read_kinematics(TableReader& in, Analysis& analysis) {
  const auto given = in.choose("kinematics", {{"small", "large"}, {}}, Need::optional);
  if (given) analysis.kinematics = *given == 0 ? Kinematics::small : Kinematics::large;
}

void read_newmark(TableReader& in, Analysis& analysis) {
  const auto* value = in.find("newmark");
  if (!value) return;
  TableReader newmark(*value, in.path_of("newmark"), in.out());
  // Below, the scheme is the explicit one in all but name, and supports that move would need endless accelerations (decision 10).
  Range beta;
  beta.low = 1e-4;
  beta.unit = "1e-4 comes to the explicit scheme";
  newmark.read("beta", analysis.newmark_beta, beta, Need::optional);
  newmark.read("gamma", analysis.newmark_gamma, not_negative(""), Need::optional);
}

/// α, β of αM + βK that damp at both frequencies (Hz) by the ratio: α/(2ω) + βω/2 = ζ (Clough & Penzien 1993, §12.5).
void damp(Real ratio, Real first, Real second, Analysis& analysis) {
  const Real low = 2 * std::numbers::pi * first, high = 2 * std::numbers::pi * second;
  analysis.rayleigh_alpha = 2 * ratio * low * high / (low + high);
  analysis.rayleigh_beta = 2 * ratio / (low + high);
}

void read_ratio_at_frequencies(TableReader& rayleigh, Analysis& analysis) {
  Real ratio = 0;
  Range share = between(0, 1, "of critical damping");
  share.high_open = true;
  const bool known = rayleigh.read("damping_ratio", ratio, share);
  const auto* value = rayleigh.find("frequencies", "two frequencies (Hz)");
  if (!value) return;
  const auto* list =
      array_from(*value, rayleigh.path_of("frequencies"), 2, "2 frequencies (Hz)", rayleigh.out());
  if (!list) return;
  if (list->size() > 2) {
    rayleigh.wrong("frequencies", "found " + std::to_string(list->size()) + ", must be 2 (Hz)");
    return;
  }
  std::optional<Real> hertz[2];
  for (std::size_t i = 0; i < 2; ++i)
    hertz[i] = real_from((*list)[i], item_path(rayleigh.path_of("frequencies"), i), positive("Hz"),
                         rayleigh.out());
  if (known && hertz[0] && hertz[1]) damp(ratio, *hertz[0], *hertz[1], analysis);
}

/// {alpha, beta}, or {damping_ratio, frequencies} that they follow from.
void read_rayleigh(TableReader& in, Analysis& analysis) {
  const auto* value = in.find("rayleigh");
  if (!value) return;
  TableReader rayleigh(*value, in.path_of("rayleigh"), in.out());
  if (!rayleigh.is_table()) return;
  const bool by_ratio = rayleigh.has("damping_ratio") || rayleigh.has("frequencies");
  const bool direct = rayleigh.has("alpha") || rayleigh.has("beta");
  if (by_ratio && direct)
    rayleigh.wrong("", "give either alpha and beta, or damping_ratio and frequencies");
  rayleigh.read("alpha", analysis.rayleigh_alpha, not_negative("1/s"), Need::optional);
  rayleigh.read("beta", analysis.rayleigh_beta, not_negative("s"), Need::optional);
  if (by_ratio) {
    read_ratio_at_frequencies(rayleigh, analysis);
  } else {
    rayleigh.find("damping_ratio");  // known keys all the same
    rayleigh.find("frequencies");
  }
}

void read_stage(TableReader& in, AnalysisStage& stage, StageDefaults& given) {
  stage.place = in.place();
  read_type(in, stage);
  read_scheme(in, stage);
  read_duration(in, stage, given);
  read_dynamic_ratio(in, stage);
  in.read("seismic", stage.seismic, Need::optional);
}

/// An excavation has the stage, and no step before takes its rock.
void check_excavate(TableReader& in, const Draft& draft, const std::vector<AnalysisStage>& before,
                    Index stage) {
  std::set<Index> known;
  for (const Excavation& e : draft.model.excavations) known.insert(e.stage);
  const auto takes_it = [&](const AnalysisStage& step) { return step.excavate == stage; };
  const auto earlier = std::find_if(before.begin(), before.end(), takes_it);
  if (known.empty()) {
    in.wrong("excavate", "found " + std::to_string(stage) + ", but there is no [[excavation]]");
  } else if (!known.contains(stage)) {
    std::string stages;
    for (const Index s : known) stages += (stages.empty() ? "" : ", ") + std::to_string(s);
    in.wrong("excavate", "found " + std::to_string(stage) +
                             ", must be a stage of an [[excavation]]: " + stages);
  } else if (earlier != before.end()) {
    in.wrong("excavate", "found " + std::to_string(stage) + ", whose rock \"" + earlier->name +
                             "\" takes away already");
  }
}

/// How what excavated rock pressed its walls with is let go: of this step's, or of what an earlier one has left of it.
void read_release(TableReader& in, const std::vector<AnalysisStage>& before, AnalysisStage& stage) {
  if (!in.has("release")) return;
  const auto takes = [](const AnalysisStage& step) { return step.excavate != 0; };
  if (stage.excavate == 0 && std::none_of(before.begin(), before.end(), takes))
    in.wrong("release", "no step has taken rock away yet: it goes with excavate");
  if (stage.excavate != 0 && before.empty())
    in.wrong(
        "release",
        "the rock that the first step takes away is not there from the start, and has pressed on "
        "nothing: put a step without excavate before it");
  TimeTable table;
  read_time_table(in, "release", 1, between(0, 1, "share that is gone"), table);
  for (std::size_t i = 0; i < table.time.size(); ++i) {
    const Real share = table.value[i][0], least = i > 0 ? table.value[i - 1][0] : 0;
    if (!(table.time[i] >= 0))
      in.wrong("release", "found " + number_text(table.time[i]) +
                              " s, must be >= 0: times count from the start of the step");
    if (!(share >= least))
      in.wrong("release", "found a share of " + number_text(share) + " after " +
                              number_text(least) + ": what is gone does not come back");
    stage.release.push_back({table.time[i], share});
  }
}

/// [[step]]: analyses in order. `usual`: what [analysis] says.
void read_stages(Draft& draft, const StageDefaults& usual) {
  std::vector<AnalysisStage> stages;
  read_entries(draft, "step", [&](TableReader& in, Index number) {
    StageDefaults given = usual;
    AnalysisStage stage = usual.stage;
    stage.last_time_step.reset();
    if (usual.stage.type == AnalysisType::quasi_static) stage.dynamic_ratio = 1;
    stage.name = "step " + std::to_string(number);
    in.read("name", stage.name, Need::optional);
    read_stage(in, stage, given);
    in.read("reset_displacement", stage.reset_displacement, Need::optional);
    if (in.has("excavate") &&
        in.read("excavate", stage.excavate, IntegerRange{.low = 1}, Need::optional))
      check_excavate(in, draft, stages, stage.excavate);
    read_release(in, stages, stage);
    in.not_yet("base_acceleration");
    stages.push_back(stage);
  });
  if (stages.empty()) return;
  stages.front().excavate = 0;  // gone before anything moves, as what no step names
  if (!draft.model.analysis) draft.model.analysis.emplace().place = stages[0].place;
  draft.model.analysis->stages = stages;
}

}  // namespace

void read_analysis(Draft& draft) {
  StageDefaults usual;
  read_section(draft, "analysis", [&](TableReader& in) {
    Analysis analysis;
    analysis.place = in.place();
    AnalysisStage& stage = analysis.stages[0];
    read_stage(in, stage, usual);
    usual.stage = stage;
    read_kinematics(in, analysis);
    Range ratio = between(0, 1, "of half the model's height");
    ratio.low_open = true;
    in.read("max_displacement_ratio", analysis.max_displacement_ratio, ratio);
    read_newmark(in, analysis);
    read_rayleigh(in, analysis);
    draft.model.analysis = analysis;
  });
  read_stages(draft, usual);
}

void read_solver(Draft& draft) {
  read_section(draft, "solver", [&](TableReader& in) {
    Range tolerance = between(0, 1, "");
    tolerance.low_open = tolerance.high_open = true;
    in.read("tolerance", draft.model.solver.tolerance, tolerance, Need::optional);
    in.read("max_iterations", draft.model.solver.max_iterations, IntegerRange{.low = 1},
            Need::optional);
    const auto preconditioner = in.choose(
        "preconditioner",
        {{"auto", "block_jacobi", "node_block_jacobi", "multigrid", "direct"}, {}}, Need::optional);
    constexpr Preconditioner names[] = {Preconditioner::automatic, Preconditioner::block_jacobi,
                                        Preconditioner::node_block_jacobi,
                                        Preconditioner::multigrid, Preconditioner::direct};
    if (preconditioner) draft.model.solver.preconditioner = names[*preconditioner];
  });
}

void read_output(Draft& draft) {
  read_section(draft, "output", [&](TableReader& in) {
    in.read("every", draft.model.output.every, IntegerRange{.low = 0}, Need::optional);
    Real seconds = draft.model.output.checkpoint_every;
    in.read("checkpoint_every", seconds, Range{.low = 0, .high = 1e9, .unit = "s"}, Need::optional);
    draft.model.output.checkpoint_every = static_cast<float>(seconds);
    in.read("compression", draft.model.output.compression, IntegerRange{.low = 0, .high = 9},
            Need::optional);
  });
}

}  // namespace rockfold
