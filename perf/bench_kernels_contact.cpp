// Detection and forces of contact on a pyramid of unit cubes (layers of 14², 13² … 1², pitch 1.02 m, each cube on four), pressed
// together by 1e-5 m a layer and moving a little from step to step, as in a time step that has settled.
//
// `pairs` are those whose points are made anew in each detection, `points` the contact points; one call a step of either is the least that
// a step needs. The sum of forces is checked: a wrong answer fails.
#include <cmath>
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "kernels/contact/contact.hpp"
#include "perf/shared/run_benchmarks.hpp"

namespace rockfold {
namespace {

constexpr Real pitch = 1.02, closed = 1e-5;

void add_cube(const Vec3& low, SurfaceArrays& s) {
  static constexpr int face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const Index first = s.vertex_count(), block = s.block_count();
  for (int i = 0; i < 8; ++i) {
    s.part_vertex.push_back(s.vertex_count());
    s.vertex.push_back({low[0] + (i & 1), low[1] + (i >> 1 & 1), low[2] + (i >> 2)});
    s.vertex_block.push_back(block);
  }
  for (const auto& f : face) {
    for (const int v : f) s.corner_vertex.push_back(first + v);
    s.corner_begin.push_back(static_cast<Index>(s.corner_vertex.size()));
    s.face_joint.push_back(none);
    s.face_material.push_back(none);
  }
  s.block_mass.push_back(2500);
  s.part_block.push_back(block);
  s.part_vertex_begin.push_back(static_cast<Index>(s.part_vertex.size()));
  s.part_face_begin.push_back(s.face_count());
}

SurfaceArrays pyramid(int layers) {
  SurfaceArrays s;
  s.tolerance = 1e-9 * pitch * layers;
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < layers - layer; ++i)
      for (int j = 0; j < layers - layer; ++j)
        add_cube({pitch * (i + 0.5 * layer), pitch * (j + 0.5 * layer), (1 - closed) * layer}, s);
  find_edges(s);
  return s;
}

Contacts make_contacts(const SurfaceArrays& s) {
  ContactOptions o;
  JointLaw law;
  law.normal_stiffness = law.shear_stiffness = 1e9;
  law.friction = law.residual_friction = 0.7;
  o.laws = {law};
  o.search_distance = 1e-3;
  o.skin = 0.01;
  return {s, o};
}

/// Cubes of one layer that rest on the next: four contacts each, areas of 0.49².
Index contacts_of(int layers) {
  Index n = 0;
  for (int k = 1; k < layers; ++k) n += 4 * k * k;
  return n;
}

void detect(benchmark::State& state) {
  const int layers = static_cast<int>(state.range(0));
  const SurfaceArrays s = pyramid(layers);
  Contacts contacts = make_contacts(s);
  contacts.detect(s.vertex);
  std::vector<Vec3> x = s.vertex;
  DetectReport report;
  Real shift = 1e-8;
  for (auto _ : state) {
    for (std::size_t v = 0; v < x.size(); v += 3) x[v][0] += shift;
    shift = -shift;
    report = contacts.detect(x);
    contacts.accept(x);
  }
  const auto forces = contacts.points();
  Real area = 0;
  for (const ContactPoint& p : forces)
    if (std::abs(p.normal[2]) > 0.9) area += p.area;
  const Real expected = contacts_of(layers) * 0.49 * 0.49;
  if (std::abs(area / expected - 1) > 1e-4) throw std::runtime_error("the areas are wrong");
  state.counters["pairs"] = report.pairs;
  state.counters["points"] = report.points;
  state.counters["touching_pairs_per_s"] = benchmark::Counter(
      static_cast<double>(contacts_of(layers)) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
  state.counters["bytes_a_point"] = sizeof(ContactPoint);
}

void evaluate(benchmark::State& state) {
  const int layers = static_cast<int>(state.range(0));
  const SurfaceArrays s = pyramid(layers);
  Contacts contacts = make_contacts(s);
  contacts.detect(s.vertex);
  Contacts::Forces f;
  for (auto _ : state) f = contacts.evaluate(s.vertex);
  Real force = 0;
  for (const Vec3& v : f.force) force += std::abs(v[2]);
  const Real expected = contacts_of(layers) * 0.49 * 0.49 * 1e9 * closed;
  if (std::abs(force / expected - 1) > 1e-4) throw std::runtime_error("the forces are wrong");
  state.counters["points_per_s"] = benchmark::Counter(
      static_cast<double>(f.force.size()) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}

BENCHMARK(detect)->Arg(14)->Arg(31)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(evaluate)->Arg(14)->Arg(31)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
