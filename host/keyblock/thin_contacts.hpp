// Contacts that carry a block on next to nothing: lips and needles, whose force no rock bears.
#pragma once

#include <string>
#include <vector>

#include "host/keyblock/keyblock.hpp"

namespace rockfold {

/// Below this share of the area of all joints that a block leans on, the force on one of them is told.
constexpr Real thin_contact_share = 0.02;

struct ThinContact {
  Index block = none;
  std::string joint;
  Real area = 0;          ///< m²
  Real share = 0;         ///< of the area of all joints that the block leans on
  Real normal_force = 0;  ///< N
};

/// Of blocks that slide, or would without friction: the planes that they slide on, if these have less than thin_contact_share of the
/// blocks' joint area. In the order of the key blocks, then of those that stay.
std::vector<ThinContact> thin_contacts(const KeyblockReport& report);

}  // namespace rockfold
