// Cutting: blocks a second for a cube cut by three inclined joint sets, beside a plain splitter in double precision that
// knows neither exactness nor neighbours (of_plain: blocks a second over its blocks a second, one thread, in this run).
//
//   plain      the yardstick
//   cut        solids, joints, adjacency and blocks: host/cut as a whole
//   adjacency  the part of it that finds who touches whom
//   flatten    merged faces and flat arrays
//
// peak_bytes/cell is of the process: it says something where this benchmark is run alone.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <omp.h>

#include "generated/version.hpp"
#include "host/cut/adjacency.hpp"
#include "host/cut/cells/complex.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "perf/shared/memory.hpp"
#include "perf/shared/three_sets.hpp"

namespace rockfold {
namespace {

struct Plain {
  std::int64_t blocks = 0;
  double rate = 0;  // blocks a second
};
std::map<std::int64_t, Plain> plain_result;  // by blocks asked for

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

const Plain& measure_plain(std::int64_t asked) {
  Plain& result = plain_result[asked];
  if (result.blocks != 0) return result;
  const auto planes = plain_planes(three_sets(asked));
  for (int i = 0; i < 3; ++i) {
    const double began = seconds();
    const auto cells = PlainSplitter(planes).run({0, 0, 0}, {cube_edge, cube_edge, cube_edge});
    result.blocks = static_cast<std::int64_t>(cells.size());
    result.rate = std::max(result.rate, static_cast<double>(cells.size()) / (seconds() - began));
  }
  return result;
}

void report(benchmark::State& state, std::int64_t blocks) {
  const Plain& plain = measure_plain(state.range(0));
  if (blocks != plain.blocks)
    state.SkipWithError("not the number of blocks that the plain splitter makes");
  state.SetItemsProcessed(state.iterations() * blocks);
  state.counters["blocks"] = static_cast<double>(blocks);
  state.counters["of_plain"] = benchmark::Counter(
      static_cast<double>(blocks) * static_cast<double>(state.iterations()) / plain.rate,
      benchmark::Counter::kIsRate);
}

// Long double: adding 100,000 equal volumes in double loses 2e-12 by its own rounding.
void check_volume(benchmark::State& state, long double volume) {
  if (!(std::abs(volume / (cube_edge * cube_edge * cube_edge) - 1) < 1e-12))
    state.SkipWithError("the blocks do not fill the cube");
}

void plain(benchmark::State& state) {
  const auto planes = plain_planes(three_sets(state.range(0)));
  PlainCells cells;
  for (auto _ : state)
    cells = PlainSplitter(planes).run({0, 0, 0}, {cube_edge, cube_edge, cube_edge});
  long double volume = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) volume += cells.volume(c);
  check_volume(state, volume);
  report(state, static_cast<std::int64_t>(cells.size()));
}

void cut(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  const Model model = three_sets(state.range(0));
  Progress silent;
  Cutting cutting;
  for (auto _ : state) {
    cutting = {};
    cutting = cut_blocks(model, silent);
  }
  long double volume = 0;
  for (const CellMoments& m : cutting.complex->moments) volume += m.volume;
  check_volume(state, volume);
  state.counters["peak_bytes/cell"] = peak_bytes() / static_cast<double>(cutting.totals.cells);
  report(state, cutting.complex->block_count);
}

void adjacency(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  Progress silent;
  const Cutting cutting = cut_blocks(three_sets(state.range(0)), silent);
  const std::size_t fragments = cutting.complex->fragments.size();
  Complex complex = *cutting.complex;
  for (auto _ : state) {
    complex.fragments.clear();
    complex.free_parts.clear();
    complex.polygons.clear();
    find_adjacency(complex, complex.cells.size());
  }
  if (complex.fragments.size() != fragments)
    state.SkipWithError("fragments differ from one call to the next");
  report(state, cutting.complex->block_count);
}

void flatten(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  const Model model = three_sets(state.range(0));
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  BlockArrays blocks;
  for (auto _ : state) blocks = flatten_blocks(cutting, model);
  long double volume = 0;
  for (const Real v : blocks.volume) volume += v;
  check_volume(state, volume);
  report(state, blocks.block_count());
}

BENCHMARK(plain)
    ->ArgName("blocks")
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"blocks", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (const std::int64_t blocks : {1000, 10000, 100000, 1000000})
    for (const std::int64_t threads : {1, 2}) b->Args({blocks, threads});
}
BENCHMARK(cut)->Apply(sizes);
BENCHMARK(adjacency)->Apply(sizes);
BENCHMARK(flatten)->Apply(sizes);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("rockfold", std::string(rockfold::version) + " " + rockfold::commit);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::RunSpecifiedBenchmarks();
}
