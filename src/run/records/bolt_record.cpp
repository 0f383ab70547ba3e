#include "src/run/records/bolt_record.hpp"

#include <algorithm>
#include <cmath>

#include "host/bolting/bolt_elements.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

/// Nodes and pieces of steel of a bolt.
struct Range {
  Index node, nodes, steel, steels;
};
Range range_of(const BoltArrays& all, Index b) {
  const Index node = all.node_begin[b], nodes = all.node_begin[b + 1] - node;
  return {node, nodes, node - b, nodes - 1};
}

Real largest(const std::vector<Real>& values, const Range& of) {
  const auto begin = values.begin() + of.steel;
  return std::max(Real{0}, *std::max_element(begin, begin + of.steels));
}

BoltStatus status_of(const BoltForces& forces, const Range& of) {
  const auto steel = forces.steel.begin() + of.steel;
  const auto has = [&](BoltStatus s) {
    return std::find(steel, steel + of.steels, s) != steel + of.steels;
  };
  if (has(BoltStatus::broken)) return BoltStatus::broken;
  if (has(BoltStatus::yields)) return BoltStatus::yields;
  const auto bond = forces.bond.begin() + of.node;
  const bool slides = std::find(bond, bond + of.nodes, BoltStatus::slides) != bond + of.nodes;
  return slides ? BoltStatus::slides : BoltStatus::elastic;
}

/// Of what a piece of steel bears, on the ellipse of its law.
Real mobilisation(const BoltForces& forces, const BoltLaw& law, Index piece) {
  const Real along = std::max(forces.axial[piece], Real{0}) / law.strength;
  const Real across = law.shear_strength > 0 ? forces.shear[piece] / law.shear_strength : 0;
  return std::hypot(along, across);
}

Real mobilisation(const BoltForces& forces, const BoltLaw& law, const Range& of) {
  Real most = 0;
  for (Index p = of.steel; p < of.steel + of.steels; ++p)
    most = std::max(most, mobilisation(forces, law, p));
  return most;
}

/// [M] m: nodes move with the rock between the points of their links, and slip along it.
std::vector<Vec3> steel_displacement(const BoltElements& bolts, const BoltForces& forces,
                                     const std::vector<Vec3>& displacement) {
  const BoltArrays& all = bolts.arrays;
  std::vector<Vec3> moved;
  for (Index b = 0; b < bolts.bolts(); ++b) {
    const Vec3& along = all.direction[b];
    Index node = all.node_begin[b];
    const auto add = [&](const Vec3& u) { moved.push_back(u + forces.slip[node++] * along); };
    Index point = all.point_begin[b];
    Vec3 before = interpolate(all.points, point, displacement);
    add(before);
    for (; point + 1 < all.point_begin[b + 1]; ++point) {
      const Vec3 after = interpolate(all.points, point + 1, displacement);
      const Index link = point - b, pieces = all.steel_begin[link + 1] - all.steel_begin[link];
      for (Index k = 1; k <= pieces; ++k)
        add(before + (static_cast<Real>(k) / static_cast<Real>(pieces)) * (after - before));
      before = after;
    }
  }
  return moved;
}

}  // namespace

void BoltRecord::look(const Motion& motion) {
  const BoltForces forces = motion.bolt_forces();
  const BoltArrays& all = bolts_.arrays;
  broken_at_.resize(bolts_.bolts());
  for (Index b = 0; b < bolts_.bolts(); ++b) {
    const Range of = range_of(all, b);
    if (!broken_at_[b] && status_of(forces, of) == BoltStatus::broken)
      broken_at_[b] = motion.time();
  }
}

std::vector<BoltResult> BoltRecord::at_end(const Motion& motion) const {
  const BoltForces forces = motion.bolt_forces();
  const BoltArrays& all = bolts_.arrays;
  std::vector<BoltResult> results;
  for (Index b = 0; b < bolts_.bolts(); ++b) {
    const Bolt& bolt = bolts_.drilled.bolts[b];
    const Range of = range_of(all, b);
    BoltResult result;
    const BoltGroup& group = bolts_.drilled.groups[bolt.group];
    result.name = group.is_pattern ? group.name + "." + std::to_string(bolt.number) : group.name;
    result.collar = bolt.collar;
    result.direction = bolt.direction;
    result.length = bolt.length;
    result.installed = forces.installed[b] != 0;
    result.status = status_of(forces, of);
    result.force = largest(forces.axial, of);
    result.shear = largest(forces.shear, of);
    result.plate = forces.plate[b];
    result.peak = forces.peak[b];
    result.mobilisation = mobilisation(forces, all.law[b], of);
    if (b < std::ssize(broken_at_)) result.broken_at = broken_at_[b];
    for (Index i = 0; i < of.steels; ++i) {
      const Index near = of.node + i;
      result.at.push_back(0.5 * (all.node_place[near] + all.node_place[near + 1]));
      result.along.push_back(forces.axial[of.steel + i]);
    }
    results.push_back(std::move(result));
  }
  return results;
}

BoltLineState BoltRecord::lines(const Motion& motion, const std::vector<Vec3>& displacement) const {
  const BoltForces forces = motion.bolt_forces();
  BoltLineState state;
  state.displacement = steel_displacement(bolts_, forces, displacement);
  for (Index b = 0; b < bolts_.bolts(); ++b) {
    const Range of = range_of(bolts_.arrays, b);
    for (Index p = of.steel; p < of.steel + of.steels; ++p) {
      state.force.push_back(forces.axial[p]);
      state.mobilisation.push_back(mobilisation(forces, bolts_.arrays.law[b], p));
      state.status.push_back(forces.steel[p]);
    }
  }
  return state;
}

std::optional<ShotcreteResult> BoltRecord::shotcrete_at_end(const Motion& motion) const {
  if (bolts_.bridged.empty()) return {};
  const BoltForces forces = motion.bolt_forces();
  ShotcreteResult result;
  for (std::size_t k = 0; k < bolts_.bridged.size(); ++k) {
    const Index b = bolts_.bolts() + static_cast<Index>(k);
    const Range of = range_of(bolts_.arrays, b);
    const Real force = std::abs(forces.axial[of.steel]);
    result.length += bolts_.bridged[k];
    if (forces.steel[of.steel] == BoltStatus::broken) result.broken += bolts_.bridged[k];
    if (forces.steel[of.steel] == BoltStatus::yields) result.yielding += bolts_.bridged[k];
    result.force += force;
    result.mobilisation = std::max(result.mobilisation, force / bolts_.arrays.law[b].strength);
  }
  return result;
}

}  // namespace rockfold
