// Static solutions of an elastic cube to ‖r‖ = 1e-8 ‖b‖, from covers to displacements, by each preconditioner; and PETSc's, where
// it is installed, on the very same matrix in the same run.
//
//   kind 0  uncut: whole lattice cells
//   kind 1  a third of the cells stored as cut ones
//   kind 2  the same, with a third of the joints' area open, in squares of six cells
//   kind 3  the same in squares of n/3 cells: slabs three cells thick that span 23 of 69
//
// `times_faster`: PETSc's best time over ours; the matrix is there before PETSc's clock starts, ours counts everything from the
// covers on. On one thread it is the processor's time on both sides: what other programs do then hardly matters.
// `bytes/unknown`: most memory resident meanwhile.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <unistd.h>

#include "kernels/constraints/cover_system.hpp"
#include "kernels/device/device.hpp"
#include "kernels/integrate/moments.hpp"
#include "perf/shared/box_rock.hpp"
#include "perf/shared/run_benchmarks.hpp"
#ifdef ROCKFOLD_PETSC
#include "perf/shared/petsc_solver.hpp"
#endif

namespace rockfold {
namespace {

const ElasticMaterial material{2500, 1e9, 0.25};

CoverArrays make_rock(Index cells, int kind) {
  if (kind < 2) return box_rock(cells, kind);
  return jointed_rock(cells, 1, kind == 2 ? 6 : cells / 3);
}

/// A cube on springs, loaded by its weight.
struct Problem {
  CoverArrays covers;
  PieceMoments moments;
  FixedPoints fixed;
  std::vector<Vec3> load;

  Problem(Index cells, int kind)
      : covers(make_rock(cells, kind)),
        moments(piece_moments(covers)),
        load(covers.cover_node.size(), Vec3{0, 0, -1}) {
    for (Index p = 0; p < (cells + 1) * (cells + 1); ++p) {
      fixed.points.element.push_back(0);
      fixed.points.local.push_back({});
      fixed.points.unknown.push_back(p);
      fixed.points.weight.push_back(1);
      fixed.points.begin.push_back(static_cast<Index>(fixed.points.unknown.size()));
      fixed.component.push_back({1, 1, 1});
      fixed.value.push_back({});
      fixed.stiffness.push_back(100 * material.young_modulus / cells);
      fixed.enforce.push_back(Enforce::penalty);
    }
  }
};

/// Bytes resident now.
double resident() {
  double pages = 0, all = 0;
  std::ifstream("/proc/self/statm") >> all >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Bytes resident at most while `run` runs, beyond those before: looked at every two milliseconds.
template <class Run>
double peak_while(Run run) {
  malloc_trim(0);
  const double before = resident();
  std::atomic<bool> done{false};
  double most = before;
  std::thread watch([&] {
    while (!done) {
      most = std::max(most, resident());
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  run();
  done = true;
  watch.join();
  return most - before;
}

/// A time by the wall's clock and by the processor's, s.
struct Seconds {
  double wall = 0, processor = 0;
};

/// The best times of PETSc for a problem.
std::map<std::pair<Index, int>, Seconds> petsc_best;

bool one_thread() {
  return device_description().find("concurrency 1,") != std::string::npos;
}

void solve(benchmark::State& state) {
  const Index cells = static_cast<Index>(state.range(0));
  const int kind = static_cast<int>(state.range(1));
  const Problem problem(cells, kind);
  const auto preconditioner = static_cast<Preconditioner>(state.range(2));
  std::vector<Vec3> x(problem.load.size());
  SolveReport report;
  double peak = 0;
  Seconds seconds;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t ticks = std::clock();
    peak = peak_while([&] {
      CoverSystem system(problem.covers, problem.moments, {material}, problem.fixed,
                         preconditioner);
      std::fill(x.begin(), x.end(), Vec3{});
      report = system.solve({1, 0, 1}, problem.load, x);
    });
    seconds.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    seconds.processor = double(std::clock() - ticks) / CLOCKS_PER_SEC;
  }
  if (!report.converged) state.SkipWithError("did not converge");
  const double unknowns = 3.0 * problem.covers.cover_count();
  state.counters["unknowns"] = unknowns;
  state.counters["iterations"] = report.iterations;
  state.counters["processor_s"] = seconds.processor;
  state.counters["bytes/unknown"] = peak / unknowns;
  if (const auto best = petsc_best.find({cells, kind}); best != petsc_best.end())
    state.counters["times_faster"] = one_thread() ? best->second.processor / seconds.processor
                                                  : best->second.wall / seconds.wall;
}

/// The same cube uncut, of covers with several functions, under its weight.
void solve_order(benchmark::State& state) {
  Problem problem(static_cast<Index>(state.range(0)), 0);
  problem.covers.order = static_cast<int>(state.range(1));
  const auto preconditioner = static_cast<Preconditioner>(state.range(2));
  SolveOptions options;
  options.max_iterations = 50000;
  std::vector<Vec3> load(problem.covers.unknown_count()), x(load.size());
  std::fill(load.begin(), load.begin() + problem.covers.cover_count(), Vec3{0, 0, -10});
  CoverSystem system(problem.covers, {}, {material}, problem.fixed, preconditioner);
  load = system.apply({0, 1, 0}, load);
  SolveReport report;
  for (auto _ : state) {
    std::fill(x.begin(), x.end(), Vec3{});
    report = system.solve({1, 0, 1}, load, x, options);
  }
  if (!report.converged) state.SkipWithError("did not converge");
  state.counters["unknowns"] = 3.0 * problem.covers.unknown_count();
  state.counters["iterations"] = report.iterations;
}

#ifdef ROCKFOLD_PETSC
const char* const petsc_names[] = {"gamg", "bjacobi", "pbjacobi"};

void petsc(benchmark::State& state) {
  const Index cells = static_cast<Index>(state.range(0));
  const int kind = static_cast<int>(state.range(1));
  const Problem problem(cells, kind);
  const double matrix_before = resident();
  const PetscMatrix matrix(problem.covers, problem.moments, material, problem.fixed);
  const double matrix_bytes = resident() - matrix_before;
  CoverSystem ours(problem.covers, problem.moments, {material}, problem.fixed,
                   Preconditioner::block_jacobi);
  std::vector<Vec3> x(problem.load.size());
  for (std::size_t p = 0; p < x.size(); ++p)
    x[p] = {std::sin(0.1 * double(p)), std::cos(0.37 * double(p)), std::sin(1.3 * double(p))};
  const auto a = matrix.apply(x), b = ours.apply({1, 0, 1}, x);
  double difference = 0, largest = 0;
  for (std::size_t p = 0; p < x.size(); ++p)
    for (int d = 0; d < 3; ++d) {
      difference = std::max(difference, std::abs(a[p][d] - b[p][d]));
      largest = std::max(largest, std::abs(a[p][d]));
    }
  if (!(difference < 1e-12 * largest)) state.SkipWithError("not the same matrix");
  PetscResult result;
  double peak = 0;
  for (auto _ : state) {
    peak = peak_while(
        [&] { result = matrix.solve(petsc_names[state.range(2)], 1e-8, problem.load, x); });
    state.SetIterationTime(result.seconds);
    state.counters["processor_s"] = result.processor;
  }
  Seconds& best = petsc_best.try_emplace({cells, kind}, Seconds{result.seconds, result.processor})
                      .first->second;
  best.wall = std::min(best.wall, result.seconds);
  best.processor = std::min(best.processor, result.processor);
  state.SetLabel(petsc_names[state.range(2)]);
  const double unknowns = 3.0 * problem.covers.cover_count();
  state.counters["unknowns"] = unknowns;
  state.counters["iterations"] = result.iterations;
  state.counters["bytes/unknown"] = (peak + matrix_bytes) / unknowns;
}

BENCHMARK(petsc)
    ->ArgNames({"cells", "kind", "preconditioner"})
    ->ArgsProduct({{69}, {0, 2, 3}, {0, 1, 2}})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
#endif

constexpr auto by_blocks = static_cast<int>(Preconditioner::block_jacobi);
constexpr auto by_covers = static_cast<int>(Preconditioner::node_block_jacobi);
constexpr auto by_grids = static_cast<int>(Preconditioner::multigrid);

BENCHMARK(solve)
    ->ArgNames({"cells", "kind", "preconditioner"})
    ->ArgsProduct({{69}, {0, 1, 2, 3}, {by_grids}})
    ->Iterations(1)
    ->Repetitions(3)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
// Iterations against spacing.
BENCHMARK(solve)
    ->ArgNames({"cells", "kind", "preconditioner"})
    ->ArgsProduct({{9, 18, 35, 69}, {0, 2, 3}, {by_blocks, by_grids}})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(solve_order)
    ->ArgNames({"cells", "order", "preconditioner"})
    ->ArgsProduct({{4, 6, 8, 12, 16}, {1, 2}, {by_covers, by_grids}})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
