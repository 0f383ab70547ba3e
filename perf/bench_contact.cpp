// Whole time steps with contact: a pyramid of unit cubes (layers of 14², 13² … 1² on a floor, pitch 1.02 m, each cube on four) that has settled
// stands under its weight. `block_s_per_s`: simulated block-seconds a second of wall time, at the stated penetration and energy error; detection
// included, cutting and covers not. Peers, on one core of the same kind of machine: Yade's polyhedra 0.048, Bullet's rigid bodies 158.
//
// Masses in motion, by explicit steps: that pyramid shaken by half of gravity, and a slope of 819 blocks on 20° of friction that is let go.
// `block_substeps_per_cpu_s`: blocks times substeps of the slowest of them, in a second of one core; `of_rockable`: over the 120,000 that Rockable
// reports for a core (polyhedra of few vertices).
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "perf/shared/moving_rock.hpp"
#include "perf/shared/run_benchmarks.hpp"
#include "src/arrays/contact_arrays.hpp"

namespace rockfold {
namespace {

constexpr int layers = 14;
constexpr Index settling = 20;
constexpr Real pitch = 1.02;

std::string box(const std::string& name, const Vec3& low, const Vec3& high) {
  return fmt::format(
      "[[solid]]\nname = '{}'\nshape = 'box'\nmin = [{}, {}, {}]\nmax = [{}, {}, {}]\ninterface = "
      "'clean'\n",
      name, low[0], low[1], low[2], high[0], high[1], high[2]);
}

/// `then`: the step after it has settled, and what acts in it.
std::string pyramid(const std::string& then) {
  std::string text = fmt::format(
      "[[material]]\ndensity = 2500\nyoung_modulus = 1e10\npoisson_ratio = 0.25\n"
      "[[joint_material]]\nname = 'clean'\nfriction_angle = 35\n"
      "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {{block_at = [0, 0, -0.5]}}\n"
      "[[step]]\ntype = 'quasi_static'\ntime_step = 0.1\nsteps = {}\n"
      "[[step]]\nname = 'then'\ntype = 'dynamic'\n{}\n[output]\nevery = {}\n",
      settling, then, settling);
  text += box("floor", {-1, -1, -1}, {pitch * layers + 1, pitch * layers + 1, 0});
  int count = 0;
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < layers - layer; ++i)
      for (int j = 0; j < layers - layer; ++j) {
        const Vec3 low{pitch * (i + 0.5 * layer), pitch * (j + 0.5 * layer),
                       static_cast<Real>(layer)};
        text += box("cube" + std::to_string(++count), low, {low[0] + 1, low[1] + 1, low[2] + 1});
      }
  return text;
}

/// Argument: the time step, ms.
void stand(benchmark::State& state) {
  const Real dt = 1e-3 * static_cast<Real>(state.range(0));
  const auto steps = static_cast<Index>(std::lround(0.2 / dt));
  MovingRock a;
  for (auto _ : state) {
    a = run_moving_rock(pyramid(fmt::format("time_step = {}\nsteps = {}", dt, steps)), settling);
    state.SetIterationTime(a.seconds);
  }
  const RunResult& r = a.result;
  if (!r.rest->at_rest || r.rest->moved > 0) throw std::runtime_error("the pyramid does not stand");
  Index newton = 0;
  Real error = 0, largest = 0;
  for (std::size_t n = settling + 1; n < r.energies.size(); ++n) {
    newton += r.contact_history.iterations[n];
    error = std::max(error, std::abs(r.energies[n].numerical - r.energies[settling].numerical));
    largest = std::max(largest, r.energies[n].contact);
  }
  const double simulated = static_cast<double>(steps) * dt * static_cast<double>(a.blocks - 1);
  state.counters["block_s_per_s"] = simulated / a.seconds;
  state.counters["block_s_per_cpu_s"] = simulated / a.processor;
  state.counters["bytes_a_point"] = sizeof(ContactPoint);
  state.counters["newton_a_step"] = static_cast<double>(newton) / static_cast<double>(steps);
  state.counters["products_a_newton"] =
      static_cast<double>(r.iterations.pcg) / static_cast<double>(r.iterations.open_close);
  state.counters["detection_share"] = r.seconds.contact / (r.seconds.contact + r.seconds.solve);
  state.counters["points"] =
      static_cast<double>(r.contacts.open + r.contacts.stick + r.contacts.slide);
  state.counters["penetration_m"] = r.contacts.largest_penetration;
  state.counters["energy_error"] = error / largest;
}

BENCHMARK(stand)->Arg(1)->Arg(2)->Arg(5)->Arg(10)->UseManualTime()->Iterations(1)->Unit(
    benchmark::kSecond);

/// By explicit steps.
void move(benchmark::State& state, const std::string& text, Real seconds) {
  MovingRock a;
  for (auto _ : state) {
    a = run_moving_rock(text, settling);
    state.SetIterationTime(a.seconds);
  }
  const RunResult& r = a.result;
  const Energy &begin = r.energies[settling], &end = r.energies.back();
  const Real turned_over =
      std::abs(end.potential - begin.potential) + end.kinetic + end.friction + end.impact;
  const double substeps = static_cast<double>(r.by_substeps.at(0).substeps) * (a.blocks - 1),
               simulated = seconds * (a.blocks - 1);
  state.counters["block_s_per_s"] = simulated / a.seconds;
  state.counters["block_s_per_cpu_s"] = simulated / a.processor;
  state.counters["block_substeps_per_cpu_s"] = substeps / a.processor;
  state.counters["of_rockable"] = substeps / a.processor / 120e3;
  state.counters["of_yade"] = simulated / a.processor / 0.048;
  state.counters["visits_per_cpu_s"] =
      static_cast<double>(r.by_substeps.at(0).visits) / a.processor;
  state.counters["detection_share"] = r.seconds.contact / (r.seconds.contact + r.seconds.solve);
  state.counters["energy_error"] = std::abs(end.numerical - begin.numerical) / turned_over;
}

void shake(benchmark::State& state) {
  std::string then =
      "scheme = 'explicit'\ntime_step = 0.02\nsteps = 20\n[base_acceleration]\nstep = 'then'\n"
      "unit = 'g'\ndirection = [1, 0, 0]\ntable = [";
  for (int i = 0; i <= 40; ++i) {  // two periods of 5 Hz
    const Real t = 0.01 * i;
    then += fmt::format("[{:.3f}, {:.6f}], ", t, 0.5 * std::sin(10 * std::numbers::pi * t));
  }
  move(state, pyramid(then + "]"), 0.4);
}

void let_go(benchmark::State& state) {
  move(state, jointed_slope(20, settling, "scheme = 'explicit'\ntime_step = 0.01\nsteps = 20"),
       0.2);
}

BENCHMARK(shake)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(let_go)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace rockfold

int main(int argc, char** argv) {
  return rockfold::run_benchmarks(argc, argv);
}
