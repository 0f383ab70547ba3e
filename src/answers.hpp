// What a command prints on stdout: a JSON document or a summary for people. And small services of
// the pipeline.
#pragma once

#include <string>

#include "host/cut/cut.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/theory.hpp"
#include "host/measure/measure.hpp"
#include "host/shapes/extents.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/command_line.hpp"
#include "src/io/result_file.hpp"
#include "src/report/phase_seconds.hpp"
#include "src/report/terminal.hpp"
#include "src/run/run_result.hpp"
#include "src/support_design.hpp"

namespace rockfold {

/// All that a command made; null where it made none.
struct Answer {
  const Options& options;
  const Model& model;
  const CutTotals& totals;
  const BlockArrays& blocks;
  const RockMeasures* measures;
  const KeyblockReport* keyblocks;
  const SupportDesign* design;  ///< with the key blocks
  const CoverArrays* covers;
  const RunResult* run;
  std::string path;  ///< of the result file
};

void print_answer(const Answer& answer, Terminal& terminal, const PhaseSeconds& seconds);
void print_theory(const Options& options, const Model& model, const TheoryReport& report,
                  Terminal& terminal, const PhaseSeconds& seconds);
void print_check(const Options& options, const Model& model,
                 const std::vector<NamedExtent>& extents, Terminal& terminal);
void print_info(const Options& options, const ResultInfo& info);

/// Lists the examples, or writes the one that is named.
int hand_out_examples(const Options& options);

ResultHeader result_header(const Options& options);

/// Finishes the file of an analysis that failed, or whose results could not be written, if it holds any state, and says so.
void keep_states(ResultWriter& writer, ErrorKind why, Terminal& terminal);

/// contact, assemble, solve and output.
void add_run_seconds(PhaseClock& clock, const RunResult& run);

}  // namespace rockfold
