#include "src/run/records/bolt_record.hpp"

#include <algorithm>
#include <cmath>

#include "host/bolting/bolt_elements.hpp"
#include "src/base/vector.hpp"

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

/// Of what the steel bears, on the ellipse of its law.
Real mobilisation(const BoltForces& forces, const BoltLaw& law, const Range& of) {
  Real most = 0;
  for (Index p = of.steel; p < of.steel + of.steels; ++p) {
    const Real along = std::max(forces.axial[p], Real{0}) / law.strength;
    const Real across = law.shear_strength > 0 ? forces.shear[p] / law.shear_strength : 0;
    most = std::max(most, std::hypot(along, across));
  }
  return most;
}

}  // namespace

void BoltRecord::look(const Motion& motion) {
  const BoltForces forces = motion.bolt_forces();
  const BoltArrays& all = bolts_.arrays;
  peak_.resize(all.count());
  broken_at_.resize(all.count());
  for (Index b = 0; b < all.count(); ++b) {
    const Range of = range_of(all, b);
    peak_[b] = std::max(peak_[b], largest(forces.axial, of));
    if (!broken_at_[b] && status_of(forces, of) == BoltStatus::broken)
      broken_at_[b] = motion.time();
  }
}

std::vector<BoltResult> BoltRecord::at_end(const Motion& motion) const {
  const BoltForces forces = motion.bolt_forces();
  const BoltArrays& all = bolts_.arrays;
  std::vector<BoltResult> results;
  for (Index b = 0; b < all.count(); ++b) {
    const Bolt& bolt = bolts_.drilled.bolts[b];
    const Range of = range_of(all, b);
    BoltResult result;
    result.name = bolts_.drilled.groups[bolt.group].name;
    result.number = bolt.number;
    result.collar = bolt.collar;
    result.toe = bolt.collar + bolt.length * bolt.direction;
    result.installed = forces.installed[b] != 0;
    result.status = status_of(forces, of);
    result.force = largest(forces.axial, of);
    result.shear = largest(forces.shear, of);
    result.plate = forces.plate[b];
    result.peak = b < std::ssize(peak_) ? peak_[b] : result.force;
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

}  // namespace rockfold
