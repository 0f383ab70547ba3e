#include "host/stability/stability.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "host/stability/rock_mass.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real at_rest = 1e-5;  // of the fastest: what a mechanism of this precision tells apart

Vec3 velocity_at(const RigidMass& mass, const std::vector<BodyVelocity>& velocity, Index body,
                 const Vec3& x) {
  if (body == none) return {};
  return velocity[body].velocity + cross(velocity[body].spin, x - mass.bodies[body].centre);
}

/// How the areas of a mass move apart and pass on force, contact by contact.
class Movement {
 public:
  Movement(const RigidMass& mass, const Bound& bound) : mass_(mass), bound_(bound) {
    for (const ContactArea& contact : mass.contacts)
      for (const Vec3& x : contact.corner)
        for (const Index body : contact.body)
          fastest_ = std::max(fastest_, norm(velocity_at(mass, bound.above.velocity, body, x)));
  }

  std::vector<MovingBlock> blocks() const {
    std::vector<MovingBlock> moving;
    const std::vector<std::set<std::string>> slides = joints(true), parts = joints(false);
    for (std::size_t b = 0; b < mass_.bodies.size(); ++b) {
      const BodyVelocity& v = bound_.above.velocity[b];
      if (!(fastest_ > 0) || !moves(static_cast<Index>(b))) continue;
      moving.push_back({static_cast<Index>(b),
                        (1 / fastest_) * v.velocity,
                        (1 / fastest_) * v.spin,
                        {slides[b].begin(), slides[b].end()},
                        {parts[b].begin(), parts[b].end()}});
    }
    const auto momentum = [&](const MovingBlock& m) {
      return norm(mass_.bodies[m.body].force) * norm(m.velocity);
    };
    std::stable_sort(moving.begin(), moving.end(),
                     [&](const auto& a, const auto& b) { return momentum(a) > momentum(b); });
    return moving;
  }

 private:
  bool moves(Index body) const {
    for (const ContactArea& contact : mass_.contacts)
      if (contact.body[0] == body || contact.body[1] == body)
        for (const Vec3& x : contact.corner)
          if (norm(velocity_at(mass_, bound_.above.velocity, body, x)) > at_rest * fastest_)
            return true;
    return norm(bound_.above.velocity[body].velocity) > at_rest * fastest_;
  }

  /// [bodies] Joints whose areas slip under pressure, or part without.
  std::vector<std::set<std::string>> joints(bool pressed) const {
    std::vector<std::set<std::string>> names(mass_.bodies.size());
    Real largest = 0;
    for (const Vec3& f : bound_.below.force) largest = std::max(largest, norm(f));
    const std::vector<ForcePoint> points = force_points(mass_);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const ContactArea& contact = mass_.contacts[points[p].contact];
      const Vec3 jump = velocity_at(mass_, bound_.above.velocity, contact.body[0], points[p].at) -
                        velocity_at(mass_, bound_.above.velocity, contact.body[1], points[p].at);
      if (norm(jump) <= at_rest * fastest_) continue;
      const bool passes = !bound_.below.force.empty() &&
                          dot(bound_.below.force[p], contact.normal) > at_rest * largest;
      if (passes != pressed) continue;
      for (const Index body : contact.body)
        if (body != none) names[body].insert(contact.joint);
    }
    return names;
  }

  const RigidMass& mass_;
  const Bound& bound_;
  Real fastest_ = 0;
};

}  // namespace

StageKeys keys_of_stability() {
  return {
      "stability",
      {"gravity", "material.density", "joint_material.friction_angle", "joint_material.cohesion",
       "joint_material.tensile_strength", "support.seismic_coefficient", "support.water_pressure",
       "water", "point_load", "traction", "fixed.where", "fixed.components"}};
}

StabilityReport find_stability(const Cutting& cutting, const BlockArrays& blocks,
                               const Model& model, Progress& progress) {
  StabilityReport report;
  report.mass = rigid_mass(cutting, blocks, model);
  report.partly_held = held_blocks(blocks, model).partly_held;
  const auto count = static_cast<Index>(report.mass.bodies.size());
  if (count > most_moving_blocks)
    throw Error(
        ErrorKind::model,
        fmt::format("{} blocks may move, and limit analysis of the whole mass is for at most {}: "
                    "join blocks by [cut] min_volume or [[merge]], or hold rock that stays by "
                    "[[fixed]]",
                    count, most_moving_blocks));
  if (count == 0) {
    report.bound.factor = std::numeric_limits<Real>::infinity();
    return report;
  }
  report.bound = find_bound(report.mass, progress);
  if (!report.bound.above.velocity.empty())
    report.moving = Movement(report.mass, report.bound).blocks();
  return report;
}

}  // namespace rockfold
