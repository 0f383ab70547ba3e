#include "host/stability/part_of_mass.hpp"

#include <array>
#include <map>
#include <set>

namespace rockfold {

Mechanism PartOfMass::of_whole(const Mechanism& own, std::size_t bodies) const {
  Mechanism mechanism{own.factor, std::vector<BodyVelocity>(bodies)};
  for (std::size_t b = 0; b < body.size(); ++b) mechanism.velocity[body[b]] = own.velocity[b];
  return mechanism;
}

PartsOfMass::PartsOfMass(const RigidMass& whole)
    : whole_(whole), contacts_(whole.bodies.size()), ties_(whole.bodies.size()) {
  const auto note = [](std::vector<std::vector<Index>>& of_body, const std::array<Index, 2>& body,
                       std::size_t number) {
    for (const Index b : body)
      if (b != none) of_body[b].push_back(static_cast<Index>(number));
  };
  for (std::size_t c = 0; c < whole.contacts.size(); ++c)
    note(contacts_, whole.contacts[c].body, c);
  for (std::size_t t = 0; t < whole.ties.size(); ++t) note(ties_, whole.ties[t].body, t);
}

PartOfMass PartsOfMass::part(std::vector<Index> bodies) const {
  PartOfMass part;
  part.body = std::move(bodies);
  std::map<Index, Index> number{{none, none}};
  std::set<Index> contacts, ties;
  for (const Index b : part.body) {
    number[b] = static_cast<Index>(part.mass.bodies.size());
    part.mass.bodies.push_back(whole_.bodies[b]);
    contacts.insert(contacts_[b].begin(), contacts_[b].end());
    ties.insert(ties_[b].begin(), ties_[b].end());
  }
  const auto take = [&](const std::set<Index>& which, const auto& from, auto& to) {
    for (const Index k : which) {
      to.push_back(from[k]);
      for (Index& b : to.back().body) {
        const auto found = number.find(b);
        b = found == number.end() ? none : found->second;
      }
    }
  };
  take(contacts, whole_.contacts, part.mass.contacts);
  take(ties, whole_.ties, part.mass.ties);
  return part;
}

}  // namespace rockfold
