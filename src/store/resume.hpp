// Runs that go on: what a run is told to leave behind, and how `resume` finds its way back to it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "src/app/command_line.hpp"
#include "src/io/result_file.hpp"
#include "src/io/run_journal.hpp"
#include "src/model/model.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

/// What `model` was read from and what the command was told beside it.
RunOrigin run_origin(const Options& options, const Model& model);

/// A run that is started again.
struct Resumption {
  Options options;  ///< of the run, with the present --json, --threads, …
  JournalContents journal;
};

/// What is to be gone on with. `options` are those of `resume`. Nothing where the run is finished and nothing of it shall change.
/// Throws Error(io) where there is no run at all, Error(usage) where an option would change what has been computed, Error(model)
/// where the model or a file that it reads has changed since, each with what differs.
std::optional<Resumption> find_run(const Options& options);
/// Of the files that the model reads.
void require_same_inputs(const RunOrigin& origin, const Model& model);

/// The journal beside the result under way: a new one, which keeps what a `search` found before the run, or that of the run gone on with.
/// States that it still has are handed to `store` again.
std::unique_ptr<RunJournal> open_journal(const Options& options, const Model& model,
                                         const std::string& result, const Resumption* resumption,
                                         const StoreState& store,
                                         const std::vector<std::byte>& search = {});

/// Leaves checkpoints in the journal, and starts from the one gone on with.
Checkpoints checkpoints_in(RunJournal& journal, const Model& model, const Resumption* resumption);

/// What a new run to this result would throw away: an earlier one that could go on. Empty: nothing.
std::string unfinished_run(const std::string& result);

/// Of a result, or of the run under way or killed that would have made it.
ResultInfo info_of_result(const std::string& path);

}  // namespace rockfold
