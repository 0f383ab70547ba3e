// The JSON documents (docs/user_guide.md), one function each. Keys stand in the order of the contract; a
// number that is not finite is written as null; everything but "seconds" is the same whatever the
// thread count.
#pragma once

#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "host/cut/cut.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/theory/theory.hpp"
#include "host/measure/measure.hpp"
#include "host/shapes/extents.hpp"
#include "host/stability/stability.hpp"
#include "src/app/support_design.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/base/error.hpp"
#include "src/io/result_file.hpp"
#include "src/model/model.hpp"
#include "src/report/phase_seconds.hpp"
#include "src/run/reduction.hpp"

namespace rockfold {

using Json = nlohmann::ordered_json;

/// All that a run made.
struct RunReport {
  const Model& model;
  const BlockArrays& blocks;
  const CoverArrays& covers;
  const RunResult& run;
  const KeyblockReport* keyblocks = nullptr;  ///< null: the model asks for no support
  const SupportDesign* design = nullptr;      ///< with the key blocks
  const Reduction* reduction = nullptr;       ///< what was looked for before the run, if anything
};
/// Whether key blocks stand beside a motion that may confirm them; that of joints with reduced strength says nothing of them.
bool has_confirmed(const RunReport& report);

/// Whether a document lists every block: the result file has them as arrays.
enum class BlockList { whole, left_out };

/// Lattice nodes that carry a physical cover.
Index mathematical_covers(const CoverArrays& covers);

/// What every document begins with.
struct DocumentHead {
  std::string command, title;
  std::optional<std::uint64_t> seed;
};

/// schema, command, version, title, and the seed where one is given.
Json head_json(const DocumentHead& head);

Json cut_document(const DocumentHead& head, const Model& model, const CutTotals& totals,
                  const BlockArrays& blocks, const RockMeasures& measures);
/// The same with an empty list of "blocks", and one entry of it: a million at once fill gigabytes.
Json cut_document_without_blocks(const DocumentHead& head, const CutTotals& totals,
                                 const BlockArrays& blocks, const RockMeasures& measures);
Json block_json(const Model& model, const BlockArrays& blocks, const BlockStatistics& statistics,
                Index b);
/// "specks", where the cutting merged any that it could.
void add_specks(Json& document, const CutTotals& totals);
/// "bodies", where solids from mesh files were fitted together.
void add_body_fit(Json& document, const Model& model);
Json support_document(const DocumentHead& head, const Model& model, const BlockArrays& blocks,
                      const KeyblockReport& report, const SupportDesign& design,
                      BlockList list = BlockList::whole);
/// "stability" alone, and the whole document of the command.
Json stability_json(const StabilityReport& report);
Json stability_document(const DocumentHead& head, const BlockArrays& blocks,
                        const StabilityReport& report);
Json theory_document(const DocumentHead& head, const TheoryReport& report);
/// With "support", as support_document has it, where there are key blocks to tell of.
Json run_document(const DocumentHead& head, const RunReport& report,
                  BlockList list = BlockList::whole);
/// Of a search for a reduction that did not come to its end: its trials, and between which of them the factor lies.
Json search_document(const DocumentHead& head, const Reduction& reduction);
/// What was computed, for reports: materials, joints, analyses; of `support` and of a run only where they were done.
Json setup_json(const Model& model, bool with_support, bool with_run);
Json check_document(const DocumentHead& head, const Model& model,
                    const std::vector<NamedExtent>& extents);
/// Of the states, 16 hexadecimal digits each.
std::vector<std::string> hash_texts(const ResultInfo& info);
Json info_document(const ResultInfo& info, const std::string& path);
Json error_document(const Error& error);

/// Adds "warnings", and "seconds" unless there are none.
void finish_document(Json& document, const std::vector<std::string>& warnings,
                     const PhaseSeconds& seconds);

/// A top-level list of a document whose entries are made one by one, as they are written.
struct LongList {
  std::string key;
  Index size = 0;
  std::function<Json(Index)> entry;
};

/// Writes a document for people and programs alike: each top-level key, and each entry of a
/// top-level list, on a line of its own. `list` stands in place of the empty list of its key.
void write_document(std::FILE* stream, const Json& document, const LongList& list = {});

}  // namespace rockfold
