// What holds rock and what presses on it in motion: a slope of 819 blocks, the outermost of which slide, without anything, with water in its joints, and with bolts of 10 m
// in its face. `of_bare`: processor time of the steps over that of the bare slope in the same run; explicit steps as many in both.
#include <map>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "perf/shared/moving_rock.hpp"
#include "perf/shared/run_benchmarks.hpp"

namespace rockfold {
namespace {

const std::string explicit_steps = "scheme = 'explicit'\ntime_step = 0.01\nsteps = 10\n";
const std::string implicit_steps = "scheme = 'implicit'\ntime_step = 0.01\nsteps = 10\n";

const std::string water = "[[water]]\ntable = {point = [0, 0, 10]}\n";

std::string bolts(int millimetres) {
  return fmt::format(
      "[[bolt_type]]\nname = 'rebar'\nforce_capacity = '245 kN'\nplate_capacity = '120 kN'\n"
      "bond_strength = 200e3\nshear_capacity = '120 kN'\ndisplacement_capacity = '20 mm'\n"
      "[[bolt_pattern]]\nname = 'face'\non = 'slope.3'\nspacing = [{0}, {0}]\nlength = 10\n"
      "type = 'rebar'\n",
      1e-3 * millimetres);
}

constexpr Index settling = 2;

MovingRock run(const std::string& steps, const std::string& more) {
  return run_moving_rock(jointed_slope(40, settling, steps + more), settling);
}

/// The slope by itself, once for all.
const MovingRock& bare_slope(const std::string& steps) {
  static std::map<std::string, MovingRock> known;
  const auto found = known.find(steps);
  return found != known.end() ? found->second : known.emplace(steps, run(steps, "")).first->second;
}

void compare(benchmark::State& state, const std::string& steps, const std::string& more) {
  const MovingRock& bare = bare_slope(steps);
  MovingRock held;
  for (auto _ : state) {
    held = run(steps, more);
    state.SetIterationTime(held.seconds);
  }
  if (held.result.bolts.empty() && !held.result.water)
    throw std::runtime_error("nothing holds the slope, and nothing presses on it");
  state.counters["blocks"] = static_cast<double>(held.blocks);
  state.counters["bolts"] = static_cast<double>(held.result.bolts.size());
  state.counters["of_bare"] = held.processor / bare.processor;
  if (!held.result.by_substeps.empty())
    state.counters["of_bare_substeps"] = static_cast<double>(held.result.by_substeps[0].substeps) /
                                         static_cast<double>(bare.result.by_substeps[0].substeps);
}

void water_by_explicit_steps(benchmark::State& state) {
  compare(state, explicit_steps, water);
}
void water_by_implicit_steps(benchmark::State& state) {
  compare(state, implicit_steps, water);
}
/// Argument: their spacing, mm.
void bolts_by_explicit_steps(benchmark::State& state) {
  compare(state, explicit_steps, bolts(static_cast<int>(state.range(0))));
}
void bolts_by_implicit_steps(benchmark::State& state) {
  compare(state, implicit_steps, bolts(static_cast<int>(state.range(0))));
}

BENCHMARK(water_by_explicit_steps)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(water_by_implicit_steps)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(bolts_by_explicit_steps)
    ->Arg(3000)
    ->Arg(1000)
    ->Arg(330)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK(bolts_by_implicit_steps)
    ->Arg(3000)
    ->Arg(1000)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
