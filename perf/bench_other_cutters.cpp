// Other splitters on the planes of bench_cut, beside host/cut on one thread in the same run: of_ours is our rate over theirs.
//
//   nef    CGAL's Nef polyhedra, one a cell, intersected with half-spaces: exact
//   voro   voro++'s cells cut by planes: double precision; only where voro++ is installed. by_planes asks voro++ which cells a
//          plane meets, for all cells; depth_first is the plain splitter's order, with planes sorted out by our code
#include <chrono>
#include <cmath>
#include <cstdint>
#include <list>
#include <memory>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/generators.h>
#ifdef ROCKFOLD_VORO
#include <voro++/voro++.hh>
#endif
#include <benchmark/benchmark.h>
#include <omp.h>

#include "generated/version.hpp"
#include "host/cut/cells/complex.hpp"
#include "host/cut/cut.hpp"
#include "perf/shared/three_sets.hpp"

namespace rockfold {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Ours {
  std::int64_t blocks = 0;
  double rate = 0;  // blocks a second
};

// The best of several runs, each long enough to time.
Ours measure_ours(std::int64_t asked) {
  omp_set_num_threads(1);
  const Model model = three_sets(asked);
  Progress silent;
  Ours ours;
  for (int i = 0; i < 20; ++i) {
    const double began = seconds();
    const Cutting cutting = cut_blocks(model, silent);
    const double took = seconds() - began;
    ours.blocks = cutting.complex->block_count;
    ours.rate = std::max(ours.rate, static_cast<double>(ours.blocks) / took);
  }
  return ours;
}

void report(benchmark::State& state, std::size_t blocks) {
  const Ours ours = measure_ours(state.range(0));
  if (static_cast<std::int64_t>(blocks) != ours.blocks)
    state.SkipWithError("not the number of blocks that host/cut makes");
  const auto made = static_cast<double>(blocks) * static_cast<double>(state.iterations());
  state.SetItemsProcessed(static_cast<std::int64_t>(made));
  state.counters["blocks"] = static_cast<double>(blocks);
  state.counters["of_ours"] = benchmark::Counter(
      made / ours.rate, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void nef(benchmark::State& state) {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  using Nef = CGAL::Nef_polyhedron_3<Kernel>;
  const auto planes = plain_planes(three_sets(state.range(0)));
  std::vector<Nef> cells;
  for (auto _ : state) {
    CGAL::Polyhedron_3<Kernel> cube;
    const auto at = [](int x, int y, int z) {
      return Kernel::Point_3(x * cube_edge, y * cube_edge, z * cube_edge);
    };
    CGAL::make_hexahedron(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 1, 1),
                          at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), cube);
    cells.assign(1, Nef(cube));
    for (const PlainPlane& p : planes) {
      const Kernel::Plane_3 plane(p.normal[0], p.normal[1], p.normal[2], -p.offset);
      std::vector<Nef> next;
      for (const Nef& cell : cells) {
        bool below = false, above = false;
        for (auto v = cell.vertices_begin(); v != cell.vertices_end(); ++v) {
          const auto side = plane.oriented_side(v->point());
          below = below || side == CGAL::ON_NEGATIVE_SIDE;
          above = above || side == CGAL::ON_POSITIVE_SIDE;
        }
        if (!(below && above)) {
          next.push_back(cell);
          continue;
        }
        next.push_back(cell.intersection(plane, Nef::CLOSED_HALFSPACE));
        next.push_back(cell.intersection(plane.opposite(), Nef::CLOSED_HALFSPACE));
      }
      cells = std::move(next);
    }
  }
  report(state, cells.size());
}
BENCHMARK(nef)->ArgName("blocks")->Arg(20)->Arg(100)->UseRealTime()->Unit(benchmark::kMillisecond);

#ifdef ROCKFOLD_VORO
// Depth first as the plain splitter does, so that each plane meets only cells near it.
class VoroSplitter {
 public:
  explicit VoroSplitter(std::vector<PlainPlane> planes) : planes_(std::move(planes)) {}

  void run() {
    voro::voronoicell cube;
    cube.init(0, cube_edge, 0, cube_edge, 0, cube_edge);
    std::vector<int> all(planes_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    descend(cube, all);
  }

  std::size_t count = 0;
  long double volume = 0;

 private:
  void descend(voro::voronoicell& cell, const std::vector<int>& list) {
    std::vector<double> points;
    cell.vertices(points);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const PlainPlane& p = planes_[list[i]];
      if (side(points, p) != 0) continue;
      std::vector<int> rest;
      for (std::size_t j = i + 1; j < list.size(); ++j)
        if (side(points, planes_[list[j]]) == 0) rest.push_back(list[j]);
      voro::voronoicell above;
      above = cell;  // its copy constructor would share the memory
      cell.plane(p.normal[0], p.normal[1], p.normal[2], 2 * p.offset);
      above.plane(-p.normal[0], -p.normal[1], -p.normal[2], -2 * p.offset);
      descend(cell, rest);
      descend(above, rest);
      return;
    }
    ++count;
    volume += cell.volume();
  }

  // −1 or +1 where all points lie on one side.
  static int side(const std::vector<double>& points, const PlainPlane& p) {
    bool below = false, above = false;
    for (std::size_t k = 0; k < points.size(); k += 3) {
      const Real d = dot(p.normal, Vec3{points[k], points[k + 1], points[k + 2]}) - p.offset;
      below = below || d < -1e-11;
      above = above || d > 1e-11;
    }
    return below && above ? 0 : above ? 1 : -1;
  }

  std::vector<PlainPlane> planes_;
};

// Plane by plane through all cells, asking voro++ which of them a plane meets.
std::vector<std::unique_ptr<voro::voronoicell>> split_by_planes(
    const std::vector<PlainPlane>& planes) {
  std::vector<std::unique_ptr<voro::voronoicell>> cells;
  cells.push_back(std::make_unique<voro::voronoicell>());
  cells[0]->init(0, cube_edge, 0, cube_edge, 0, cube_edge);
  for (const PlainPlane& p : planes) {
    const auto& n = p.normal;
    const std::size_t count = cells.size();
    for (std::size_t i = 0; i < count; ++i) {
      voro::voronoicell& below = *cells[i];
      // A cell that the plane meets has vertices on either side.
      if (!below.plane_intersects(n[0], n[1], n[2], 2 * p.offset) ||
          !below.plane_intersects(-n[0], -n[1], -n[2], -2 * p.offset))
        continue;
      auto above = std::make_unique<voro::voronoicell>();
      *above = below;
      below.plane(n[0], n[1], n[2], 2 * p.offset);
      above->plane(-n[0], -n[1], -n[2], -2 * p.offset);
      cells.push_back(std::move(above));
    }
  }
  return cells;
}

void voro_by_planes(benchmark::State& state) {
  const auto planes = plain_planes(three_sets(state.range(0)));
  std::size_t blocks = 0;
  for (auto _ : state) {
    const auto cells = split_by_planes(planes);
    blocks = cells.size();
    long double volume = 0;
    for (const auto& cell : cells) volume += cell->volume();
    if (!(std::abs(volume / (cube_edge * cube_edge * cube_edge) - 1) < 1e-9))
      state.SkipWithError("the blocks do not fill the cube");
  }
  report(state, blocks);
}

void voro_depth_first(benchmark::State& state) {
  const auto planes = plain_planes(three_sets(state.range(0)));
  std::size_t blocks = 0;
  for (auto _ : state) {
    VoroSplitter splitter(planes);
    splitter.run();
    blocks = splitter.count;
    if (!(std::abs(splitter.volume / (cube_edge * cube_edge * cube_edge) - 1) < 1e-9))
      state.SkipWithError("the blocks do not fill the cube");
  }
  report(state, blocks);
}
BENCHMARK(voro_depth_first)
    ->ArgName("blocks")
    ->Arg(1000)
    ->Arg(10000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(voro_by_planes)
    ->ArgName("blocks")
    ->Arg(1000)
    ->Arg(10000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
#endif

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("rockfold", std::string(rockfold::version) + " " + rockfold::commit);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::RunSpecifiedBenchmarks();
}
