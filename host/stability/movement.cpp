#include "host/stability/movement.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real at_rest = 1e-5;  // of the fastest: what a mechanism of this precision tells apart
constexpr Real counts = 0.01;   // of a motion or a power: less is not told

/// What is known of one body from its points.
struct Seen {
  bool moves = false;
  Real reach = 0;    ///< m
  Real largest = 0;  ///< N, of the forces on it
  std::set<std::string> slides, parts;
  std::map<Index, bool> with;        ///< bodies that press on it: whether they go as it goes
  std::map<Index, Real> power_from;  ///< W, of the forces of other bodies
};

class Movement {
 public:
  Movement(const RigidMass& mass, const Mechanism& mechanism, const Balance& balance)
      : mass_(mass), velocity_(mechanism.velocity), seen_(mass.bodies.size()) {
    const std::vector<ForcePoint> points = force_points(mass);
    for (const ForcePoint& point : points)
      for (const Index body : mass.contacts[point.contact].body)
        fastest_ = std::max(fastest_, norm(velocity_at(body, point.at)));
    for (const BodyVelocity& v : velocity_) fastest_ = std::max(fastest_, norm(v.velocity));
    for (std::size_t p = 0; p < balance.force.size(); ++p)
      for (const Index body : mass.contacts[points[p].contact].body)
        if (body != none)
          seen_[body].largest = std::max(seen_[body].largest, norm(balance.force[p]));
    for (std::size_t p = 0; p < points.size(); ++p)
      look(points[p], balance.force.empty() ? nullptr : &balance.force[p]);
  }

  std::vector<MovingBlock> blocks() const {
    std::vector<MovingBlock> moving;
    for (std::size_t b = 0; b < seen_.size(); ++b)
      if (fastest_ > 0 && (seen_[b].moves || norm(velocity_[b].velocity) > at_rest * fastest_))
        moving.push_back(moving_block(static_cast<Index>(b)));
    const auto momentum = [&](const MovingBlock& m) {
      return norm(mass_.bodies[m.body].force) * norm(m.velocity);
    };
    std::stable_sort(moving.begin(), moving.end(),
                     [&](const auto& a, const auto& b) { return momentum(a) > momentum(b); });
    return moving;
  }

 private:
  Vec3 velocity_at(Index body, const Vec3& x) const {
    if (body == none) return {};
    return velocity_[body].velocity + cross(velocity_[body].spin, x - mass_.bodies[body].centre);
  }

  /// Without a balance, what does not open is taken to press.
  void look(const ForcePoint& point, const Vec3* force) {
    const ContactArea& contact = mass_.contacts[point.contact];
    const Vec3 jump =
        velocity_at(contact.body[0], point.at) - velocity_at(contact.body[1], point.at);
    const Real slow = at_rest * fastest_, opening = dot(jump, contact.normal);
    for (int side = 0; side < 2; ++side) {
      const Index body = contact.body[side], other = contact.body[1 - side];
      if (body == none) continue;
      Seen& seen = seen_[body];
      const bool passes = force ? norm(*force) > at_rest * seen.largest : opening <= slow;
      const Vec3 own = velocity_at(body, point.at);
      seen.moves = seen.moves || norm(own) > slow;
      seen.reach = std::max(seen.reach, norm(point.at - mass_.bodies[body].centre));
      if (passes && norm(jump) > slow) seen.slides.insert(contact.joint);
      if (opening > slow) seen.parts.insert(contact.joint);
      if (other == none || !passes) continue;
      if (force) seen.power_from[other] += dot(side == 0 ? *force : -*force, own);
      const auto [with, is_new] = seen.with.try_emplace(other, true);
      with->second = with->second && norm(jump) <= slow;
    }
  }

  MovingBlock moving_block(Index b) const {
    const Seen& seen = seen_[b];
    const BodyVelocity& v = velocity_[b];
    MovingBlock block{b,
                      (1 / fastest_) * v.velocity,
                      (1 / fastest_) * v.spin,
                      {seen.slides.begin(), seen.slides.end()},
                      {seen.parts.begin(), seen.parts.end()},
                      {},
                      {},
                      norm(v.spin) * seen.reach > counts * norm(v.velocity)};
    const RigidBody6& body = mass_.bodies[b];
    Real driven = std::max(0.0, dot(body.force, v.velocity) + dot(body.moment, v.spin));
    for (const auto& [other, power] : seen.power_from) driven += std::max(0.0, power);
    for (const auto& [other, power] : seen.power_from)
      if (power > counts * driven) block.pushed_by.push_back(other);
    for (const auto& [other, goes] : seen.with)
      if (goes) block.moves_with.push_back(other);
    block.falls = dot(v.velocity, body.force) > (1 - counts) * norm(v.velocity) * norm(body.force);
    return block;
  }

  const RigidMass& mass_;
  const std::vector<BodyVelocity>& velocity_;
  std::vector<Seen> seen_;
  Real fastest_ = 0;
};

}  // namespace

std::vector<MovingBlock> moving_blocks(const RigidMass& mass, const Mechanism& mechanism,
                                       const Balance& balance) {
  if (mechanism.velocity.empty()) return {};
  return Movement(mass, mechanism, balance).blocks();
}

}  // namespace rockfold
