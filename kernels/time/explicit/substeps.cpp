#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/time/explicit/explicit_kernel.hpp"
#include "kernels/time/step_kernel.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/timer.hpp"

namespace rockfold::motion {
namespace {

/// Of the distance to which points are looked for, how far vertices may go before they are looked for anew: two that come towards each other
/// then meet no unseen face.
constexpr Real served = 0.25;

/// A look costs as much as a tick of some hundred blocks.
constexpr int periods_between_looks = 20;

/// Periods of one step: more are a mistake in the model rather than patience.
constexpr Real most_periods = 1e8;

Real sum_of(const Array<Real>& values) {
  Real sum = 0;
  for (const Real value : device::to_host(values)) sum += value;
  return sum;
}

/// One step of the user's. Its accounts: leapfrog keeps the energy between places and the velocities half a substep before or after them, with the
/// inertia that strain has been given. Half an impulse x = ½ h f at the end of h changes the velocity by Δv and does x·Δv/2 more than the force
/// does along its way, and the half at the start of the next as much less: what contact and the rock's stress are so ahead, without the kinetic energy
/// of strain's inertia, is what a state has more than is kept, substep_energy. (A constant force does the same work either way.)
/// (All is public, since nvcc allows no lambda in a private member.)
struct ExplicitStep {
  ExplicitStep(Motion::Data& data, Real length, const StepCourse& how)
      : m(data), s(data.explicit_scheme), dt(length), course(how), began(data.now.time) {}

  SolveReport run() {
    begin();
    keep_outside();
    SolveReport report;
    while (done < dt && report.converged && !interrupt_signal) {
      find_points();
      if (!(dt - done < most_periods * s.schedule.period)) {
        report.converged = false;
        break;
      }
      const Index ticks = Index{1} << s.schedule.deepest;
      begin_periods();
      for (bool goes_on = true; goes_on; ++report.substeps) {
        for (Index k = 1; k < ticks; ++k) tick(k);
        goes_on = end_period() && !interrupt_signal;
      }
      report.converged = std::isfinite(kinetic_energy(m));
    }
    end();
    report.visits = visits;
    report.shortest = shortest;
    report.added_mass = added_mass;
    return report;
  }

  void begin() {
    m.rock->begin_step(m.now.displacement, {});
    m.following.water = m.following.water_at_end;
    if (m.contact) begin_contact(m);
    Kokkos::deep_copy(s.start, m.now.displacement);
    Kokkos::deep_copy(s.account, 0.0);
    Kokkos::deep_copy(s.lost, 0.0);
    Kokkos::deep_copy(s.unbalanced, 0.0);
    Kokkos::deep_copy(m.now.acceleration, 0.0);
    Kokkos::deep_copy(s.ahead, 0.0);  // of blocks that are gone too
    Kokkos::deep_copy(s.pull, 0.0);
    acts = m.varying_loads.any() || m.following.any() || m.dashpots.any() ||
           m.system.springs.any() || m.now.walls > 0 || course.walls > 0;
    if (m.bolts.any()) bolts::begin_ticks(m.bolts, m.now.displacement, s.ticking);
    if (!acts || s.outside.extent(0) > 0) return;
    s.outside = device::make_field("motion::outside", m.unknowns);
    s.period_start = device::make_field("motion::period_start", m.unknowns);
  }

  /// The points at the places of now, where those there do not serve on; and who ticks how often.
  void find_points() {
    if (m.contact) {
      contact::DeviceContacts& contacts = m.contact->contacts;
      contact::set_motion(*m.contact, m.now.displacement, m.now.velocity, 1, 0);
      const Real still = std::exchange(contacts.options.still, far());
      const Timer timer;
      contact::detect(*m.contact, m.system.contacts);
      m.contact_seconds += timer.seconds();
      contacts.options.still = still;
      // Points begin with the speeds that they ended with, so that half an impulse is the other half of the last one.
      Kokkos::deep_copy(m.contact->motion.v, contacts.speed_before);
      Kokkos::deep_copy(m.contact->force, 0.0);
      const bool rebounds = contacts.options.restitution > 0 && !relaxes();
      s.impact = {};
      if (rebounds) s.impact = Array<Real>("motion::impact_share", m.contact->force.extent(0));
    }
    find_block_steps(m);
    make_schedule(m, dt - done, longest_period(), course);
    shortest = std::min(shortest, s.schedule.interval(s.schedule.deepest));
    added_mass = std::max(added_mass, s.added_mass);
  }

  /// m: how far vertices may go before points are looked for anew.
  Real far() const { return served * m.contact->contacts.options.search_distance; }

  /// s, in which no vertex goes farther than that: points are looked for between periods.
  Real longest_period() const {
    const Real speed = m.contact ? contact::largest_length(m.contact->contacts.speed_before) : 0;
    return speed > 0 ? far() / speed : std::numeric_limits<Real>::infinity();
  }

  bool has_gone_far() const {
    return m.contact && contact::largest_shift(m.contact->motion.x,
                                               m.contact->contacts.current.found_at) > far();
  }

  bool relaxes() const { return course.relaxes(); }

  /// Of a step that relaxes: whether all blocks were in balance at the end of the last period but one, looked at now and then. Time goes to the step's
  /// end.
  bool is_at_rest() {
    if (!relaxes() || ++periods % periods_between_looks != 0) return false;
    const auto unbalanced = s.unbalanced;
    const Real most = device::largest(
        "rockfold::motion::unbalanced", m.covers,
        KOKKOS_LAMBDA(const Index p) { return unbalanced(p); });
    if (most > course.tolerance_of_balance) {
      Kokkos::deep_copy(s.held.impulse, 0.0);
      Kokkos::deep_copy(s.pull, 0.0);
      pulls_since =
          done - 0.5 * s.schedule.period;  // the impulse of now is from half a period before
      return false;
    }
    pulls_until = done;
    done = dt;
    m.now.time = began + dt;
    return true;
  }

  /// What pulls and pushes as often as level `from`, at the places of now.
  void advance_forces(int from) {
    advance_points(from);
    if (m.bolts.any())
      bolts::tick(m.bolts, m.now.displacement, s.schedule.bolt, s.bolts[from], s.ticking);
  }

  void advance_points(int from) {
    if (!m.contact || !m.system.contacts.any()) return;
    const Schedule& schedule = s.schedule;
    if (s.points[from] == 0) return;
    contact::advance(m.contact->contacts, m.contact->motion,
                     {schedule.point, schedule.contacts.level, s.points[from], schedule.period,
                      relaxes() ? 1 : m.contact->contacts.options.restitution},
                     m.contact->force, s.impact, s.account);
    visits += s.points[from];
  }

  /// Half an impulse of all, and off.
  void begin_periods() {
    set_period_time();
    advance_forces(0);
    find_outside(0.5);
    tick_blocks(m, {0, 0.5, true, 0, relaxes()});
  }

  void tick(Index k) {
    int from = s.schedule.deepest;
    for (Index left = k; left % 2 == 0; left /= 2) --from;
    if (s.blocks[from] == 0) return;
    advance_forces(from);
    tick_blocks(m, {from, 1, true, k, relaxes()});
  }

  /// Whether another period follows: not at the end of the step, nor where points are to be looked for.
  bool end_period() {
    const Real period = s.schedule.period;
    done = dt - done < 1.5 * period ? dt : done + period;
    m.now.time = began + done;
    const bool goes_on = done < dt && !is_at_rest() && !has_gone_far();
    if (goes_on) set_period_time();
    advance_forces(0);
    find_outside(goes_on ? 1 : 0.5);
    count_outside();
    if (!goes_on) find_target_speed();
    tick_blocks(m, {0, goes_on ? 1 : 0.5, goes_on, 0, relaxes()});
    if (!goes_on && m.contact) settle();
    if (!goes_on) count_held();
    return goes_on;
  }

  /// The points go on as they are: what they have taken so far is counted.
  void settle() {
    contact::DeviceContacts& contacts = m.contact->contacts;
    const Real stored =
        contact::settle_in_place(contacts, m.contact->motion.x, m.contact->motion.v);
    const std::vector<Real> account = device::to_host(s.account);
    Kokkos::deep_copy(s.account, 0.0);
    m.now.work.friction += account[0];
    // Nothing hits anything while rock relaxes: what contact takes then is part of the way to rest.
    Real& taken = relaxes() ? m.now.work.damping : m.now.work.impact;
    taken += m.now.contact_energy - stored - account[0] - account[1];
    m.now.contact_energy = stored;
  }

  /// Targets of supports at the start and the end of the period that begins now.
  void set_period_time() {
    if (!m.supports.tables.any()) return;
    move_supports(m.supports, m.now.time, m.system.springs);
    Kokkos::deep_copy(s.target_before, m.system.springs.target);
    move_supports(m.supports, m.now.time + s.schedule.period, m.system.springs);
  }

  /// What acts from outside, now; `share` of a period's impulse goes to the supports' springs.
  void find_outside(Real share) {
    if (!acts) return;
    if (m.varying_loads.any()) varying_load(m.varying_loads, m.now.time, m.varying);
    const Field f = s.outside, varying = m.varying, wall = m.now.wall;
    const bool varies = m.varying_loads.any();
    const Real gone = done / dt, walls = (1 - gone) * m.now.walls + gone * course.walls;
    device::for_each(
        "rockfold::motion::outside", m.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int i = 0; i < 3; ++i)
            f(u, i) = (varies ? varying(u, i) : 0) + (walls > 0 ? walls * wall(u, i) : 0);
        });
    if (m.following.any())
      add_following_pressures(m.following, m.now.time, m.now.displacement, 1, f);
    if (m.dashpots.any()) add_dashpots(m.dashpots, -1, m.now.velocity, f);
    add_springs(share * s.schedule.period, f);
  }

  /// f += what springs pull with; their impulse over h.
  void add_springs(Real h, const Field& f) {
    const solve::Springs springs = m.system.springs;
    if (!springs.any()) return;
    const auto d = m.now.displacement, force = springs.force, impulse = s.pull,
               target = m.supports.tables.any() ? s.target_before : springs.target;
    device::for_each(
        "rockfold::motion::springs", springs.points.count, KOKKOS_LAMBDA(const Index n) {
          for (int i = 0; i < 3; ++i) {
            force(n, i) =
                springs.held(n, i) > 0
                    ? 0
                    : springs.stiffness(n, i) *
                          (target(n, i) - solve::interpolate_one(springs.points, n, i, d));
            impulse(n, i) += h * force(n, i);
          }
        });
    solve::scatter(springs, 1, force, f);
  }

  /// Work over the period that ends: the mean of both ends times the way.
  void count_outside() {
    Work& work = m.now.work;
    if (m.damping.mass > 0)
      work.damping += 2 * s.schedule.period * m.damping.mass * kinetic_energy(m);
    const bool varies = m.varying_loads.any(), follows = m.following.any();
    if (!varies && !follows && !m.dashpots.any()) return;
    const auto way = m.increment, d = m.now.displacement, start = s.period_start;
    device::for_each(
        "rockfold::motion::way_of_period", m.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int i = 0; i < 3; ++i) {
            way(u, i) = d(u, i) - start(u, i);
            start(u, i) = d(u, i);
          }
        });
    const auto along = [&](const Field& f) { return solve::dot(m.system.work, f, m.increment); };
    if (varies) {
      work.loads += 0.5 * (along(m.varying_before) + along(m.varying));
      Kokkos::deep_copy(m.varying_before, m.varying);
    }
    if (follows) {
      work.loads += 0.5 * along(m.following_before);
      keep_following();
      work.loads += 0.5 * along(m.following_before);
    }
    if (!m.dashpots.any()) return;
    Kokkos::deep_copy(m.work, 0.0);
    add_dashpots(m.dashpots, 1, m.increment, m.work);
    work.quiet += along(m.work) / s.schedule.period;
  }

  void keep_following() {
    Kokkos::deep_copy(m.following_before, 0.0);
    add_following_pressures(m.following, m.now.time, m.now.displacement, 1, m.following_before);
  }

  /// What the work of the first period starts from.
  void keep_outside() {
    if (!acts) return;
    Kokkos::deep_copy(s.period_start, m.now.displacement);
    if (m.varying_loads.any()) varying_load(m.varying_loads, m.now.time, m.varying_before);
    if (m.following.any()) keep_following();
  }

  /// Places and velocities are of one time; what the step has done.
  void end() {
    set_time(m, m.now.time);
    leave_out_gone(m, m.now.velocity);
    m.now.substep_energy = sum_of(s.ahead) - added_inertia(m);
    const auto way = m.increment, d = m.now.displacement, start = s.start;
    const auto v = m.now.velocity, before = m.velocity_before, a = m.now.acceleration;
    const Real rate = 1 / dt;
    const bool judged = relaxes();
    device::for_each(
        "rockfold::motion::end_of_step", m.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int i = 0; i < 3; ++i) {
            way(u, i) = d(u, i) - start(u, i);
            if (!judged) a(u, i) = rate * (v(u, i) - before(u, i));
          }
        });
    find_reactions();
    m.now.work.damping += sum_of(s.lost);
    if (m.bolts.any()) m.now.work.bolts += sum_of(s.ticking.work);
    count_wall_work(m, m.now.walls, course.walls);
    m.now.walls = course.walls;
    m.energy_made = m.crossing = 0;
    m.gain = {};
    m.mean_over = dt;
    m.step_length = 0;
    ++m.now.steps;
  }

  /// m/s, of the targets over the last period: prescribed.
  void find_target_speed() {
    const auto target = m.system.springs.target, before = s.target_before, speed = m.prescribed;
    const bool moving = m.supports.tables.any();
    const Real period = s.schedule.period;
    device::for_each(
        "rockfold::motion::target_speed", m.system.springs.points.count,
        KOKKOS_LAMBDA(const Index n) {
          for (int i = 0; i < 3; ++i)
            speed(n, i) = moving ? (target(n, i) - before(n, i)) / period : 0;
        });
  }

  /// What the points held of a block have pushed with, shared among all of them.
  void count_held() {
    const HeldRows held = s.held;
    if (!held.any()) return;
    const auto pull = s.pull;
    device::for_each(
        "rockfold::motion::held_impulse", held.sets, KOKKOS_LAMBDA(const Index set) {
          const Index begin = held.begin(set), count = held.begin(set + 1) - begin;
          for (Index e = held.entry_begin(set); e < held.entry_begin(set + 1); ++e)
            for (Index r = 0; r < count; ++r)
              pull(held.entry_point(e), held.entry_component(e)) +=
                  held.share(static_cast<std::size_t>(e) * held.width + r) *
                  held.impulse(begin + r);
        });
    Kokkos::deep_copy(held.impulse, 0.0);
  }

  /// The mean over the step of what supports pushed with, and their work.
  void find_reactions() {
    const solve::Springs springs = m.system.springs;
    if (!springs.any()) return;
    const auto pull = s.pull, reaction = m.now.reaction, way = m.increment;
    const Real rate = 1 / ((pulls_until > 0 ? pulls_until : dt) - pulls_since);
    const auto out = m.sums;
    device::sum_then<1>(
        "rockfold::motion::explicit_reactions", springs.points.count, m.partial,
        KOKKOS_LAMBDA(const Index n, device::Sums<1>& sum) {
          for (int i = 0; i < 3; ++i) {
            reaction(n, i) = rate * pull(n, i);
            sum.value[0] += reaction(n, i) * solve::interpolate_one(springs.points, n, i, way);
          }
        },
        KOKKOS_LAMBDA(const device::Sums<1>& sum) { out(0) = sum.value[0]; });
    m.now.work.supports += device::to_host(m.sums)[0];
  }

  Motion::Data& m;
  ExplicitScheme& s;
  Real dt;
  const StepCourse& course;
  Real began, done = 0;
  Real pulls_since = 0,
       pulls_until = 0;  ///< s, over which reactions are the mean; until 0: the step's end
  Real shortest = std::numeric_limits<Real>::infinity(), added_mass = 0;  ///< of all schedules
  std::int64_t visits = 0, periods = 0;
  bool acts = false;  ///< something from outside, beside constant loads
};

void prepare(Motion::Data& m) {
  ExplicitScheme& s = m.explicit_scheme;
  if (s.ready) return;
  find_inertia(m);
  s.start = device::make_field("motion::explicit_start", m.unknowns);
  s.pull = device::make_field("motion::explicit_pull", m.system.springs.points.count);
  s.target_before = device::make_field("motion::target_before", m.system.springs.points.count);
  s.account = Array<Real>("rockfold::motion::explicit_account", 2);
  s.ready = true;
}

}  // namespace

SolveReport take_explicit_step(Motion::Data& m, Real dt, const StepCourse& course) {
  prepare(m);
  Kokkos::deep_copy(m.velocity_before, m.now.velocity);
  return ExplicitStep(m, dt, course).run();
}

Real count_substep_visits(Motion::Data& m, Real dt, Real mass_scaling) {
  if (!m.contact) return 0;
  prepare(m);
  StepCourse course;
  course.mass_scaling = mass_scaling;
  ExplicitStep step(m, dt, course);
  begin_contact(m);
  step.find_points();
  const ExplicitScheme& s = m.explicit_scheme;
  if (!m.system.contacts.any()) return 0;
  Real visits = s.points[0];  // of a period
  for (std::size_t level = 1; level < s.points.size(); ++level)
    visits += static_cast<Real>(s.points[level]) * std::pow(2, static_cast<int>(level) - 1);
  return visits / s.schedule.period;
}

}  // namespace rockfold::motion
