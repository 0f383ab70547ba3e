#include "host/stability/certificate_form.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr std::size_t fewest_corners = 3;

bool is_finite(const Vec3& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

bool is_strength(Real x) {
  return std::isfinite(x) && x >= 0;
}

bool is_body(const RigidMass& mass, Index body) {
  return body >= 0 && body < static_cast<Index>(mass.bodies.size());
}

std::string lack_of_body(const RigidBody6& body) {
  if (body.block < 0) return "names no block";
  if (!is_finite(body.centre)) return "its centre is not finite";
  if (!is_finite(body.force) || !is_finite(body.moment)) return "its load is not finite";
  return "";
}

std::string lack_of_bodies(const RigidMass& mass) {
  std::set<Index> blocks;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const std::string name = body_text(mass, static_cast<Index>(b));
    if (std::string lack = lack_of_body(mass.bodies[b]); !lack.empty())
      return fmt::format("{}: {}", name, lack);
    if (!blocks.insert(mass.bodies[b].block).second) return name + ": is there twice";
  }
  return "";
}

std::string lack_of_contact(const RigidMass& mass, const ContactArea& area) {
  for (const Index body : area.body)
    if (body != none && !is_body(mass, body))
      return fmt::format("body {} of {} is not there", static_cast<long>(body) + 1,
                         mass.bodies.size());
  if (area.body[0] == area.body[1])
    return area.body[0] == none ? "touches no body" : "a body touches itself";
  if (area.corner.size() < fewest_corners)
    return fmt::format("has {} corners, three are the fewest", area.corner.size());
  if (!is_finite(area.normal)) return "its normal is not finite";
  if (!std::all_of(area.corner.begin(), area.corner.end(), is_finite))
    return "a corner is not finite";
  if (!is_strength(area.friction)) return "its friction is no number from 0 up";
  if (!is_strength(area.cohesion)) return "its cohesion is no number from 0 up";
  if (!is_strength(area.tension)) return "its tensile strength is no number from 0 up";
  return "";
}

std::string lack_of_contacts(const RigidMass& mass) {
  for (std::size_t c = 0; c < mass.contacts.size(); ++c)
    if (std::string lack = lack_of_contact(mass, mass.contacts[c]); !lack.empty())
      return contact_text(mass, static_cast<Index>(c)) + ": " + lack;
  return "";
}

std::string lack_of_tie(const RigidMass& mass, const BoltTie& tie) {
  constexpr Real unit = 1e-9;  // of an axis' length
  for (const Index body : tie.body)
    if (body != none && !is_body(mass, body))
      return fmt::format("body {} of {} is not there", static_cast<long>(body) + 1,
                         mass.bodies.size());
  if (tie.body[0] == tie.body[1])
    return tie.body[0] == none ? "holds no body" : "holds a body on itself";
  if (!is_finite(tie.at)) return "its place is not finite";
  if (!is_finite(tie.axis) ||
      std::abs(std::hypot(tie.axis[0], tie.axis[1], tie.axis[2]) - 1) > unit)
    return "its axis has not the length 1";
  if (!is_strength(tie.least) || !is_strength(tie.most) || tie.least > tie.most)
    return "its tensions are no numbers from 0 up, the least first";
  return "";
}

std::string lack_of_ties(const RigidMass& mass) {
  for (std::size_t t = 0; t < mass.ties.size(); ++t)
    if (std::string lack = lack_of_tie(mass, mass.ties[t]); !lack.empty())
      return tie_text(mass, static_cast<Index>(t)) + ": " + lack;
  return "";
}

std::string lack_of_factor(Real factor) {
  return std::isfinite(factor) && factor > 0
             ? ""
             : fmt::format("its factor, {}, is no number above 0", factor);
}

std::string lack_of_balance(const RigidMass& mass, const Balance& balance) {
  if (std::string lack = lack_of_factor(balance.factor); !lack.empty()) return lack;
  std::size_t points = 0;
  for (const ContactArea& area : mass.contacts)
    points += (is_strong(area) ? 2 : 1) * area.corner.size();
  if (balance.force.size() != points)
    return fmt::format("has {} forces for the {} points of its areas", balance.force.size(),
                       points);
  for (std::size_t i = 0; i < points; ++i)
    if (!is_finite(balance.force[i])) return fmt::format("force {} is not finite", i + 1);
  if (balance.tension.size() != mass.ties.size())
    return fmt::format("has {} tensions for {} bolts", balance.tension.size(), mass.ties.size());
  for (std::size_t t = 0; t < balance.tension.size(); ++t)
    if (!std::isfinite(balance.tension[t])) return fmt::format("tension {} is not finite", t + 1);
  return "";
}

std::string lack_of_mechanism(const RigidMass& mass, const Mechanism& mechanism) {
  if (std::string lack = lack_of_factor(mechanism.factor); !lack.empty()) return lack;
  if (mechanism.velocity.size() != mass.bodies.size())
    return fmt::format("has {} velocities for {} bodies", mechanism.velocity.size(),
                       mass.bodies.size());
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    if (!is_finite(mechanism.velocity[b].velocity) || !is_finite(mechanism.velocity[b].spin))
      return body_text(mass, static_cast<Index>(b)) + ": its velocity is not finite";
  return "";
}

}  // namespace

std::string body_text(const RigidMass& mass, Index body) {
  const Index block = mass.bodies[body].block;
  return block < 0 ? fmt::format("body {}", static_cast<long>(body) + 1)
                   : fmt::format("block {}", static_cast<long>(block) + 1);
}

std::string contact_text(const RigidMass& mass, Index contact) {
  const std::string& joint = mass.contacts[contact].joint;
  return fmt::format("contact {}{}", static_cast<long>(contact) + 1,
                     joint.empty() ? "" : " (" + joint + ")");
}

std::string tie_text(const RigidMass& mass, Index tie) {
  const std::string& bolt = mass.ties[tie].bolt;
  return fmt::format("tie {}{}", static_cast<long>(tie) + 1, bolt.empty() ? "" : " (" + bolt + ")");
}

std::string lack_of_form(const Certificate& certificate) {
  const RigidMass& mass = certificate.mass;
  if (std::string lack = lack_of_bodies(mass); !lack.empty()) return lack;
  if (std::string lack = lack_of_contacts(mass); !lack.empty()) return lack;
  if (std::string lack = lack_of_ties(mass); !lack.empty()) return lack;
  if (std::string lack = lack_of_balance(mass, certificate.below); !lack.empty())
    return "bound from below: " + lack;
  if (!certificate.above.velocity.empty())
    if (std::string lack = lack_of_mechanism(mass, certificate.above); !lack.empty())
      return "bound from above: " + lack;
  if (certificate.sliding_mechanism.velocity.empty()) return "";
  std::string lack = lack_of_balance(mass, certificate.sliding_balance);
  if (lack.empty()) lack = lack_of_mechanism(mass, certificate.sliding_mechanism);
  return lack.empty() ? "" : "sliding: " + lack;
}

}  // namespace rockfold
