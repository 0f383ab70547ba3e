// The kernels against the memory bandwidth measured in the same run.
//
// Bytes that must be moved, counted as STREAM counts (no write-allocate):
//   apply          48 a row (x in, y out), for block rows 84 more a stored neighbour
//   PCG iteration  apply + 336 a row: see kernels/krylov/pcg_kernel.hpp
// `of_triad` is bytes / time / triad: 1 = as fast as memory allows. Moments and assembly are computation: their rate alone.
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <benchmark/benchmark.h>

#include "kernels/constraints/cover_system.hpp"
#include "kernels/device/device.hpp"
#include "kernels/integrate/moments.hpp"
#include "perf/shared/box_rock.hpp"
#include "perf/shared/run_benchmarks.hpp"
#include "src/base/timer.hpp"

namespace rockfold {
namespace {

// Cells along a side: 10³ covers, where latency alone counts; 70³, 1,029,000 unknowns; 150³, 10,125,000.
constexpr Index few = 9, million = 69, ten_million = 149;
const std::vector<ElasticMaterial> materials{{2500, 1e9, 0.25}};

// Products between two waits for the device.
constexpr int products = 10;

/// The cube with its lowest covers on springs.
struct Bench {
  CoverArrays covers;
  PieceMoments moments;
  FixedPoints fixed;

  Bench(Index cells, int cut_layers)
      : covers(box_rock(cells, cut_layers)), moments(piece_moments(covers)) {
    for (Index p = 0; p < (cells + 1) * (cells + 1); ++p) {
      fixed.points.element.push_back(0);
      fixed.points.local.push_back({});
      fixed.points.unknown.push_back(p);
      fixed.points.weight.push_back(1);
      fixed.points.begin.push_back(static_cast<Index>(fixed.points.unknown.size()));
      fixed.component.push_back({1, 1, 1});
      fixed.value.push_back({});
      fixed.stiffness.push_back(1e9 / cells);
      fixed.enforce.push_back(Enforce::penalty);
    }
  }
  static const Bench& get(Index cells, int cut_layers) {
    static std::map<std::pair<Index, int>, Bench> made;
    return made.try_emplace({cells, cut_layers}, cells, cut_layers).first->second;
  }
  static const Bench& get(const benchmark::State& state) {
    return get(static_cast<Index>(state.range(0)), static_cast<int>(state.range(1)));
  }
};

std::vector<Vec3> waves(Index covers) {
  std::vector<Vec3> x(covers);
  for (Index p = 0; p < covers; ++p)
    x[p] = {std::sin(0.1 * p), std::cos(0.37 * p), std::sin(1.3 * p)};
  return x;
}

Real total(const std::vector<Vec3>& x) {
  Real sum = 0;
  for (const Vec3& v : x) sum += std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
  return sum;
}

void report(benchmark::State& state, double bytes) {
  state.counters["bytes"] = bytes;
  state.counters["of_triad"] =
      benchmark::Counter(bytes * double(state.iterations()) / triad, benchmark::Counter::kIsRate);
}

void moments(benchmark::State& state) {
  const CoverArrays& covers = Bench::get(million, 1).covers;
  PieceMoments m;
  for (auto _ : state) m = piece_moments(covers);
  Real volume = 0;
  for (Real v : m.volume) volume += v;
  if (std::abs(volume - 1 / 3.0) > 1e-9) state.SkipWithError("wrong volume");
  state.SetItemsProcessed(state.iterations() * covers.piece_count());
}

void assemble(benchmark::State& state) {
  const Bench& bench = Bench::get(state);
  for (auto _ : state) {
    const CoverSystem system(bench.covers, bench.moments, materials, bench.fixed);
    benchmark::DoNotOptimize(system.covers());
  }
  state.SetItemsProcessed(state.iterations() * 3 * bench.covers.cover_count());
}

/// What cut rock must give: the same rock uncut.
Real uncut_total(Index cells, const std::vector<Vec3>& values) {
  static std::map<Index, Real> known;
  const auto [it, unknown] = known.try_emplace(cells, 0);
  if (unknown) {
    const CoverSystem uncut(Bench::get(cells, 0).covers, {}, materials);
    it->second = total(uncut.apply({1, 1e6, 0}, values));
  }
  return it->second;
}

void apply(benchmark::State& state) {
  const Bench& bench = Bench::get(state);
  const CoverSystem system(bench.covers, bench.moments, materials);
  const std::vector<Vec3> values = waves(system.covers());
  const CoverVector x(values);
  CoverVector y(system.covers());
  system.apply({1, 1e6, 0}, x, y);
  wait_for_device();
  while (state.KeepRunningBatch(products)) {
    for (int k = 0; k < products; ++k) system.apply({1, 1e6, 0}, x, y);
    wait_for_device();
  }
  if (state.range(1) > 0) {
    const Real expected = uncut_total(static_cast<Index>(state.range(0)), values);
    if (std::abs(total(y.get()) / expected - 1) > 1e-12) state.SkipWithError("wrong answer");
  }
  report(state, system.size().bytes());
}

/// Seconds of a solve that ends after so many iterations, copies to and from the device in it.
/// Conjugate gradients let the residual grow by √κ at most, which grows as the cells along a side do: past that the answer is wrong.
double solve_seconds(CoverSystem& system, Index iterations, benchmark::State& state) {
  const std::vector<Vec3> load(system.covers(), Vec3{0, 0, -1});
  std::vector<Vec3> x(load.size());
  const Timer timer;
  const SolveReport done = system.solve({1, 0, 1}, load, x, {1e-14, iterations});
  const double seconds = timer.seconds();
  if (done.iterations != iterations || !(done.residual < static_cast<Real>(state.range(0))))
    state.SkipWithError("wrong answer");
  return seconds;
}

/// One iteration: the difference of two solves, so that copies do not count.
void pcg_iteration(benchmark::State& state) {
  const Bench& bench = Bench::get(state);
  CoverSystem system(bench.covers, bench.moments, materials, bench.fixed,
                     Preconditioner::block_jacobi);
  constexpr Index less = 50, more = 150;
  solve_seconds(system, less, state);
  for (auto _ : state) {
    const double short_one = solve_seconds(system, less, state);
    state.SetIterationTime((solve_seconds(system, more, state) - short_one) / (more - less));
  }
  report(state, system.size().bytes() + 336.0 * system.covers());
}

BENCHMARK(moments)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(assemble)
    ->ArgNames({"cells", "cut_layers"})
    ->Args({million, 0})
    ->Args({million, 1})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
// So often: to prepare one takes far longer than to run it.
BENCHMARK(apply)
    ->ArgNames({"cells", "cut_layers"})
    ->Args({few, 0})
    ->Iterations(10000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(apply)
    ->ArgNames({"cells", "cut_layers"})
    ->Args({million, 0})
    ->Args({million, 1})
    ->Args({million, 3})
    ->Args({ten_million, 0})
    ->Iterations(100)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(pcg_iteration)
    ->ArgNames({"cells", "cut_layers"})
    ->Args({few, 0})
    ->Args({million, 0})
    ->Args({million, 1})
    ->Args({ten_million, 0})
    ->Iterations(5)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
