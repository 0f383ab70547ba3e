// The prediction of a step (Hughes 1987, ch. 9) from an acceleration p:
//   d' = d + Δt v + Δt²/2 p,  v' and a' as Newmark's formulas then ask.
// Corrections leave functions at rest that move no rock (docs/theory.md), and the prediction must not make them move faster: with p = a of the
// step before an error of a goes on for ever, that of v grows with t and that of d with t². p = 0, or that of free fall where nothing holds or
// touches the rock, leaves v as it is, and of a 1 − 1/(2β), which is no more than there was where β ≥ 1/4. Below p = a: steps are short there.
#include "kernels/time/step_kernel.hpp"
#include "src/base/vector.hpp"

namespace rockfold::motion {

Vec3 free_fall(const Motion::Data& m, Real dt) {
  const TimeTable& base = m.varying_loads.base;
  if (base.empty()) return m.gravity;
  return m.gravity - 0.5 * (base.at(m.now.time - dt) + base.at(m.now.time));
}

void predict(Motion::Data& m, Real dt) {
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration, way = m.increment;
  const Real of_mass = 1 / (m.beta * dt * dt), of_damping = m.gamma / (m.beta * dt);
  const bool free = !m.system.springs.any() && !m.contact && m.now.dynamic_ratio > 0;
  const Vec3 fall = free ? free_fall(m, dt) : Vec3{};
  const Kokkos::Array<Real, 3> falls{fall[0], fall[1], fall[2]};
  const bool as_before = m.beta < 0.25;
  const Index constants = m.covers;
  device::for_each(
      "rockfold::motion::predict", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          const Real guess = as_before ? a(p, i) : p < constants ? falls[i] : 0;
          const Real left = 0.5 * dt * dt * (a(p, i) - guess);
          way(p, i) = dt * v(p, i) + 0.5 * dt * dt * guess;
          v(p, i) += dt * a(p, i) - of_damping * left;
          a(p, i) -= of_mass * left;
          d(p, i) += way(p, i);
        }
      });
}

}  // namespace rockfold::motion
