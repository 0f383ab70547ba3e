// What a run recorded at every step, as columns over time: for the result file and for tables.
#pragma once

#include <vector>

#include "src/io/history.hpp"
#include "src/io/result_file.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// One for each [[monitor]], in the order of the model: displacement (m), velocity (m/s), acceleration (m/s²), stress (Pa, xx yy zz xy
/// yz zx) of a point; normal_stress, shear_stress (Pa), opening, slip (m), state (0 open, 1 stick, 2 slide) of a joint.
std::vector<History> monitor_histories(const Model& model, const RunResult& run);

/// The energies (J) at t = 0 and after each step.
History energy_history(const RunResult& run);

/// Numbers of contact points in each state, Newton iterations and parts of each step; without columns where blocks do not touch.
History contact_history(const RunResult& run);

/// Stores them all.
void add_histories(ResultWriter& writer, const Model& model, const RunResult& run);

}  // namespace rockfold
