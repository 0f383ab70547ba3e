// Covers over cut rock: elements a second, and the bytes of the arrays made over the time that the
// machine's memory would take to write them (of_triad). Clipping is computation: its distance from
// that limit is what there is to gain at most.
//
//   uncut     a cube aligned with the lattice: indices only
//   jointed   three inclined sets, 1,029 blocks: nearly every lattice cell is cut
//
// Covers of whole blocks (lattice "block"), with all that stands between cutting and the first time step: conditions, loads,
// points and the mesh that is drawn. time/block does not grow with the blocks.
#include <algorithm>
#include <cmath>

#include <benchmark/benchmark.h>

#include "host/cover/cover.hpp"
#include "host/cover/points/loads.hpp"
#include "host/flatten/flatten.hpp"
#include "kernels/integrate/moments.hpp"
#include "perf/shared/run_benchmarks.hpp"
#include "perf/shared/three_sets.hpp"
#include "src/io/viewers/element_mesh.hpp"

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

/// Blocks on a fixed base between rollers and dashpots, loaded from above; one of them is thrown.
Model loaded_blocks(std::int64_t count) {
  Model model = three_sets(count);
  model.materials = {{"rock", 2700, 30e9, 0.25, {}}};
  model.cover = CoverSpec{};
  model.cover->lattice = LatticeKind::block;
  model.cover->order = 1;
  const auto fix = [&](const Region& where, std::array<bool, 3> components) {
    Fixed fixed;
    fixed.where = where;
    fixed.components = components;
    model.fixed.push_back(fixed);
  };
  fix(FaceRegion{0, {4}}, {true, true, true});
  fix(BoxRegion{{-1, -1, -1}, {0.5, cube_edge + 1, cube_edge + 1}}, {true, false, false});
  Traction traction;
  traction.where = FaceRegion{0, {5}};
  traction.value = {0, 0, -1e3};
  model.tractions.push_back(traction);
  QuietBoundary quiet;
  quiet.where = FaceRegion{0, {3}};
  model.quiet_boundaries.push_back(quiet);
  InitialVelocity start;
  start.block_at = Vec3{3.1, 3.2, 3.3};
  start.velocity = {0, 0, -1};
  model.initial_velocities.push_back(start);
  return model;
}

void block_covers(benchmark::State& state) {
  const Model model = loaded_blocks(state.range(0));
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  const BlockArrays blocks = flatten_blocks(cutting, model);
  const std::vector<Vec3> monitors{{4, 4, 4}, {5.11, 4, 9}};
  MaterialPoints vertices;
  for (auto _ : state) {
    const Covering covering = build_covers(cutting, model, silent);
    benchmark::DoNotOptimize(fixed_points(cutting, covering, model));
    benchmark::DoNotOptimize(locate_points(covering, monitors, Slivers::passed_over));
    benchmark::DoNotOptimize(load_points(cutting, covering, model));
    benchmark::DoNotOptimize(quiet_points(cutting, covering, model));
    benchmark::DoNotOptimize(rigid_velocities(covering, blocks.block_count(), model));
    vertices = locate_block_vertices(covering, blocks);
    benchmark::DoNotOptimize(make_element_mesh(covering.arrays));
  }
  if (std::count(vertices.element.begin(), vertices.element.end(), none) > 0)
    state.SkipWithError("vertices of blocks were not found");
  const double count = blocks.block_count();
  state.counters["blocks"] = count;
  state.counters["time/block"] =
      benchmark::Counter(count * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(block_covers)
    ->ArgName("blocks")
    ->Arg(1000)
    ->Arg(4000)
    ->Arg(10000)
    ->Arg(24000)
    ->Arg(88000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
