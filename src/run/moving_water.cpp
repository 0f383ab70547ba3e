#include "src/run/moving_water.hpp"

#include <algorithm>

#include "host/cover/points/joint_water.hpp"
#include "src/base/vector.hpp"
#include "src/run/contact_setup.hpp"
#include "src/run/records/contact_samples.hpp"

namespace rockfold {
namespace {

/// Of the pressure, what is left in a joint that is open by so much, m.
Real share_in_gap(const Water* water, Real gap) {
  if (!water || !water->drained_at) return 1;
  return std::clamp(1 - gap / *water->drained_at, 0.0, 1.0);
}

}  // namespace

MovingWater::MovingWater(const RunInput& input) : input_(input) {
  if (!any()) return;
  laws_ = contact_options(input.model, input.blocks).laws;
  left_.assign(input.water->sides().size(), 1);
  start_ = input.water->at(0, input.covers);
}

/// Of each side, what has the joint's other side before it over what had at the start.
std::vector<Real> MovingWater::shares(const Motion& motion) {
  const auto& sides = input_.water->sides();
  std::vector<Real> area(sides.size(), 0), wet(sides.size(), 0);
  for (const ContactSample& sample :
       contact_samples(input_, laws_, motion.contact_points(), motion.state().displacement)) {
    if (sample.joint == none) continue;
    for (int k = 0; k < 2; ++k) {
      const Index side = input_.water->side_of(sample.block[k], sample.joint,
                                               (k == 0 ? -1.0 : 1.0) * sample.normal);
      if (side == none) continue;
      area[side] += sample.area;
      wet[side] += sample.area * share_in_gap(sides[side].water, sample.gap);
    }
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (area[s] > 0) left_[s] = std::min(left_[s], wet[s] / area[s]);
    area[s] = std::min(1.0, area[s] / sides[s].area) * left_[s];
  }
  return area;
}

void MovingWater::begin_step(Motion& motion, Real end, bool first) {
  if (!any()) return;
  if (!first) motion.set_water_shares(shares(motion));
  if (input_.water->changes_after(motion.time()))
    motion.set_water(input_.covers, input_.water->at(end, input_.covers));
}

std::optional<WaterInJoints> MovingWater::at_end(const Motion& motion) {
  if (!any()) return {};
  WaterInJoints water;
  const std::vector<Real> share = shares(motion);
  const LoadPoints points = input_.water->at(motion.time(), input_.covers);
  for (std::size_t n = 0; n < points.side.size(); ++n) {
    const Real force = 0.5 * points.pressure[n] * norm(points.area[n]);  // of two sides
    water.whole_force += force;
    water.force += share[points.side[n]] * force;
    if (share[points.side[n]] > 0)
      water.largest_pressure = std::max(water.largest_pressure, points.pressure[n]);
  }
  for (const JointWater::Side& side : input_.water->sides()) water.area += 0.5 * side.area;
  return water;
}

void MovingWater::restore(Motion& motion) const {
  if (any()) motion.set_water_now(input_.covers, input_.water->at(motion.time(), input_.covers));
}

}  // namespace rockfold
