#include "host/stability/collapse_forces.hpp"

#include <algorithm>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real least_of_all =
    1e-3;  // strength a thousand times what there is balances nothing more
constexpr Index most_rounds = 20, most_tries = 12;
constexpr Real gap = 1e-4;       // of the largest jump: what a rounder cone could save
constexpr Real balanced = 1e-9;  // sum of what is left over, each of its body's load
constexpr Real far_more = 1e3;   // what a load costs that is not balanced: than what slips cost
constexpr Real used_up = 5e-4;   // of the loads' power: half of what the verifier allows
constexpr Real little = 1e-3;    // of the cost, from round to round
constexpr Real far = 0.05;       // likewise
constexpr Real nearby = 1e-4;    // of a factor, from try to try

std::vector<BodyVelocity> scaled_by(Real factor, std::vector<BodyVelocity> velocity) {
  for (BodyVelocity& v : velocity) {
    v.velocity = factor * v.velocity;
    v.spin = factor * v.spin;
  }
  return velocity;
}

/// Of force_scale(): the most that any contact's load could do at these slips.
Real most_work(const ScaledMass& scaled, const std::vector<BodyVelocity>& slips) {
  Real most = 0;
  for (const ForcePoint& point : scaled.points())
    most = std::max(most, scaled.load(point) * norm(scaled.jump(point, slips)));
  return most;
}

std::vector<BodyVelocity> difference(std::vector<BodyVelocity> a,
                                     const std::vector<BodyVelocity>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    a[k].velocity = a[k].velocity - b[k].velocity;
    a[k].spin = a[k].spin - b[k].spin;
  }
  return a;
}

bool overlaps(const ScaledMass& scaled, const std::vector<BodyVelocity>& slips) {
  constexpr Real allowed = 1e-6;  // of the largest jump: what the verifier does
  return std::any_of(scaled.points().begin(), scaled.points().end(), [&](const ForcePoint& point) {
    return dot(scaled.jump(point, slips), scaled.contact(point).normal) < -allowed;
  });
}

}  // namespace

std::optional<Balance> find_collapse_forces(const RigidMass& mass, const Mechanism& mechanism,
                                            const BalanceBasis& start) {
  const ScaledMass scaled(mass);
  if (!(mechanism.factor >= least_of_all) || scaled.power(mechanism.velocity) <= 0 ||
      overlaps(scaled, mechanism.velocity))
    return std::nullopt;
  Real factor = mechanism.factor;
  const bool near_by = start.near_by(1 / factor);
  ContactColumns columns = near_by ? ContactColumns(scaled, start.columns) : ContactColumns(scaled);
  LinearSolution solution = start.solution;
  const LinearSolution* before = near_by ? &solution : nullptr;
  // So fast that the loads' power is 1: costs of small blocks are not lost beside what CLP tolerates.
  const std::vector<BodyVelocity> slips =
      scaled_by(scaled.force_scale() / scaled.power(mechanism.velocity), mechanism.velocity);
  const Real unbalanced = far_more * std::max(1.0, most_work(scaled, slips));
  Real at_their_most = 0;  // power of ties that lengthen
  for (const BoltTie& tie : mass.ties)
    at_their_most += std::max(0.0, scaled.lengthening(tie, slips)) * (tie.most - tie.least) /
                     scaled.force_scale();
  columns.round_off(1 / factor, slips, gap);
  for (Index n = 0; n < most_tries; ++n) {
    Real left = 0, unused = 0, cost = 0;
    for (Index round = 0; round < most_rounds; ++round) {
      LinearProgram program = columns.program(1 / factor, ContactColumns::Units::own);
      columns.price(program, 1 / factor, slips, unbalanced);
      solution = before ? solve(program, before) : columns.solve_anew(program);
      before = &solution;
      left = columns.imbalance(solution);
      unused = solution.cost - unbalanced * left + at_their_most;
      if (left <= balanced && unused <= used_up)
        return Balance{factor, columns.forces(1 / factor, solution), columns.tensions(solution)};
      const std::vector<BodyVelocity> dual = difference(slips, scaled.velocities(solution.price));
      const bool idle = round > 0 && solution.cost > (1 - little) * cost;
      cost = solution.cost;
      if (idle || columns.round_off(1 / factor, dual, gap, &slips) == 0) break;
    }
    // Far from a balance or from their strength, they are of no state of collapse.
    if (left > far || (left <= balanced && unused > far)) break;
    factor *= left <= balanced ? 1 + unused : 1 - nearby;
  }
  return std::nullopt;
}

}  // namespace rockfold
