#include "kernels/finite/cover_force_kernel.hpp"
#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

constexpr int most_width = solve::most_block_width;

/// What a tick of a block needs, in one place for the device.
struct Scene {
  explicit Scene(const Motion::Data& m);
  Schedule schedule;
  HeldRows held;
  Array<Real> slowed, damped, turn, lost, pushed, last_push, last_stress;
  Array<Index> vertex_begin, vertex;
  finite::Deformation rock;
  Field d, v, load, force, home, x, speed, outside, target, target_before;
  Array<std::uint8_t> gone;
  solve::DevicePoints vertices;
  int functions;
  Index covers;
  Real mass_damping;
  bool touches, acted_on, moving;
};

Scene::Scene(const Motion::Data& m)
    : schedule(m.explicit_scheme.schedule),
      held(m.explicit_scheme.held),
      slowed(m.explicit_scheme.slowed),
      damped(m.explicit_scheme.damped),
      turn(m.explicit_scheme.turn),
      lost(m.explicit_scheme.lost),
      pushed(m.explicit_scheme.pushed),
      last_push(m.explicit_scheme.last_push),
      last_stress(m.explicit_scheme.last_stress),
      vertex_begin(m.explicit_scheme.vertex_begin),
      vertex(m.explicit_scheme.vertex),
      rock(*m.rock->finite_strain()),
      d(m.now.displacement),
      v(m.now.velocity),
      load(m.load),
      outside(m.explicit_scheme.outside),
      target(m.system.springs.target),
      target_before(m.explicit_scheme.target_before),
      gone(m.gone),
      functions(m.explicit_scheme.functions),
      covers(m.covers),
      mass_damping(m.damping.mass),
      touches(m.contact != nullptr),
      acted_on(m.explicit_scheme.outside.extent(0) > 0),
      moving(m.supports.tables.any()) {
  if (!m.contact) return;
  force = m.contact->force;
  home = m.contact->home;
  x = m.contact->motion.x;
  speed = m.contact->motion.v;
  vertices = m.contact->vertex;
}

/// x[3k + d] += the impulses of the points that tick, N s.
KOKKOS_INLINE_FUNCTION void add_point_impulses(const Scene& scene, Index p, const Tick& tick,
                                               Real* x) {
  const Schedule& s = scene.schedule;
  const int n = scene.functions;
  for (Index e = s.begin(p); e < s.begin(p + 1); ++e) {
    const Index c = s.entry_point(e);
    if (s.level(c) < tick.from) return;
    const Real h = tick.share * s.interval(s.level(c));
    for (int k = 0; k < n; ++k) {
      const Real w = h * s.entry_weight(static_cast<std::size_t>(e) * n + k);
      for (int i = 0; i < 3; ++i) x[3 * k + i] += w * scene.force(c, i);
    }
  }
}

/// That of the rock's stress over h.
KOKKOS_INLINE_FUNCTION void add_stress_impulse(const Scene& scene, Index p, Real h, Real* x) {
  Real f[most_width] = {};
  finite::take_internal_force(scene.rock, scene.d, p, f,
                              &scene.turn(9 * static_cast<std::size_t>(p)));
  for (int i = 0; i < 3 * scene.functions; ++i) x[i] += h * f[i];
}

/// Those of constant loads over h, and of what acts from outside.
KOKKOS_INLINE_FUNCTION void add_load_impulses(const Scene& scene, Index p, const Tick& tick, Real h,
                                              Real* x) {
  const int width = 3 * scene.functions;
  for (int i = 0; i < width; ++i) x[i] += h * scene.load(i / 3 * scene.covers + p, i % 3);
  if (!scene.acted_on || tick.from > 0) return;
  const Real period = tick.share * scene.schedule.period;
  for (int i = 0; i < width; ++i)
    x[i] += period * scene.outside(i / 3 * scene.covers + p, i % 3);
}

/// v += R (M + θh²K)⁻¹ Rᵀ x, with `share` of the damping of strain and what mass damping takes in h. What is damped is the mean of the velocities
/// before and after: it takes energy whatever the impulses are, and in the frame of the middle a block that turns has no strain in it.
KOKKOS_INLINE_FUNCTION void kick(const Scene& scene, Index p, const Real* x, Real share, Real h) {
  const int n = scene.functions, width = 3 * n;
  const std::size_t own = static_cast<std::size_t>(p) * width * width;
  const Real *inverse = &scene.slowed(own), *damped = &scene.damped(own);
  const Real* r = &scene.turn(9 * static_cast<std::size_t>(p));
  Real impulse[most_width], speed[most_width], change[most_width];
  turn_vector(r, true, n, x, impulse);
  for (int i = 0; i < width; ++i) {
    change[i] = 0;
    for (int j = 0; j < width; ++j) change[i] += inverse[i * width + j] * impulse[j];
  }
  if (share > 0) {
    for (int i = 0; i < width; ++i) impulse[i] = scene.v(i / 3 * scene.covers + p, i % 3);
    turn_vector(r, true, n, impulse, speed);
    for (int i = 0; i < width; ++i) speed[i] += 0.5 * change[i];
    for (int i = 0; i < width; ++i) {
      impulse[i] = 0;
      for (int j = 0; j < width; ++j) impulse[i] += share * damped[i * width + j] * speed[j];
    }
    Real lost = 0;  // the impulse times the mean of the speeds
    for (int i = 0; i < width; ++i) {
      Real less = 0;
      for (int j = 0; j < width; ++j) less += inverse[i * width + j] * impulse[j];
      change[i] -= less;
      lost += impulse[i] * (speed[i] - 0.5 * less);
    }
    scene.lost(p) += lost;
  }
  turn_vector(r, false, n, change, speed);
  const Real half = 0.5 * h * scene.mass_damping;
  for (int i = 0; i < width; ++i) {
    Real& v = scene.v(i / 3 * scene.covers + p, i % 3);
    v = ((1 - half) * v + speed[i]) / (1 + half);
  }
}

/// Impulse times velocity, J.
KOKKOS_INLINE_FUNCTION Real along_velocity(const Scene& scene, Index p, const Real* x) {
  Real sum = 0;
  for (int i = 0; i < 3 * scene.functions; ++i)
    sum += x[i] * scene.v(i / 3 * scene.covers + p, i % 3);
  return sum;
}

/// Component r of C of what the points of a set have.
template <class OfPoint>
KOKKOS_INLINE_FUNCTION Real combined(const HeldRows& held, Index set, Index r,
                                     const OfPoint& of_point) {
  const Index begin = held.begin(set);
  Real sum = 0;
  for (Index j = begin; j <= r; ++j)
    sum += held.combine(static_cast<std::size_t>(r) * held.functions + (j - begin)) *
           of_point(held.point(j), held.component(set));
  return sum;
}

/// What rows lack of `of_point` in the field x of block p.
template <class OfPoint>
KOKKOS_INLINE_FUNCTION void find_lacks(const HeldRows& held, Index set, const Field& x,
                                       Index covers, const OfPoint& of_point, Real* lacks) {
  const Index p = held.cover(set), begin = held.begin(set);
  for (Index r = begin; r < held.begin(set + 1); ++r) {
    Real is = 0;
    for (int k = 0; k < held.functions; ++k)
      is += held.row(static_cast<std::size_t>(r) * held.functions + k) *
            x(k * covers + p, held.component(set));
    lacks[r - begin] = combined(held, set, r, of_point) - is;
  }
}

/// Points of a block that are held go to their places, where a drift of h has brought it; `gone`: of the period.
KOKKOS_INLINE_FUNCTION void place_held(const Scene& scene, Index p, Real h, Real gone) {
  const HeldRows& held = scene.held;
  const Field target = scene.target, before = scene.target_before;
  const bool moving = scene.moving;
  for (Index set = held.of_block(p); set < held.of_block(p + 1); ++set) {
    const Index begin = held.begin(set);
    const int n = held.functions, i = held.component(set);
    Real lacks[most_functions];
    find_lacks(
        held, set, scene.d, scene.covers,
        [&](Index point, int d) {
          return moving ? (1 - gone) * before(point, d) + gone * target(point, d)
                        : target(point, d);
        },
        lacks);
    for (Index r = begin; r < held.begin(set + 1); ++r) {
      for (int k = 0; k < n; ++k) {
        const Real by = held.way(static_cast<std::size_t>(r) * n + k) * lacks[r - begin];
        scene.d(k * scene.covers + p, i) += by;
        scene.v(k * scene.covers + p, i) += by / h;
      }
      for (Index j = begin; j <= r; ++j)
        held.impulse(j) +=
            held.combine(static_cast<std::size_t>(r) * n + (j - begin)) * lacks[r - begin] / h;
    }
  }
}

/// Where the surface vertices of a block are, and how fast they move.
KOKKOS_INLINE_FUNCTION void move_vertices(const Scene& scene, Index p) {
  for (Index i = scene.vertex_begin(p); i < scene.vertex_begin(p + 1); ++i) {
    const Index n = scene.vertex(i);
    Real u[3], w[3];
    solve::interpolate_all(scene.vertices, n, scene.d, u);
    solve::interpolate_all(scene.vertices, n, scene.v, w);
    for (int k = 0; k < 3; ++k) {
      scene.x(n, k) = scene.home(n, k) + u[k];
      scene.speed(n, k) = w[k];
    }
  }
}

/// To where each is touched next.
KOKKOS_INLINE_FUNCTION void drift(const Scene& scene, Index p, Index count) {
  const Schedule& s = scene.schedule;
  const int touched = s.touched(p);
  const Real way = s.interval(touched);
  for (int i = 0; i < 3 * scene.functions; ++i) {
    const Index u = i / 3 * scene.covers + p;
    scene.d(u, i % 3) += way * scene.v(u, i % 3);
  }
  if (!scene.held.any()) return;
  const Index ticks = Index{1} << s.deepest;
  const Real gone = static_cast<Real>(count % ticks + ticks / (Index{1} << touched)) /
                    static_cast<Real>(ticks);
  place_held(scene, p, way, gone);
}

}  // namespace

void tick_blocks(const Motion::Data& m, const Tick& tick) {
  const Scene scene(m);
  const int width = 3 * scene.functions;
  const Tick now = tick;
  device::for_each(
      "rockfold::motion::tick", m.explicit_scheme.blocks[tick.from],
      KOKKOS_LAMBDA(const Index b) {
        const Schedule& s = scene.schedule;
        const Index p = s.block(b);
        if (scene.gone(p) != 0) return;
        const bool own = s.own(p) >= now.from;
        const Real h = own ? now.share * s.interval(s.own(p)) : 0;
        Real x[most_width], push[most_width], stress[most_width];
        for (int i = 0; i < width; ++i) push[i] = stress[i] = 0;
        if (scene.touches) add_point_impulses(scene, p, now, push);
        if (own) add_stress_impulse(scene, p, h, stress);
        for (int i = 0; i < width; ++i) x[i] = push[i] + stress[i];
        if (own) add_load_impulses(scene, p, now, h, x);
        const Real push_before = along_velocity(scene, p, push),
                   stress_before = along_velocity(scene, p, stress);
        kick(scene, p, x, own ? now.share : 0, h);
        if (now.drifts) drift(scene, p, now.count);
        // A force acts along the ways before and after, which points held are part of.
        const Real push_after = along_velocity(scene, p, push);
        const Real start = now.share < 1 && now.drifts ? 1 : now.drifts ? 0.5 : 0;
        scene.pushed(p) += (1 - start) * push_before + start * push_after;
        scene.last_push(p) = 0.5 * (push_after - push_before);
        scene.last_stress(p) = 0.5 * (along_velocity(scene, p, stress) - stress_before);
        if (scene.touches && now.drifts) move_vertices(scene, p);
      },
      width);
}

void stop_held(const Motion::Data& m, const Field& speed) {
  const HeldRows held = m.explicit_scheme.held;
  if (!held.any()) return;
  const auto v = m.now.velocity;
  const Index covers = m.covers;
  device::for_each(
      "rockfold::motion::stop_held", held.sets, KOKKOS_LAMBDA(const Index set) {
        const Index p = held.cover(set), begin = held.begin(set);
        Real lacks[most_functions];
        find_lacks(
            held, set, v, covers, [&](Index point, int d) { return speed(point, d); }, lacks);
        for (Index r = begin; r < held.begin(set + 1); ++r) {
          const std::size_t own = static_cast<std::size_t>(r) * held.functions;
          for (int k = 0; k < held.functions; ++k)
            v(k * covers + p, held.component(set)) += held.way(own + k) * lacks[r - begin];
          for (Index j = begin; j <= r; ++j)
            held.impulse(j) += held.combine(own + (j - begin)) * lacks[r - begin];
        }
      });
}

}  // namespace rockfold::motion
