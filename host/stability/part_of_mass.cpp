#include "host/stability/part_of_mass.hpp"

#include <algorithm>
#include <map>

namespace rockfold {

Mechanism PartOfMass::of_whole(const Mechanism& own, std::size_t bodies) const {
  Mechanism mechanism{own.factor, std::vector<BodyVelocity>(bodies)};
  for (std::size_t b = 0; b < body.size(); ++b) mechanism.velocity[body[b]] = own.velocity[b];
  return mechanism;
}

PartsOfMass::PartsOfMass(const RigidMass& whole) : whole_(whole), contacts_(whole.bodies.size()) {
  for (std::size_t c = 0; c < whole.contacts.size(); ++c)
    for (const Index b : whole.contacts[c].body)
      if (b != none) contacts_[b].push_back(static_cast<Index>(c));
}

PartOfMass PartsOfMass::part(std::vector<Index> bodies) const {
  PartOfMass part;
  part.body = std::move(bodies);
  std::map<Index, Index> number{{none, none}};
  for (const Index b : part.body) {
    number[b] = static_cast<Index>(part.mass.bodies.size());
    part.mass.bodies.push_back(whole_.bodies[b]);
    part.contact.insert(part.contact.end(), contacts_[b].begin(), contacts_[b].end());
  }
  std::sort(part.contact.begin(), part.contact.end());
  part.contact.erase(std::unique(part.contact.begin(), part.contact.end()), part.contact.end());
  for (const Index c : part.contact) {
    part.mass.contacts.push_back(whole_.contacts[c]);
    for (Index& b : part.mass.contacts.back().body) {
      const auto found = number.find(b);
      b = found == number.end() ? none : found->second;
    }
  }
  return part;
}

}  // namespace rockfold
