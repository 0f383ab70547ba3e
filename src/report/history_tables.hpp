// Histories as comma-separated values.
#pragma once

#include <string>
#include <vector>

#include "src/io/history.hpp"

namespace rockfold {

/// A line for each monitor and time: its name, its joint if it watches one, then the quantities of points and of joints; what a
/// monitor does not have is empty.
std::string monitors_table(const std::vector<History>& monitors);

/// A line for each time: energies, then what contact took, where blocks touch.
std::string energy_table(const History& energy, const History& contacts);

}  // namespace rockfold
