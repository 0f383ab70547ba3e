#include "kernels/finite/cover_force_kernel.hpp"
#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

/// What a tick of a block needs, in one place for the device.
struct Scene {
  explicit Scene(const Motion::Data& m);
  Schedule schedule;
  HeldRows held;
  Array<Real> mass, factor, stiffness, slowed, damped, rigid, impact, turn, lost, ahead, unbalanced;
  Array<Index> vertex_begin, vertex;
  finite::Deformation rock;
  Field d, v, acceleration, load, force, pull, home, x, speed, outside, target, target_before,
      target_speed;
  Array<std::uint8_t> gone;
  solve::DevicePoints vertices;
  Index covers;
  Real mass_damping;
  Vec3 gravity;
  bool touches, bolted, acted_on, moving;
};

Scene::Scene(const Motion::Data& m)
    : schedule(m.explicit_scheme.schedule),
      held(m.explicit_scheme.held),
      mass(m.explicit_scheme.mass),
      factor(m.explicit_scheme.factor),
      stiffness(m.explicit_scheme.stiffness),
      slowed(m.explicit_scheme.slowed),
      damped(m.explicit_scheme.damped),
      rigid(m.explicit_scheme.rigid),
      impact(m.explicit_scheme.impact),
      turn(m.explicit_scheme.turn),
      lost(m.explicit_scheme.lost),
      ahead(m.explicit_scheme.ahead),
      unbalanced(m.explicit_scheme.unbalanced),
      vertex_begin(m.explicit_scheme.vertex_begin),
      vertex(m.explicit_scheme.vertex),
      rock(*m.rock->finite_strain()),
      d(m.now.displacement),
      v(m.now.velocity),
      acceleration(m.now.acceleration),
      load(m.load),
      pull(m.bolts.force),
      outside(m.explicit_scheme.outside),
      target(m.system.springs.target),
      target_before(m.explicit_scheme.target_before),
      target_speed(m.prescribed),
      gone(m.gone),
      covers(m.covers),
      mass_damping(m.damping.mass),
      gravity(m.gravity),
      touches(m.contact != nullptr),
      bolted(m.bolts.any()),
      acted_on(m.explicit_scheme.outside.extent(0) > 0),
      moving(m.supports.tables.any()) {
  if (!m.contact) return;
  force = m.contact->force;
  home = m.contact->home;
  x = m.contact->motion.x;
  speed = m.contact->motion.v;
  vertices = m.contact->vertex;
}

/// x[3k + d] += the impulses of the points that tick, N s; each(c, impulse) of each.
template <int N, class Each>
KOKKOS_INLINE_FUNCTION void add_impulses(const Schedule& s, const PullingPoints& points,
                                         const Field& force, Index p, const Tick& tick, Real* x,
                                         const Each& each) {
  Real h = 0;
  int of_level = -1;
  for (Index e = points.begin(p); e < points.begin(p + 1); ++e) {
    const Index c = points.entry_point(e);
    const int level = points.level(c);
    if (level < tick.from) break;
    if (level != of_level) h = tick.share * s.interval(of_level = level);
    const Real impulse[3] = {h * force(c, 0), h * force(c, 1), h * force(c, 2)};
    const Real* weight = &points.entry_weight(static_cast<std::size_t>(e) * N);
    for (int k = 0; k < N; ++k)
      for (int i = 0; i < 3; ++i) x[3 * k + i] += weight[k] * impulse[i];
    each(c, impulse);
  }
}

/// Of the contacts that tick. Returns the share of these that impacts explain.
template <int N>
KOKKOS_INLINE_FUNCTION Real add_contact_impulses(const Scene& scene, Index p, const Tick& tick,
                                                 Real* x) {
  const bool shares = scene.impact.extent(0) > 0;
  Real all = 0, explained = 0;
  add_impulses<N>(scene.schedule, scene.schedule.contacts, scene.force, p, tick, x,
                  [&](Index c, const Real* impulse) {
                    if (!shares) return;
                    const Real size =
                        device::math::sqrt(impulse[0] * impulse[0] + impulse[1] * impulse[1] +
                                           impulse[2] * impulse[2]);
                    all += size;
                    explained += scene.impact(c) * size;
                  });
  return explained > 0 ? explained / all : 0;
}

/// That of the rock's stress over h.
template <int N>
KOKKOS_INLINE_FUNCTION void add_stress_impulse(const Scene& scene, Index p, Real h, Real* x) {
  Real f[3 * N] = {};
  finite::take_internal_force(scene.rock, scene.d, p, f,
                              &scene.turn(9 * static_cast<std::size_t>(p)));
  for (int i = 0; i < 3 * N; ++i) x[i] += h * f[i];
}

/// Those of constant loads over h, and of what acts from outside.
template <int N>
KOKKOS_INLINE_FUNCTION void add_load_impulses(const Scene& scene, Index p, const Tick& tick, Real h,
                                              Real* x) {
  constexpr int width = 3 * N;
  for (int i = 0; i < width; ++i) x[i] += h * scene.load(i / 3 * scene.covers + p, i % 3);
  if (scene.factor(p) > 1 && !tick.relaxes)  // what was added has its weight
    for (int i = 0; i < width; ++i)
      x[i] += h * (scene.factor(p) - 1) * scene.mass(static_cast<std::size_t>(p) * N * N + i / 3) *
              scene.gravity[i % 3];
  if (!scene.acted_on || tick.from > 0) return;
  const Real period = tick.share * scene.schedule.period;
  for (int i = 0; i < width; ++i) x[i] += period * scene.outside(i / 3 * scene.covers + p, i % 3);
}

/// v += R (M + θh²K)⁻¹ Rᵀ x, with `share` of the damping of strain, whose impulse is −loss, and what mass damping takes in h. What is damped is the
/// mean of the velocities before and after: it takes energy whatever the impulses are, and in the frame of the middle a block that turns has no
/// strain in it.
template <int N>
KOKKOS_INLINE_FUNCTION void kick(const Scene& scene, Index p, const Real* x, Real share, Real h,
                                 Real* loss) {
  constexpr int n = N, width = 3 * N;
  const std::size_t own = static_cast<std::size_t>(p) * width * width;
  const Real *inverse = &scene.slowed(own), *damped = &scene.damped(own);
  const Real* r = &scene.turn(9 * static_cast<std::size_t>(p));
  Real impulse[3 * N], speed[3 * N], change[3 * N];
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
    for (int i = 0; i < width; ++i)
      for (int j = 0; j < width; ++j) change[i] -= inverse[i * width + j] * impulse[j];
    turn_vector(r, false, n, impulse, loss);
  }
  turn_vector(r, false, n, change, speed);
  const Real half = 0.5 * h * scene.mass_damping;
  for (int i = 0; i < width; ++i) {
    Real& v = scene.v(i / 3 * scene.covers + p, i % 3);
    v = ((1 - half) * v + speed[i]) / (1 + half);
  }
}

/// y = m x, m [n][n] ⊗ 1.
template <int N>
KOKKOS_INLINE_FUNCTION void multiply_mass(const Real* mass, Real factor, const Real* x, Real* y) {
  for (int i = 0; i < 3 * N; ++i) {
    y[i] = 0;
    for (int l = 0; l < N; ++l) y[i] += factor * mass[(i / 3) * N + l] * x[3 * l + i % 3];
  }
}

/// What a velocity has of strain, v − (M + λK)⁻¹ M v, in the block's place.
template <int N>
KOKKOS_INLINE_FUNCTION void strain_part(const Scene& scene, Index p, const Real* velocity,
                                        Real* strain) {
  constexpr int n = N, width = 3 * N;
  const Real* rigid = &scene.rigid(static_cast<std::size_t>(p) * width * width);
  Real impulse[3 * N];
  turn_vector(&scene.turn(9 * static_cast<std::size_t>(p)), true, n, velocity, strain);
  multiply_mass<N>(&scene.mass(static_cast<std::size_t>(p) * n * n), 1, strain, impulse);
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j) strain[i] -= rigid[i * width + j] * impulse[j];
}

/// Restitution is of blocks as wholes: as far as impacts explain what acts on it, a block goes on as a rigid one. Takes `share` of the strain of its velocity,
/// and adds the impulse that this takes to `loss`.
template <int N>
KOKKOS_INLINE_FUNCTION void stiffen(const Scene& scene, Index p, Real share, Real* loss) {
  constexpr int n = N, width = 3 * N;
  const Real* r = &scene.turn(9 * static_cast<std::size_t>(p));
  const Real* k = &scene.stiffness(static_cast<std::size_t>(p) * width * width);
  Real v[3 * N], strain[3 * N], impulse[3 * N];
  for (int i = 0; i < width; ++i) v[i] = scene.v(i / 3 * scene.covers + p, i % 3);
  strain_part<N>(scene, p, v, strain);
  for (int i = 0; i < width; ++i) strain[i] *= share;
  multiply_mass<N>(&scene.mass(static_cast<std::size_t>(p) * n * n), scene.factor(p), strain,
                   impulse);
  const Real h = scene.schedule.interval(scene.schedule.block_level(p)), slow = h * h;
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j) impulse[i] += slow * k[i * width + j] * strain[j];
  turn_vector(r, false, n, strain, v);
  for (int i = 0; i < width; ++i) scene.v(i / 3 * scene.covers + p, i % 3) -= v[i];
  turn_vector(r, false, n, impulse, v);
  for (int i = 0; i < width; ++i) loss[i] += v[i];
}

/// Of force. FLAC and 3DEC take as much.
constexpr Real local_damping = 0.8;

/// Takes off x what points held bear of it, Cᵀ (A Cᵀ)ᵀ x: what is left moves none of them, and nothing is left of a block at rest.
template <int N>
KOKKOS_INLINE_FUNCTION void take_off_held(const Scene& scene, Index p, Real* x) {
  const HeldRows& held = scene.held;
  constexpr int width = 3 * N;
  for (Index set = held.of_block(p); set < held.of_block(p + 1); ++set)
    for (Index r = held.begin(set); r < held.begin(set + 1); ++r) {
      const std::size_t own = static_cast<std::size_t>(r) * width;
      Real taken = 0;
      for (int i = 0; i < width; ++i) taken += held.way(own + i) * x[i];
      for (int i = 0; i < width; ++i) x[i] -= held.row(own + i) * taken;
      held.impulse(r) -= taken;
    }
}

/// Local damping: what each impulse loses.
template <int N>
KOKKOS_INLINE_FUNCTION void relax(const Scene& scene, Index p, Real* x, Real* loss) {
  for (int i = 0; i < 3 * N; ++i) {
    const Real v = scene.v(i / 3 * scene.covers + p, i % 3);
    loss[i] = local_damping * device::math::fabs(x[i]) * (v > 0 ? 1 : v < 0 ? -1 : 0);
    x[i] -= loss[i];
  }
}

/// N: the sizes of all forces on the block, whatever way they act.
KOKKOS_INLINE_FUNCTION Real acting_force(const Scene& scene, Index p) {
  Real sum = 0, square = 0;
  for (int i = 0; i < 3; ++i) square += scene.load(p, i) * scene.load(p, i);
  sum += device::math::sqrt(square);
  if (!scene.touches) return sum;
  for (Index e = scene.schedule.contacts.begin(p); e < scene.schedule.contacts.begin(p + 1); ++e) {
    square = 0;
    for (int i = 0; i < 3; ++i) {
      const Real f = scene.force(scene.schedule.contacts.entry_point(e), i);
      square += f * f;
    }
    sum += device::math::sqrt(square);
  }
  return sum;
}

/// ExplicitScheme::unbalanced, from the impulses x that nothing holds, over h; and the acceleration of the block's own mass under them, as a
/// whole: of a step that relaxes, mass that is added and local damping are a way to rest, and no part of the balance.
template <int N>
KOKKOS_INLINE_FUNCTION void judge_balance(const Scene& scene, Index p, const Real* x, Real h) {
  Real most = 0;
  for (int k = 0; k < N; ++k) {
    Real square = 0;
    for (int i = 0; i < 3; ++i) square += x[3 * k + i] * x[3 * k + i];
    most = device::math::fmax(most, square);
  }
  const Real acts = acting_force(scene, p);
  scene.unbalanced(p) = acts > 0 ? device::math::sqrt(most) / (h * acts) : 0;
  const Real mass = scene.mass(static_cast<std::size_t>(p) * N * N);
  for (int i = 0; i < 3; ++i) scene.acceleration(p, i) = x[i] / (h * mass);
}

/// What the rows of a set lack of `of_point` in the field x of block p.
template <class OfPoint>
KOKKOS_INLINE_FUNCTION void find_lacks(const HeldRows& held, Index set, const Field& x,
                                       Index covers, const OfPoint& of_point, Real* lacks) {
  const Index p = held.cover(set), begin = held.begin(set);
  for (Index r = begin; r < held.begin(set + 1); ++r) {
    const std::size_t own = static_cast<std::size_t>(r) * held.width;
    Real lack = 0;
    for (Index j = begin; j <= r; ++j)
      lack += held.combine(own + (j - begin)) * of_point(held.point(j), held.component(j));
    for (int i = 0; i < held.width; ++i) lack -= held.row(own + i) * x(i / 3 * covers + p, i % 3);
    lacks[r - begin] = lack;
  }
}

/// Points of a block that are held go to their places, where a drift of h has brought it; `gone`: of the period.
template <int N>
KOKKOS_INLINE_FUNCTION void place_held(const Scene& scene, Index p, Real h, Real gone) {
  const HeldRows& held = scene.held;
  const Field target = scene.target, before = scene.target_before;
  const bool moving = scene.moving;
  for (Index set = held.of_block(p); set < held.of_block(p + 1); ++set) {
    const Index begin = held.begin(set);
    Real lacks[3 * N];
    find_lacks(
        held, set, scene.d, scene.covers,
        [&](Index point, int d) {
          return moving ? (1 - gone) * before(point, d) + gone * target(point, d)
                        : target(point, d);
        },
        lacks);
    for (Index r = begin; r < held.begin(set + 1); ++r) {
      held.impulse(r) += lacks[r - begin] / h;
      for (int i = 0; i < held.width; ++i) {
        const Real by = held.way(static_cast<std::size_t>(r) * held.width + i) * lacks[r - begin];
        scene.d(i / 3 * scene.covers + p, i % 3) += by;
        scene.v(i / 3 * scene.covers + p, i % 3) += by / h;
      }
    }
  }
}

/// Takes off the velocity that points of a block held have against that of the supports.
template <int N>
KOKKOS_INLINE_FUNCTION void stop_held(const Scene& scene, Index p) {
  const HeldRows& held = scene.held;
  const Field speed = scene.target_speed;
  for (Index set = held.of_block(p); set < held.of_block(p + 1); ++set) {
    const Index begin = held.begin(set);
    Real lacks[3 * N];
    find_lacks(
        held, set, scene.v, scene.covers, [&](Index point, int d) { return speed(point, d); },
        lacks);
    for (Index r = begin; r < held.begin(set + 1); ++r) {
      held.impulse(r) += lacks[r - begin];
      for (int i = 0; i < held.width; ++i)
        scene.v(i / 3 * scene.covers + p, i % 3) +=
            held.way(static_cast<std::size_t>(r) * held.width + i) * lacks[r - begin];
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
template <int N>
KOKKOS_INLINE_FUNCTION void drift(const Scene& scene, Index p, Index count) {
  const Schedule& s = scene.schedule;
  const int level = s.block_level(p);
  const Real way = s.interval(level);
  for (int i = 0; i < 3 * N; ++i) {
    const Index u = i / 3 * scene.covers + p;
    scene.d(u, i % 3) += way * scene.v(u, i % 3);
  }
  if (!scene.held.any()) return;
  const Index ticks = Index{1} << s.deepest, next = count % ticks + (ticks >> level);
  const Real gone = static_cast<Real>(next) / static_cast<Real>(ticks);
  place_held<N>(scene, p, way, gone);
}

/// N functions a block.
template <int N>
void tick_all(const Motion::Data& m, const Tick& tick) {
  const Scene scene(m);
  constexpr int width = 3 * N;
  const Tick now = tick;
  device::for_each(
      "rockfold::motion::tick", m.explicit_scheme.blocks[tick.from],
      KOKKOS_LAMBDA(const Index b) {
        const Schedule& s = scene.schedule;
        const Index p = s.block(b);
        if (scene.gone(p) != 0) return;
        const Real h = now.share * s.interval(s.block_level(p));
        Real x[3 * N], v[3 * N], loss[3 * N], slowing[3 * N];
        for (int i = 0; i < width; ++i) x[i] = loss[i] = slowing[i] = 0;
        const Real impact = scene.touches ? add_contact_impulses<N>(scene, p, now, x) : 0;
        if (scene.bolted)
          add_impulses<N>(s, s.links, scene.pull, p, now, x, [](Index, const Real*) {});
        add_stress_impulse<N>(scene, p, h, x);
        Real stressed[3 * N];
        for (int i = 0; i < width; ++i) {
          stressed[i] = x[i];
          v[i] = scene.v(i / 3 * scene.covers + p, i % 3);
        }
        add_load_impulses<N>(scene, p, now, h, x);
        if (scene.held.any()) take_off_held<N>(scene, p, x);
        if (now.relaxes) {
          if (now.from == 0) judge_balance<N>(scene, p, x, h);
          relax<N>(scene, p, x, slowing);
        }
        kick<N>(scene, p, x, now.share, h, loss);
        if (impact > 0) stiffen<N>(scene, p, impact, loss);
        if (now.drifts)
          drift<N>(scene, p, now.count);
        else if (scene.held.any())
          stop_held<N>(scene, p);
        Real lost = 0, ahead = 0;
        for (int i = 0; i < width; ++i) {
          const Real after = scene.v(i / 3 * scene.covers + p, i % 3);
          lost += 0.5 * (loss[i] + slowing[i]) * (v[i] + after);
          ahead += 0.5 * stressed[i] * (after - v[i]);
        }
        scene.lost(p) += lost;
        scene.ahead(p) = ahead;
        if (scene.touches && now.drifts) move_vertices(scene, p);
      },
      width);
}

}  // namespace

void tick_blocks(const Motion::Data& m, const Tick& tick) {
  constexpr int linear = 4, quadratic = 10;
  if (m.explicit_scheme.functions == linear)
    tick_all<linear>(m, tick);
  else
    tick_all<quadratic>(m, tick);
}

}  // namespace rockfold::motion
