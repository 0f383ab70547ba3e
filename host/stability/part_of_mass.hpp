// Some bodies of a mass, all others held.
#pragma once

#include <vector>

#include "host/stability/certificate.hpp"
#include "host/stability/rigid_mass.hpp"

namespace rockfold {

struct PartOfMass {
  std::vector<Index> body;  ///< of the whole
  RigidMass mass;

  /// Velocities of the whole mass, of so many bodies, where these alone move.
  Mechanism of_whole(const Mechanism& own, std::size_t bodies) const;
};

class PartsOfMass {
 public:
  /// `whole` must live as long.
  explicit PartsOfMass(const RigidMass& whole);

  PartOfMass part(std::vector<Index> bodies) const;

 private:
  const RigidMass& whole_;
  std::vector<std::vector<Index>> contacts_, ties_;  ///< [bodies] ascending
};

}  // namespace rockfold
