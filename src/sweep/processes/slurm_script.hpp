// A sweep as a job array of Slurm: scripts to submit, made ready to be looked at and changed.
#pragma once

#include <string>

#include "src/app/command_line.hpp"
#include "src/sweep/sweep_spec.hpp"

namespace rockfold::sweep {

/// Writes DIR/runs.sbatch (an array of `options.slurm_tasks` tasks, each with its part of the runs), DIR/gather.sbatch (the table, after
/// them) and DIR/submit.sh, which submits both. Returns the path of the last. Throws Error(io).
std::string write_slurm_scripts(const Options& options, const SweepSpec& spec,
                                const std::string& folder);

}  // namespace rockfold::sweep
