// Forces that are at their strength on the slips of a mechanism: what makes a state of collapse of it.
#pragma once

#include <optional>

#include "host/stability/certificate.hpp"
#include "host/stability/contact_columns.hpp"

namespace rockfold {

/// Forces that balance the mass at a factor near `mechanism.factor`, and of all those the ones whose strength the slips use up most
/// nearly: a linear programme, looked for from `start` on where that is near by. None where the mass does not balance there.
std::optional<Balance> find_collapse_forces(const RigidMass& mass, const Mechanism& mechanism,
                                            const BalanceBasis& start = {});

}  // namespace rockfold
