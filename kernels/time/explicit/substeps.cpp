#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/time/explicit/explicit_kernel.hpp"
#include "kernels/time/step_kernel.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/timer.hpp"

namespace rockfold::motion {
namespace {

/// Of the distance to which points are looked for, how far vertices may go before they are looked for anew: two that come towards each other
/// then meet no unseen face.
constexpr Real served = 0.25;

/// Substeps of one step: more are a mistake in the model rather than patience.
constexpr double most_substeps = 1e7;

/// v += h M⁻¹ f, less what mass damping takes, and `share` of what the damping of strain does.
void kick(const Motion::Data& m, Real h, Real share) {
  const ExplicitScheme& s = m.explicit_scheme;
  const auto v = m.now.velocity, f = m.right;
  const auto slowed = s.slowed, damped = s.damped, turn = s.turn;
  const auto gone = m.gone;
  const Index covers = m.covers;
  const int n = s.functions, width = 3 * n;
  const Real damp = 1 / (1 + 0.5 * h * m.damping.mass), keep = 1 - 0.5 * h * m.damping.mass;
  device::for_each(
      "rockfold::motion::kick", covers,
      KOKKOS_LAMBDA(const Index p) {
        if (gone(p) != 0) return;
        const std::size_t own = static_cast<std::size_t>(p) * width * width;
        const Real *a = &slowed(own), *loss = &damped(own);
        const Real* r = &turn(9 * static_cast<std::size_t>(p));
        Real x[solve::most_block_width], force[solve::most_block_width],
            speed[solve::most_block_width];
        for (int i = 0; i < width; ++i) x[i] = f(i / 3 * covers + p, i % 3);
        turn_vector(r, true, n, x, force);
        for (int i = 0; i < width; ++i) x[i] = v(i / 3 * covers + p, i % 3);
        turn_vector(r, true, n, x, speed);
        for (int i = 0; i < width; ++i) {
          Real gained = 0, lost = 0;
          for (int j = 0; j < width; ++j) {
            gained += a[i * width + j] * force[j];
            lost += loss[i * width + j] * speed[j];
          }
          x[i] = h * gained - share * lost;
        }
        turn_vector(r, false, n, x, speed);
        for (int i = 0; i < width; ++i) {
          Real& of_own = v(i / 3 * covers + p, i % 3);
          of_own = damp * (keep * of_own + speed[i]);
        }
      },
      width);
}

void drift(const Motion::Data& m, Real h) {
  const auto d = m.now.displacement, v = m.now.velocity;
  device::for_each(
      "rockfold::motion::drift", m.unknowns, KOKKOS_LAMBDA(const Index u) {
        for (int i = 0; i < 3; ++i) d(u, i) += h * v(u, i);
      });
}

/// What the points of a set lack of their targets, by its combinations: component r of C.
KOKKOS_INLINE_FUNCTION Real combined(const HeldRows& held, Index set, Index r,
                                     const Field& of_points) {
  const Index begin = held.begin(set);
  Real sum = 0;
  for (Index j = begin; j <= r; ++j)
    sum += held.combine(static_cast<std::size_t>(r) * held.functions + (j - begin)) *
           of_points(held.point(j), held.component(set));
  return sum;
}

/// Puts points that are held in their places, where a drift of h has brought them, by the impulse that this takes.
void place_held(const Motion::Data& m, Real h) {
  const HeldRows held = m.explicit_scheme.held;
  if (!held.any()) return;
  const auto d = m.now.displacement, v = m.now.velocity, target = m.system.springs.target;
  const Index covers = m.covers;
  const int n = held.functions;
  device::for_each(
      "rockfold::motion::place_held", held.sets, KOKKOS_LAMBDA(const Index set) {
        const Index p = held.cover(set), begin = held.begin(set);
        const int i = held.component(set);
        Real lacks[most_functions];
        for (Index r = begin; r < held.begin(set + 1); ++r) {
          Real is = 0;
          for (int k = 0; k < n; ++k)
            is += held.row(static_cast<std::size_t>(r) * n + k) * d(k * covers + p, i);
          lacks[r - begin] = combined(held, set, r, target) - is;
        }
        for (Index r = begin; r < held.begin(set + 1); ++r)
          for (int k = 0; k < n; ++k) {
            const Real by = held.way(static_cast<std::size_t>(r) * n + k) * lacks[r - begin];
            d(k * covers + p, i) += by;
            v(k * covers + p, i) += by / h;
          }
        for (Index r = begin; r < held.begin(set + 1); ++r)
          for (Index j = begin; j <= r; ++j)
            held.impulse(j) +=
                held.combine(static_cast<std::size_t>(r) * n + (j - begin)) * lacks[r - begin] / h;
      });
}

/// Takes off the velocity that points held have against that of their targets.
void stop_held(const Motion::Data& m, const Field& speed) {
  const HeldRows held = m.explicit_scheme.held;
  if (!held.any()) return;
  const auto v = m.now.velocity;
  const Index covers = m.covers;
  const int n = held.functions;
  device::for_each(
      "rockfold::motion::stop_held", held.sets, KOKKOS_LAMBDA(const Index set) {
        const Index p = held.cover(set), begin = held.begin(set);
        const int i = held.component(set);
        Real lacks[most_functions];
        for (Index r = begin; r < held.begin(set + 1); ++r) {
          Real is = 0;
          for (int k = 0; k < n; ++k)
            is += held.row(static_cast<std::size_t>(r) * n + k) * v(k * covers + p, i);
          lacks[r - begin] = combined(held, set, r, speed) - is;
        }
        for (Index r = begin; r < held.begin(set + 1); ++r)
          for (int k = 0; k < n; ++k)
            v(k * covers + p, i) +=
                held.way(static_cast<std::size_t>(r) * n + k) * lacks[r - begin];
      });
}

/// m/s, of points held, from their targets h ago and now: prescribed.
void find_target_speed(const Motion::Data& m, const Field& before, Real h) {
  const auto target = m.system.springs.target, speed = m.prescribed;
  device::for_each(
      "rockfold::motion::target_speed", m.system.springs.points.count,
      KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i) speed(n, i) = h > 0 ? (target(n, i) - before(n, i)) / h : 0;
      });
}

/// f += what springs pull with; their impulse over h.
void add_springs(const Motion::Data& m, Real h, const Field& f) {
  const solve::Springs s = m.system.springs;
  if (!s.any()) return;
  const auto d = m.now.displacement, force = s.force, impulse = m.explicit_scheme.pull;
  device::for_each(
      "rockfold::motion::springs", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i) {
          force(n, i) = s.held(n, i) > 0
                            ? 0
                            : s.stiffness(n, i) *
                                  (s.target(n, i) - solve::interpolate_one(s.points, n, i, d));
          impulse(n, i) += h * force(n, i);
        }
      });
  solve::scatter(s, 1, force, f);
}

/// One step of the user's, in substeps.
struct ExplicitStep {  // nvcc allows no lambda in a private member
  ExplicitStep(Motion::Data& m, Real dt, const StepCourse& course)
      : m_(m), s_(m.explicit_scheme), dt_(dt), course_(course), began_(m.now.time) {}

  SolveReport run() {
    begin();
    m_.rock->turns(s_.turn);
    find_points();
    find_forces(0);
    SolveReport report;
    report.converged = true;
    Real before = 0;  // the substep before
    for (Real done = 0; done < dt_ && report.converged;) {
      const double left = std::ceil((1 - 1e-12) * (dt_ - done) / critical_);
      if (!(left < most_substeps)) {
        report.converged = false;
        break;
      }
      const Real h = left > 1 ? (dt_ - done) / left : dt_ - done;
      kick(m_, 0.5 * (before + h), before > 0 ? 1 : 0.5);
      done = left > 1 ? done + h : dt_;
      go(h, done);
      before = h;
      ++report.newton;
    }
    end(before);
    report.converged = report.converged && std::isfinite(kinetic_energy(m_));
    return report;
  }

  void begin() {
    m_.rock->begin_step(m_.now.displacement, {});
    if (m_.contact) begin_contact(m_);
    Kokkos::deep_copy(s_.start, m_.now.displacement);
    Kokkos::deep_copy(s_.account, 0.0);
    Kokkos::deep_copy(s_.pull, 0.0);
    Kokkos::deep_copy(s_.held.impulse, 0.0);
    set_time(m_, began_);
    keep_varying();
  }

  /// The points at the places of now, where those there do not serve on; and the substep that they allow.
  void find_points() {
    if (m_.contact) {
      contact::DeviceContacts& contacts = m_.contact->contacts;
      contact::set_motion(*m_.contact, m_.now.displacement, m_.now.velocity, 1, 0);
      const Real still = std::exchange(contacts.options.still, far());
      const Timer timer;
      contact::detect(*m_.contact, m_.system.contacts);
      m_.contact_seconds += timer.seconds();
      contacts.options.still = still;
      Kokkos::deep_copy(m_.contact->force, 0.0);
    }
    critical_ = critical_substep(m_);
    slow_strain(m_, std::min(critical_, dt_));
  }

  /// m: how far vertices may go before points are looked for anew.
  Real far() const { return served * m_.contact->contacts.options.search_distance; }

  bool has_gone_far() const {
    return m_.contact && contact::largest_shift(m_.contact->motion.x,
                                                m_.contact->contacts.current.found_at) > far();
  }

  /// The points go on as they are: what they have taken so far is counted.
  void settle() {
    contact::DeviceContacts& contacts = m_.contact->contacts;
    const Real stored =
        contact::settle_in_place(contacts, m_.contact->motion.x, m_.contact->motion.v);
    const std::vector<Real> account = device::to_host(s_.account);
    Kokkos::deep_copy(s_.account, 0.0);
    m_.now.work.friction += account[0];
    m_.now.work.impact += m_.now.contact_energy - stored - account[0] - account[1];
    m_.now.contact_energy = stored;
  }

  void go(Real h, Real done) {
    if (m_.damping.mass > 0) m_.now.work.damping += 2 * h * m_.damping.mass * kinetic_energy(m_);
    drift(m_, h);
    m_.now.time = began_ + done;
    if (m_.supports.tables.any() || m_.varying_loads.any()) move_targets(h);
    place_held(m_, h);
    find_forces(h);
    count_loads(h);
    if (!has_gone_far()) return;
    settle();
    find_points();
    find_forces(0);
  }

  void move_targets(Real h) {
    Kokkos::deep_copy(m_.stretch_before, m_.system.springs.target);
    set_time(m_, m_.now.time);
    find_target_speed(m_, m_.stretch_before, h);
  }

  /// right = all forces at the places and speeds of now.
  void find_forces(Real h) {
    m_.rock->force(m_.now.displacement, m_.work);
    m_.rock->turns(s_.turn);
    const Field load = m_.load, varying = m_.varying, wall = m_.now.wall, f = m_.right,
                internal = m_.work;
    const bool varies = m_.varying_loads.any();
    const Real share = (m_.now.time - began_) / dt_,
               walls = (1 - share) * m_.now.walls + share * course_.walls;
    device::for_each(
        "rockfold::motion::explicit_forces", m_.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int i = 0; i < 3; ++i)
            f(u, i) = load(u, i) + (varies ? varying(u, i) : 0) +
                      (walls > 0 ? walls * wall(u, i) : 0) - internal(u, i);
        });
    if (m_.following.any())
      add_following_pressures(m_.following, m_.now.time, m_.now.displacement, 1, f);
    if (m_.dashpots.any()) add_dashpots(m_.dashpots, -1, m_.now.velocity, f);
    add_springs(m_, h, f);
    if (!m_.contact) return;
    contact::set_motion(*m_.contact, m_.now.displacement, m_.now.velocity, h > 0 ? 1 / h : 1, h);
    if (m_.system.contacts.any()) {
      contact::advance(m_.contact->contacts, m_.contact->motion, m_.contact->force, s_.account);
      solve::scatter(m_.system.contacts, 1, m_.contact->force, f);
    }
  }

  void keep_varying() {
    if (m_.varying_loads.any()) Kokkos::deep_copy(m_.varying_before, m_.varying);
    if (!m_.following.any()) return;
    Kokkos::deep_copy(m_.following_before, 0.0);
    add_following_pressures(m_.following, m_.now.time, m_.now.displacement, 1, m_.following_before);
  }

  /// Their work over a substep: the mean of both ends times the way.
  void count_loads(Real h) {
    const bool varies = m_.varying_loads.any(), follows = m_.following.any();
    if (!varies && !follows && !m_.dashpots.any()) return;
    const auto way = m_.increment, v = m_.now.velocity;
    device::for_each(
        "rockfold::motion::way_of_substep", m_.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int i = 0; i < 3; ++i) way(u, i) = h * v(u, i);
        });
    Work& work = m_.now.work;
    const auto along = [&](const Field& f) { return solve::dot(m_.system.work, f, m_.increment); };
    if (varies) work.loads += 0.5 * (along(m_.varying_before) + along(m_.varying));
    if (follows) {
      work.loads += 0.5 * along(m_.following_before);
      Kokkos::deep_copy(m_.following_before, 0.0);
      add_following_pressures(m_.following, m_.now.time, m_.now.displacement, 1,
                              m_.following_before);
      work.loads += 0.5 * along(m_.following_before);
    }
    if (varies) Kokkos::deep_copy(m_.varying_before, m_.varying);
    if (!m_.dashpots.any()) return;
    Kokkos::deep_copy(m_.work, 0.0);
    add_dashpots(m_.dashpots, 1, m_.increment, m_.work);
    work.quiet += along(m_.work) / h;
  }

  /// Places and velocities of one time; what the step has done.
  void end(Real before) {
    kick(m_, 0.5 * before, 0.5);
    const bool moving = m_.supports.tables.any();
    if (!moving) Kokkos::deep_copy(m_.prescribed, 0.0);
    stop_held(m_, m_.prescribed);
    leave_out_gone(m_, m_.now.velocity);
    const auto way = m_.increment, d = m_.now.displacement, start = s_.start;
    device::for_each(
        "rockfold::motion::way_of_step", m_.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int i = 0; i < 3; ++i) way(u, i) = d(u, i) - start(u, i);
        });
    find_reactions();
    find_acceleration();
    count_wall_work(m_, m_.now.walls, course_.walls);
    m_.now.walls = course_.walls;
    if (m_.contact) settle();
    m_.energy_made = 0;
    m_.gain = {};
    m_.mean_over = 0;
    m_.step_length = 0;
    ++m_.now.steps;
  }

  /// The mean over the step of what supports pushed with, and their work.
  void find_reactions() {
    const solve::Springs s = m_.system.springs;
    if (!s.any()) return;
    const HeldRows held = s_.held;
    const auto pull = s_.pull, reaction = m_.now.reaction, way = m_.increment;
    device::for_each(
        "rockfold::motion::held_impulse", held.sets, KOKKOS_LAMBDA(const Index set) {
          for (Index r = held.begin(set); r < held.begin(set + 1); ++r)
            pull(held.point(r), held.component(set)) += held.impulse(r);
        });
    const Real rate = 1 / dt_;
    const auto out = m_.sums;
    device::sum_then<1>(
        "rockfold::motion::explicit_reactions", s.points.count, m_.partial,
        KOKKOS_LAMBDA(const Index n, device::Sums<1>& sum) {
          for (int i = 0; i < 3; ++i) {
            reaction(n, i) = rate * pull(n, i);
            sum.value[0] += reaction(n, i) * solve::interpolate_one(s.points, n, i, way);
          }
        },
        KOKKOS_LAMBDA(const device::Sums<1>& sum) { out(0) = sum.value[0]; });
    m_.now.work.supports += device::to_host(m_.sums)[0];
  }

  /// The mean over the step, as implicit steps have it.
  void find_acceleration() {
    const auto v = m_.now.velocity, before = m_.velocity_before, a = m_.now.acceleration;
    const Real rate = 1 / dt_;
    device::for_each(
        "rockfold::motion::explicit_acceleration", m_.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int i = 0; i < 3; ++i) a(u, i) = rate * (v(u, i) - before(u, i));
        });
    m_.mean_over = dt_;
  }

  Motion::Data& m_;
  ExplicitScheme& s_;
  Real dt_;
  const StepCourse& course_;
  Real began_, critical_ = 0;
};

}  // namespace

std::string why_not_explicit(const Motion::Data& m) {
  if (!m.system.of_blocks || m.system.op.functions == 1)
    return "covers are not those of blocks, of order 1 or 2";
  if (m.rock->linear()) return "kinematics are small";
  if (m.damping.stiffness > 0) return "rayleigh has a beta, which no substep is short enough for";
  return "";
}

namespace {

void prepare(Motion::Data& m) {
  ExplicitScheme& s = m.explicit_scheme;
  if (!s.ready) {
    find_inertia(m);
    s.held = find_held_rows(m);
    s.start = device::make_field("motion::explicit_start", m.unknowns);
    s.pull = device::make_field("motion::explicit_pull", m.system.springs.points.count);
    s.account = Array<Real>("rockfold::motion::explicit_account", 2);
    find_stiffness(m);
    s.ready = true;
  }
}

}  // namespace

SolveReport take_explicit_step(Motion::Data& m, Real dt, const StepCourse& course) {
  prepare(m);
  Kokkos::deep_copy(m.velocity_before, m.now.velocity);
  return ExplicitStep(m, dt, course).run();
}

}  // namespace rockfold::motion
