// Cutting where finite joints and surfaces of triangles cut: seconds, cells a disc or triangle, memory.
//
//   discs    a cube of 100 m with finite discs of radius 5 to 10 m
//   dense    1,000 discs of radius 10 m
//   terrain  ground of posts × posts
//   mesh     a ball with bumps
#include <cmath>
#include <cstdint>
#include <string>

#include <benchmark/benchmark.h>
#include <omp.h>

#include "generated/version.hpp"
#include "host/cut/cells/complex.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "perf/shared/fracture_models.hpp"
#include "perf/shared/memory.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

// Of the solid's own triangles, closed by the flat sides of a terrain.
Real given_volume(const Shape& shape) {
  long double volume = 0;
  const auto* terrain = std::get_if<TerrainShape>(&shape);
  const auto* mesh = std::get_if<MeshShape>(&shape);
  if (!terrain && !mesh) return 1e6;
  const TriangleSurface& surface = terrain ? *terrain->ground : *mesh->surface;
  for (const auto& t : surface.triangles) {
    const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]],
               &c = surface.vertices[t[2]];
    if (terrain)
      volume += cross(b - a, c - a)[2] / 2 * ((a[2] + b[2] + c[2]) / 3 - terrain->base);
    else
      volume += dot(a, cross(b, c)) / 6;
  }
  return static_cast<Real>(volume);
}

void run(benchmark::State& state, const Model& model, Index things, Index blocks) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  Progress silent;
  Cutting cutting;
  for (auto _ : state) {
    cutting = {};
    cutting = cut_blocks(model, silent);
  }
  long double volume = 0;
  for (const CellMoments& m : cutting.complex->moments) volume += m.volume;
  if (!(std::abs(static_cast<Real>(volume) / given_volume(model.solids[0].shape) - 1) < 1e-9))
    state.SkipWithError("the cells do not fill the solid");
  if (blocks != none && cutting.complex->block_count != blocks)
    state.SkipWithError("not the number of blocks that there are");
  const auto cells = static_cast<double>(cutting.totals.cells);
  state.counters["cells"] = cells;
  state.counters["cells/thing"] = cells / static_cast<double>(things);
  state.counters["blocks"] = static_cast<double>(cutting.complex->block_count);
  state.counters["us/cell"] =
      benchmark::Counter(cells * static_cast<double>(state.iterations()) / 1e6,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["peak_MB"] = peak_bytes() / 1e6;
}

void discs(benchmark::State& state) {
  const auto n = static_cast<Index>(state.range(0));
  run(state, disc_network(n, 5, 10), n, none);
}

void dense(benchmark::State& state) {
  const auto n = static_cast<Index>(state.range(0));
  run(state, disc_network(n, 10, 10), n, none);
}

void terrain(benchmark::State& state) {
  const auto n = static_cast<Index>(state.range(0));
  run(state, hilly_terrain(n), 2 * (n - 1) * (n - 1), 1);
}

void mesh(benchmark::State& state) {
  const Model model = bumpy_ball(static_cast<Index>(state.range(0)));
  run(state, model,
      static_cast<Index>(std::get<MeshShape>(model.solids[0].shape).surface->triangles.size()), 1);
}

// Flattening one block of very many faces.
void flatten_terrain(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  const Model model = hilly_terrain(static_cast<Index>(state.range(0)));
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  BlockArrays blocks;
  for (auto _ : state) blocks = flatten_blocks(cutting, model);
  if (blocks.block_count() != 1 || blocks.genus[0] != 0 || blocks.shell_count[0] != 1)
    state.SkipWithError("not one block without holes");
  state.counters["faces"] = static_cast<double>(blocks.face_normal.size());
}

template <std::int64_t... n>
void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"n", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (const std::int64_t size : {n...})
    for (const std::int64_t threads : {1, 2}) b->Args({size, threads});
}
BENCHMARK(discs)->Apply(sizes<1000, 2000, 5000>);
BENCHMARK(dense)->Apply(sizes<1000>);
BENCHMARK(terrain)->Apply(sizes<50, 100, 200, 500>);
BENCHMARK(mesh)->Apply(sizes<50, 100, 160>);
BENCHMARK(flatten_terrain)->Apply(sizes<50, 100, 200, 500>);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("rockfold", std::string(rockfold::version) + " " + rockfold::commit);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::RunSpecifiedBenchmarks();
}
