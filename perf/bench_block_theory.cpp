// Block theory: a cube cut by three inclined joint sets with one side free, and tunnels drawn at random.
//
//   classes       class and motion of every block, and so the first batch, on one thread; of_cutting: its seconds over
//                 those of cutting and flattening the same model in this run
//   keyblocks     classes, batches, groups and rotation of all blocks
//   monte_carlo   realisations of a tunnel in three random sets; checked against another seed's count
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include <benchmark/benchmark.h>
#include <omp.h>

#include "generated/version.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "host/keyblock/bodies.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/theory/theory.hpp"
#include "perf/shared/three_sets.hpp"
#include "src/model/tunnel_section.hpp"

namespace rockfold {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Model with_materials(Model model) {
  Material rock;
  rock.name = "rock";
  rock.density = 2700;
  model.materials.push_back(rock);
  JointMaterial joint;
  joint.name = "joint";
  joint.friction_angle = 30;
  model.joint_materials.push_back(joint);
  return model;
}

/// A cube of blocks with one free side, and how long it took.
struct CutRock {
  Model model;
  BlockArrays blocks;
  double seconds = 0;
};
CutRock cut_rock(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  CutRock rock{with_materials(three_sets(state.range(0))), {}, 0};
  rock.model.solids[0].continues = {true, false, true, true, true, true};
  Progress silent;
  const double began = seconds();
  const Cutting cutting = cut_blocks(rock.model, silent);
  rock.blocks = flatten_blocks(cutting, rock.model);
  rock.seconds = seconds() - began;
  return rock;
}

/// Seconds of an iteration over those of the cutting.
void report_ratio(benchmark::State& state, const CutRock& rock, double elapsed) {
  state.SetItemsProcessed(state.iterations() * rock.blocks.block_count());
  state.counters["blocks"] = static_cast<double>(rock.blocks.block_count());
  state.counters["of_cutting"] = elapsed / static_cast<double>(state.iterations()) / rock.seconds;
}

void classes(benchmark::State& state) {
  const CutRock rock = cut_rock(state);
  const std::vector<Index> batch(rock.blocks.volume.size(), 0);
  std::vector<std::uint8_t> moves(batch.size());
  const double began = seconds();
  for (auto _ : state) {
    const Bodies bodies(rock.blocks, rock.model);
    for (Index b = 0; b < rock.blocks.block_count(); ++b)
      moves[static_cast<std::size_t>(b)] =
          !bodies.is_encased(b, batch) &&
          bodies.judge(bodies.body({b}, batch), batch).block_class == BlockClass::key;
  }
  report_ratio(state, rock, seconds() - began);
  const auto first = std::count(moves.begin(), moves.end(), std::uint8_t{1});
  if (find_keyblocks(rock.blocks, rock.model).batches.at(0) != first)
    state.SkipWithError("not the first batch of find_keyblocks");
}

void keyblocks(benchmark::State& state) {
  const CutRock rock = cut_rock(state);
  const auto& [model, blocks, ignored] = rock;
  KeyblockReport report;
  const double began = seconds();
  for (auto _ : state) report = find_keyblocks(blocks, model);
  report_ratio(state, rock, seconds() - began);
  Real infinite = 0;
  for (std::size_t b = 0; b < report.block_class.size(); ++b)
    infinite += (report.block_class[b] == BlockClass::infinite) != (blocks.finite[b] == 0);
  if (report.keyblocks.empty() || infinite > 0)
    state.SkipWithError("no key blocks, or blocks of the wrong class");
  state.counters["keyblocks"] = static_cast<double>(report.keyblocks.size());
}

void monte_carlo(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  Model model = with_materials(Model{});
  const Real dips[] = {60, 55, 70}, directions[] = {30, 150, 265};
  for (std::size_t i = 0; i < 3; ++i) {
    JointSet set;
    set.name = std::to_string(i);
    set.orientation = DipOrientation{dips[i], directions[i]};
    set.random = RandomSet{};
    set.random->fisher_kappa = 60;
    set.random->spacing = Distribution{};
    set.random->spacing->kind = Distribution::Kind::exponential;
    set.random->spacing->mean = 2;
    model.joint_sets.push_back(set);
  }
  model.theory = TheorySpec{};
  const TheoryTunnel tunnel{"tunnel", 20, 3, horseshoe_section(5, 5, 16), {}};
  MonteCarloSpec spec;
  spec.realisations = static_cast<Index>(state.range(0));
  spec.friction_deviation = 3;
  MonteCarloResult result;
  for (auto _ : state) result = simulate_tunnel(model, tunnel, spec);
  spec.seed = 2;
  const auto other = simulate_tunnel(model, tunnel, spec);
  const Real p = result.key.value, n = spec.realisations;
  if (std::abs(p - other.key.value) > 6 * std::sqrt(2 * p * (1 - p) / n))
    state.SkipWithError("two seeds disagree about the probability");
  state.SetItemsProcessed(state.iterations() * spec.realisations);
  state.counters["probability"] = p;
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"blocks", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (const std::int64_t blocks : {10000, 100000})
    for (const std::int64_t threads : {1, 2}) b->Args({blocks, threads});
}
BENCHMARK(classes)
    ->ArgNames({"blocks", "threads"})
    ->Args({10000, 1})
    ->Args({100000, 1})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(keyblocks)->Apply(sizes);
BENCHMARK(monte_carlo)
    ->ArgNames({"realisations", "threads"})
    ->Args({10000, 1})
    ->Args({10000, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("rockfold", std::string(rockfold::version) + " " + rockfold::commit);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::RunSpecifiedBenchmarks();
}
