// In which runs of a sweep events happen, and how likely they are.
#pragma once

#include <string>
#include <vector>

#include "src/sweep/sweep_table.hpp"

namespace rockfold::sweep {

/// [rows] As it is counted: 1 it happened, 0 it did not, −1 not counted: the run is not done, or is left out for a null.
std::vector<int> happened(const SweepTable& table, const Event& event);

/// Of all runs that are done.
struct EventCount {
  Chance chance;        ///< count: the runs that are counted
  Index null_runs = 0;  ///< done runs in which no number decides it; they count as Event::null says
  bool told = true;  ///< false: a result that it compares is in no document; no run is counted then
};
EventCount count_event(const SweepTable& table, const Event& event);

/// "68 of 200 runs have no number there: counted as not happened"; "" where there is nothing to say.
std::string null_note(const SweepTable& table, const Event& event);

}  // namespace rockfold::sweep
