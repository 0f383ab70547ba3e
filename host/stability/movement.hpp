// How the blocks of a mechanism move, block by block: what engineers read of it.
#pragma once

#include <string>
#include <vector>

#include "host/stability/certificate.hpp"

namespace rockfold {

struct MovingBlock {
  Index body = none;  ///< into RigidMass::bodies
  Vec3 velocity{};    ///< of its centre; the fastest point of the mass moves with 1 m/s
  Vec3 spin{};        ///< rad/s
  /// Joints that pass force and on which it slips, and those that open; sorted.
  std::vector<std::string> slides_on, parts_from;
  /// Bodies that press on it and drive it: the power of their forces is more than a hundredth of its loads' and theirs; sorted.
  std::vector<Index> pushed_by;
  std::vector<Index> moves_with;  ///< bodies that pass force to it and go as it goes; sorted
  bool turns = false;  ///< its spin moves its own points by more than a hundredth of its velocity
  bool falls = false;  ///< its centre goes where its loads pull it
};

/// By mass times speed, the largest first. `balance` may be empty: then nothing presses.
std::vector<MovingBlock> moving_blocks(const RigidMass& mass, const Mechanism& mechanism,
                                       const Balance& balance);

}  // namespace rockfold
