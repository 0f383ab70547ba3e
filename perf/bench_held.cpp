// What holds rock and what presses on it in motion: a slope of 819 blocks, the outermost of which slide, without anything, with water in its joints, and with bolts of 10 m
// in its face. `of_bare`: processor time of the explicit steps over that of the bare slope in the same run; `of_bare_substeps`: likewise.
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "perf/shared/moving_rock.hpp"
#include "perf/shared/run_benchmarks.hpp"

namespace rockfold {
namespace {

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

/// By explicit steps, with `more` in the model.
MovingRock run(const std::string& more) {
  return run_moving_rock(
      jointed_slope(40, settling, "scheme = 'explicit'\ntime_step = 0.01\nsteps = 10\n" + more),
      settling);
}

void compare(benchmark::State& state, const std::string& more) {
  static const MovingRock bare = run("");
  MovingRock held;
  for (auto _ : state) {
    held = run(more);
    state.SetIterationTime(held.seconds);
  }
  if (held.result.bolts.empty() && !held.result.water)
    throw std::runtime_error("nothing holds the slope, and nothing presses on it");
  state.counters["blocks"] = static_cast<double>(held.blocks);
  state.counters["bolts"] = static_cast<double>(held.result.bolts.size());
  state.counters["of_bare"] = held.processor / bare.processor;
  state.counters["of_bare_substeps"] = static_cast<double>(held.result.by_substeps.at(0).substeps) /
                                       static_cast<double>(bare.result.by_substeps.at(0).substeps);
}

void with_water(benchmark::State& state) {
  compare(state, water);
}
/// Argument: their spacing, mm.
void with_bolts(benchmark::State& state) {
  compare(state, bolts(static_cast<int>(state.range(0))));
}

BENCHMARK(with_water)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(with_bolts)
    ->Arg(3000)
    ->Arg(1000)
    ->Arg(330)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
