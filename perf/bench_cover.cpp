// Covers over cut rock: elements a second, and the bytes of the arrays made over the time that the
// machine's memory would take to write them (of_triad). Clipping is computation: its distance from
// that limit is what there is to gain at most.
//
//   uncut     a cube aligned with the lattice: indices only
//   jointed   three inclined sets, 1,029 blocks: nearly every lattice cell is cut
#include <cmath>

#include <benchmark/benchmark.h>

#include "host/cover/cover.hpp"
#include "kernels/integrate/moments.hpp"
#include "perf/run_benchmarks.hpp"

namespace rockfold {
namespace {

Model cube(bool jointed, Real spacing) {
  Model model;
  Solid rock;
  rock.shape = BoxShape{{0, 0, 0}, {10, 10, 10}};
  rock.continues.assign(6, false);
  model.solids.push_back(rock);
  const auto add = [&](Real dip, Real direction, Real apart) {
    JointSet set;
    set.orientation = DipOrientation{dip, direction};
    set.spacing = apart;
    model.joint_sets.push_back(set);
  };
  if (jointed) add(60, 90, 0.91), add(70, 200, 1.2), add(20, 320, 1.33);
  model.materials.resize(1);
  model.cover = CoverSpec{};
  model.cover->spacing = {spacing, spacing, spacing};
  return model;
}

double bytes_of(const CoverArrays& a) {
  return 4.0 * static_cast<double>(a.cover_node.size() + a.regular_cell.size() +
                                   a.regular_cover.size() + 2 * a.regular_block.size() +
                                   3 * a.element_cell.size() + a.element_cover.size() +
                                   3 * a.piece_block.size() + a.triangle_vertex.size()) +
         8.0 * static_cast<double>(a.vertex_xyz.size()) +
         static_cast<double>(a.element_part.size());
}

void covers(benchmark::State& state) {
  const bool jointed = state.range(0) != 0;
  const Model model = cube(jointed, 10.0 / static_cast<Real>(state.range(1)));
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  Covering covering;
  for (auto _ : state) covering = build_covers(cutting, model, silent);
  const CoverArrays& a = covering.arrays;
  const Real cell = std::pow(model.cover->spacing[0], 3);
  Real volume = cell * a.regular_count();
  for (const Real v : piece_moments(a).volume) volume += v;
  if (std::abs(volume / 1000 - 1) > 1e-12) state.SkipWithError("the elements do not fill the rock");
  state.SetItemsProcessed(state.iterations() * a.element_count());
  state.counters["elements"] = a.element_count();
  state.counters["bytes/element"] = bytes_of(a) / a.element_count();
  state.counters["of_triad"] = benchmark::Counter(
      bytes_of(a) * static_cast<double>(state.iterations()) / triad, benchmark::Counter::kIsRate);
}

BENCHMARK(covers)
    ->ArgNames({"jointed", "cells"})
    ->Args({0, 50})
    ->Args({0, 100})
    ->Args({1, 10})
    ->Args({1, 20})
    ->Args({1, 40})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
