// What a command prints on stdout: a JSON document or a summary for people. And small services of
// the pipeline.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/cut/cut.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/theory/theory.hpp"
#include "host/measure/measure.hpp"
#include "host/shapes/extents.hpp"
#include "src/app/command_line.hpp"
#include "src/app/estimate.hpp"
#include "src/app/support_design.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/base/error.hpp"
#include "src/io/result_file.hpp"
#include "src/page/write_page.hpp"
#include "src/printed/printed_report.hpp"
#include "src/report/documents/documents.hpp"
#include "src/report/phase_seconds.hpp"
#include "src/report/terminal.hpp"
#include "src/run/reduction.hpp"

namespace rockfold {

/// All that a command made; null where it made none.
struct Answer {
  const Options& options;
  const Model& model;
  const CutTotals& totals;
  const BlockArrays& blocks;
  const RockMeasures* measures;
  const KeyblockReport* keyblocks;
  const SupportDesign* design;       ///< with the key blocks
  const StabilityReport* stability;  ///< of the whole mass
  const CoverArrays* covers;
  const RunResult* run;
  const Reduction* reduction;       ///< of the run
  std::string path;                 ///< of the result file
  std::vector<std::string> unused;  ///< keys of the model that the command does not use
  std::optional<Error> limit;       ///< that ended the run before its end
};

/// What the result file keeps of the answer: its document without the list of blocks, and what pages and reports tell beside it.
std::string stored_answer(const Answer& answer, const std::vector<std::string>& warnings);

/// The whole document of a run, as it would be printed, without seconds.
std::string whole_answer(const Answer& answer, const Terminal& terminal);
/// A document, or the summary of the same.
void print_made(const Options& options, const std::vector<std::string>& warnings,
                const Json& document, const std::string& summary);
/// The document of a run that was finished before, from its result.
void print_finished(const Options& options, const std::string& document);

PageChoice page_choice(const Options& options);
void print_page(const Options& options, const std::string& path, const PageFacts& facts);

void print_report(const Options& options, const std::string& path, const PrintedFacts& facts);

/// What there is of a run that a limit ended, then the error: on stderr, or as "error" of the document.
void print_answer(const Answer& answer, Terminal& terminal, const PhaseSeconds& seconds);
/// What a search for a reduction that did not come to its end knows; `limit` as of an answer.
void print_search(const Options& options, const Model& model, const Reduction& reduction,
                  const std::optional<Error>& limit, Terminal& terminal);
void print_theory(const Options& options, const Model& model, const TheoryReport& report,
                  Terminal& terminal, const PhaseSeconds& seconds);
/// `estimate`: null where it was not asked for.
void print_check(const Options& options, const Model& model,
                 const std::vector<NamedExtent>& extents, const Estimate* estimate,
                 Terminal& terminal);
void print_info(const Options& options, const ResultInfo& info);

/// Lists the examples, or writes the one that is named.
int hand_out_examples(const Options& options);

ResultHeader result_header(const Options& options);

/// Finishes the file of an analysis that failed, or whose results could not be written, if it holds any state, and says so.
void keep_states(ResultWriter& writer, ErrorKind why, Terminal& terminal);

/// contact, assemble, solve and output.
void add_run_seconds(PhaseClock& clock, const RunResult& run);

}  // namespace rockfold
