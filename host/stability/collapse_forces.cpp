#include "host/stability/collapse_forces.hpp"

#include <algorithm>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real least_of_all =
    1e-3;  // strength a thousand times what there is balances nothing more
constexpr Index most_rounds = 20, most_tries = 12;
constexpr Real gap = 1e-4;        // of the largest jump: what a rounder cone could save
constexpr Real balanced = 1e-9;   // sum of what is left over, each of its body's load
constexpr Real unbalanced = 1e3;  // costs more than any slip, which are 1 at most
constexpr Real used_up = 5e-4;    // of the loads' power: half of what the verifier allows
constexpr Real little = 1e-3;     // of the cost, from round to round
constexpr Real far = 0.05;        // likewise
constexpr Real nearby = 1e-4;     // of a factor, from try to try

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
  const std::vector<BodyVelocity>& slips = mechanism.velocity;
  const Real power = scaled.power(slips) / scaled.force_scale();
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
      if (left <= balanced && unused <= used_up * power)
        return Balance{factor, columns.forces(1 / factor, solution), columns.tensions(solution)};
      const std::vector<BodyVelocity> dual = difference(slips, scaled.velocities(solution.price));
      const bool idle = round > 0 && solution.cost > (1 - little) * cost;
      cost = solution.cost;
      if (idle || columns.round_off(1 / factor, dual, gap, &slips) == 0) break;
    }
    // Far from a balance or from their strength, they are of no state of collapse.
    if (left > far || (left <= balanced && unused > far * power)) break;
    factor *= left <= balanced ? 1 + unused / power : 1 - nearby;
  }
  return std::nullopt;
}

}  // namespace rockfold
