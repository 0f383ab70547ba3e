// A run that is gone on with from a checkpoint, wherever that lies, ends in the same bits.
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/interrupt.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

using Bytes = std::vector<std::byte>;

const std::string rock =
    "[[material]]\ndensity = 2500\nyoung_modulus = 1e9\npoisson_ratio = 0.2\n"
    "[[joint_material]]\nname = 'clean'\nfriction_angle = 30\n";

std::string box(const std::string& kind, const std::string& min, const std::string& max) {
  return "[[" + kind + "]]\nshape = 'box'\nmin = " + min + "\nmax = " + max + "\n";
}

/// A turning cube comes so deep into a soft plane that contact makes energy: the step is divided for that, not because it does not converge.
const std::string tumbling =
    rock + "normal_stiffness = 1e6\nshear_stiffness = 1e6\n[cover]\nlattice = 'block'\n" +
    box("solid", "[-4, -4, -1]", "[4, 4, 0]") +
    box("solid", "[-0.5, -0.5, 0.3]", "[0.5, 0.5, 1.3]") +
    "[[fixed]]\nwhere = {block_at = [0, 0, -0.5]}\n"
    "[[initial_velocity]]\nwhere = {block_at = [0, 0, 0.8]}\nvelocity = [2, 1, -4]\n"
    "angular_velocity = [3, 5, 1]\n"
    "[analysis]\ntype = 'dynamic'\ntime_step = 0.02\nsteps = 11\n"
    "[[monitor]]\nname = 'cube'\npoint = [0.2, 0.1, 1]\n[output]\nevery = 4\n";

/// Of three cubes on each other the middle one is dug away.
const std::string dug =
    rock + "[cover]\nlattice = 'block'\n" + box("solid", "[0, 0, 0]", "[1, 1, 3]") +
    "[[joint_set]]\nmaterial = 'clean'\ndip = 0\ndip_direction = 0\nspacing = 1\n"
    "origin = [0, 0, 1]\n[[fixed]]\nwhere = {block_at = [0.5, 0.5, 0.5]}\n" +
    box("excavation", "[-1, -1, 1]", "[2, 2, 2]") +
    "[[monitor]]\nname = 'top'\npoint = [0.5, 0.5, 2.5]\n[analysis]\nkinematics = 'large'\n"
    "[[step]]\nname = 'gravity'\ntype = 'quasi_static'\ntime_step = 1\nsteps = 3\n"
    "[[step]]\nname = 'dig'\ntype = 'dynamic'\ntime_step = 0.002\nsteps = 4\nexcavate = 1\n";

/// A cube on a lattice, shaken by a record whose rows lie between the steps.
const std::string shaken =
    "[[material]]\ndensity = 2500\nyoung_modulus = 1e7\npoisson_ratio = 0.2\n" +
    box("solid", "[0, 0, 0]", "[1, 1, 1]") +
    "[cover]\nspacing = 0.6\n[[fixed]]\nwhere = {plane = {point = [0, 0, 0], normal = [0, 0, 1]}}\n"
    "[base_acceleration]\ntable = [[0, 0, 0, 0], [0.011, 1.3, 0.7, 0], [0.029, -2.1, 0.3, 0.1], "
    "[0.1, 0, 0, 0]]\n"
    "[[monitor]]\nname = 'top'\npoint = [0.5, 0.5, 1]\n"
    "[analysis]\ntype = 'dynamic'\ntime_step = 0.01\nsteps = 7\n";

/// What tells two ends of a run apart: of all that it has kept, what is numbers alone, in the order in which they are stored.
struct End {
  std::vector<MonitorHistory> monitors;
  std::vector<BaseMotion> base;
  std::vector<Energy> energies;
  std::vector<Index> contacts, iterations, substeps, settling;
  std::vector<BlockMotion> blocks;
};

End end_of(const ModelAnswer& answer) {
  const RunResult& run = answer.result;
  End end{run.monitors,
          run.base,
          run.energies,
          run.contact_history.stick,
          run.contact_history.iterations,
          run.contact_history.substeps,
          {},
          run.blocks};
  for (const Settled& s : run.settled)
    end.settling.insert(end.settling.end(), {s.steps, s.block, s.moving, s.fastest});
  return end;
}

template <typename T>
Bytes bytes_of(const std::vector<T>& numbers) {
  const auto bytes = std::as_bytes(std::span(numbers));
  return {bytes.begin(), bytes.end()};
}

void expect_same(const ModelAnswer& one, const ModelAnswer& other) {
  const End a = end_of(one), b = end_of(other);
  for (std::size_t m = 0; m < a.monitors.size(); ++m) {
    EXPECT_EQ(a.monitors[m].displacement, b.monitors[m].displacement);
    EXPECT_EQ(a.monitors[m].acceleration, b.monitors[m].acceleration);
  }
  EXPECT_TRUE(bytes_of(a.base) == bytes_of(b.base));
  EXPECT_TRUE(bytes_of(a.energies) == bytes_of(b.energies));
  EXPECT_TRUE(bytes_of(a.blocks) == bytes_of(b.blocks));
  EXPECT_EQ(a.contacts, b.contacts);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.substeps, b.substeps);
  EXPECT_EQ(a.settling, b.settling);
}

ModelAnswer run_from(const std::string& model, const Bytes& checkpoint,
                     Progress* progress = nullptr, std::vector<Bytes>* saved = nullptr) {
  RunHooks hooks{progress, {}};
  hooks.checkpoints.from = checkpoint;
  if (saved)
    hooks.checkpoints.save = [saved](std::span<const std::byte> bytes) {
      saved->emplace_back(bytes.begin(), bytes.end());
    };
  ModelAnswer answer;
  run_model(model, answer, {}, hooks);
  return answer;
}

/// Runs to the end, and again from each checkpoint on the way there; returns how many there were.
std::size_t expect_the_same_end(const std::string& model, ModelAnswer& whole) {
  std::vector<Bytes> saved;
  whole = run_from(model, {}, nullptr, &saved);
  for (std::size_t n = 0; n < saved.size(); ++n) {
    SCOPED_TRACE("checkpoint " + std::to_string(n));
    expect_same(run_from(model, saved[n]), whole);
  }
  return saved.size();
}

TEST(Resume, WithinAStepDividedSinceContactMadeEnergy) {
  ModelAnswer whole;
  const std::size_t checkpoints = expect_the_same_end(tumbling, whole);
  EXPECT_GT(whole.result.largest_substeps, 1);
  EXPECT_EQ(whole.result.divided_steps, 0);
  EXPECT_GT(checkpoints, 11u);  // one a step, and between the parts of those that are divided
}

TEST(Resume, WhileExcavatedRockIsLetGo) {
  ModelAnswer whole;
  const std::size_t checkpoints = expect_the_same_end(dug, whole);
  ASSERT_EQ(whole.result.settled.size(), 1u);
  EXPECT_EQ(checkpoints, 7u + static_cast<std::size_t>(whole.result.settled[0].steps));
}

TEST(Resume, OfExplicitSteps) {
  for (const std::string& model : {tumbling, dug}) {
    ModelAnswer whole;
    std::string by_substeps = model;
    by_substeps.insert(by_substeps.rfind("type = 'dynamic'"), "scheme = 'explicit'\n");
    EXPECT_GT(expect_the_same_end(by_substeps, whole), 4U);
    ASSERT_EQ(whole.result.by_substeps.size(), 1U);
    EXPECT_GE(whole.result.by_substeps[0].substeps, whole.result.by_substeps[0].steps);
  }
}

TEST(Resume, UnderARecordKnowsHowFarTheGroundHasCome) {
  ModelAnswer whole;
  EXPECT_EQ(expect_the_same_end(shaken, whole), 7u);
  EXPECT_EQ(whole.result.base.size(), 8u);
}

/// Notes the phases, and interrupts after so many steps of letting go.
class Interruption : public Progress {
 public:
  explicit Interruption(std::int64_t after) : after_(after) {}
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption() override { interrupt_signal = 0; }
  void begin(std::string_view phase, std::int64_t total, std::string_view) override {
    phases.emplace_back(std::string(phase) + " " + std::to_string(total));
  }
  void done(std::int64_t count) override {
    if (phases.back().starts_with("letting go") && count == after_) interrupt_signal = SIGINT;
  }
  std::vector<std::string> phases;

 private:
  std::int64_t after_;
};

TEST(LettingGo, IsAPhaseOfItsOwn) {
  Interruption never(none);
  run_from(dug, {}, &never);
  EXPECT_EQ(never.phases,
            (std::vector<std::string>{"analysis 7", "letting go stage 1 0", "analysis 4"}));
}

TEST(LettingGo, InterruptedTellsOfTheMomentItWasInterruptedIn) {
  std::vector<Bytes> saved;
  Interruption third(3);
  const RunResult run = run_from(dug, {}, &third, &saved).result;
  EXPECT_TRUE(run.interrupted);
  EXPECT_EQ(run.steps, 3);
  ASSERT_TRUE(run.settling.has_value());
  EXPECT_EQ(run.settling->stage, 1);  // of the analysis: "dig"
  EXPECT_EQ(run.settling->steps, 3);
  EXPECT_EQ(run.settled.size(), 0u);
  EXPECT_NEAR(run.walls, 0.7, 1e-12);
  // Energies are those of what has gone, as `gone` and `walls` are, not of the last step.
  EXPECT_NE(run.energy.excavated, 0);
  EXPECT_EQ(run.energies.back().excavated, 0);
}

TEST(LettingGo, GoesOnHoweverShortTheRunsAre) {
  const ModelAnswer whole = run_from(dug, {});
  Bytes checkpoint;
  Index runs = 0;
  for (std::int64_t steps = 1; steps <= 200; ++steps, ++runs) {
    std::vector<Bytes> saved;
    Interruption next(steps);
    const ModelAnswer answer = run_from(dug, checkpoint, &next, &saved);
    if (!answer.result.interrupted) {
      expect_same(answer, whole);
      break;
    }
    ASSERT_FALSE(saved.empty());
    checkpoint = saved.back();
  }
  EXPECT_GT(runs, 10);
  EXPECT_LT(runs, 200);
}

}  // namespace
}  // namespace rockfold
