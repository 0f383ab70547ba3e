#include "host/stability/mass_scale.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

std::array<Vec3, 2> tangents_across(const Vec3& normal, const Vec3& load) {
  Vec3 slope = load - dot(load, normal) * normal;
  constexpr Real level = 1e-6;  // then any direction is as steep as another
  if (norm(slope) <= level * norm(load) || norm(load) == 0) {
    Vec3 axis{};
    std::size_t least = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (std::abs(normal[d]) < std::abs(normal[least])) least = d;
    axis[least] = 1;
    slope = axis - dot(axis, normal) * normal;
  }
  const Vec3 first = normalized(slope);
  return {first, cross(normal, first)};
}

}  // namespace

ScaledMass::ScaledMass(const RigidMass& mass)
    : mass_(mass), points_(force_points(mass)), size_(mass.bodies.size(), 0) {
  Vec3 load{};
  Real sum = 0;
  for (const RigidBody6& body : mass.bodies) {
    load += body.force;
    sum += norm(body.force);
  }
  if (sum > 0) force_ = sum / static_cast<Real>(mass.bodies.size());
  for (const ContactArea& contact : mass.contacts) {
    tangents_.push_back(tangents_across(contact.normal, load));
    for (const Index b : contact.body)
      if (b != none)
        for (const Vec3& x : contact.corner)
          size_[b] = std::max(size_[b], norm(x - mass.bodies[b].centre));
  }
  for (Real& s : size_)
    if (s == 0) s = 1;               // it touches nothing
  constexpr Real least_load = 1e-6;  // of a mean one
  for (const RigidBody6& body : mass.bodies)
    load_.push_back(std::max(least_load, norm(body.force) / force_));
}

Real ScaledMass::load(const std::array<Index, 2>& body) const {
  const auto& [a, b] = body;
  if (a == none || b == none) return load(a == none ? b : a);
  return std::min(load(a), load(b));
}

std::vector<Real> ScaledMass::right_side() const {
  std::vector<Real> right;
  for (std::size_t b = 0; b < mass_.bodies.size(); ++b)
    for (const Vec3& part : {(-1 / force_) * mass_.bodies[b].force,
                             (-1 / (force_ * size_[b])) * mass_.bodies[b].moment})
      right.insert(right.end(), part.begin(), part.end());
  return right;
}

void ScaledMass::add_pull(LinearProgram& program, Index body, const Vec3& at,
                          const Vec3& force) const {
  if (body == none) return;
  const Vec3 moment = (1 / size_[body]) * cross(at - mass_.bodies[body].centre, force);
  for (Index d = 0; d < 3; ++d) {
    if (force[d] != 0) program.add_entry(6 * body + d, force[d]);
    if (moment[d] != 0) program.add_entry(6 * body + 3 + d, moment[d]);
  }
}

void ScaledMass::add_force(LinearProgram& program, const ForcePoint& point,
                           const Vec3& force) const {
  const ContactArea& area = contact(point);
  add_pull(program, area.body[0], point.at, force);
  add_pull(program, area.body[1], point.at, -force);
}

void ScaledMass::add_tension(LinearProgram& program, const BoltTie& tie) const {
  add_pull(program, tie.body[0], tie.at, tie.axis);
  add_pull(program, tie.body[1], tie.at, -tie.axis);
}

std::vector<BodyVelocity> ScaledMass::velocities(const std::vector<Real>& price) const {
  std::vector<BodyVelocity> velocity(mass_.bodies.size());
  for (std::size_t b = 0; b < velocity.size(); ++b)
    for (std::size_t d = 0; d < 3; ++d) {
      velocity[b].velocity[d] = price[6 * b + d];
      velocity[b].spin[d] = price[6 * b + 3 + d] / size_[b];
    }
  return velocity;
}

Vec3 ScaledMass::apart(const std::array<Index, 2>& body, const Vec3& at,
                       const std::vector<BodyVelocity>& velocity) const {
  Vec3 jump{};
  for (std::size_t side = 0; side < 2; ++side) {
    const Index b = body[side];
    if (b == none) continue;
    const Vec3 own = velocity[b].velocity + cross(velocity[b].spin, at - mass_.bodies[b].centre);
    jump += side == 0 ? own : -own;
  }
  return jump;
}

Vec3 ScaledMass::jump(const ForcePoint& point, const std::vector<BodyVelocity>& velocity) const {
  return apart(contact(point).body, point.at, velocity);
}

Real ScaledMass::lengthening(const BoltTie& tie, const std::vector<BodyVelocity>& velocity) const {
  return -dot(apart(tie.body, tie.at, velocity), tie.axis);
}

Real ScaledMass::slip(const ForcePoint& point, const Vec3& jump) const {
  const auto& t = tangents(point);
  return std::hypot(dot(jump, t[0]), dot(jump, t[1]));
}

Real ScaledMass::power(const std::vector<BodyVelocity>& velocity) const {
  Real sum = 0;
  for (std::size_t b = 0; b < velocity.size(); ++b)
    sum += dot(mass_.bodies[b].force, velocity[b].velocity) +
           dot(mass_.bodies[b].moment, velocity[b].spin);
  return sum;
}

}  // namespace rockfold
