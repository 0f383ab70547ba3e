// What a person reads at the end of a command, as text. Lengths in m, forces in kN, pressures in
// kPa.
#pragma once

#include <string>
#include <vector>

#include "host/cut/cut.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/measure/measure.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/io/result_file.hpp"
#include "src/model/model.hpp"
#include "src/report/documents/documents.hpp"

namespace rockfold {

constexpr std::size_t most_keyblocks = 20;

std::string check_summary(const Model& model, const std::vector<NamedExtent>& extents);
/// Of solids from mesh files that were fitted together, and to what tolerance.
std::string bodies_summary(const BodyFit& fit);
std::string cut_summary(const CutTotals& totals, const BlockArrays& blocks);
/// Sizes and shapes of the blocks, joints and their intensities, stages.
std::string measure_summary(const RockMeasures& measures);
/// The key blocks that need the greatest support force, `most` of them, and the batches.
/// With a line on the whole mass, where it was asked.
std::string support_summary(const KeyblockReport& report, const BlockArrays& blocks,
                            const StabilityReport* whole, std::size_t most = most_keyblocks);
/// The factor that no mass without dilation exceeds, and how blocks move at it, `most` of them.
std::string stability_summary(const StabilityReport& report, const BlockArrays& blocks,
                              std::size_t most = most_keyblocks);
/// Joint pyramids, the largest blocks of tunnels and slopes, scans, probabilities.
std::string theory_summary(const TheoryReport& report);
std::string run_summary(const RunReport& report);
/// The factor of a strength reduction, and which blocks fail.
std::string reduction_summary(const RunReport& report);
/// Of a search that did not come to its end.
std::string search_summary(const Reduction& reduction);
/// "is at least 1.2 and below 1.3": what trials, of which there is one at least, say of the factor.
std::string bounds_text(const Reduction& reduction);
/// What block theory says of each key block, `most` of them, and what it did, and what else moved; with contact and key blocks.
std::string confirmed_summary(const RunReport& report, std::size_t most = most_keyblocks);
/// How far each block that nothing holds has come under a record of the ground, and Newmark's rigid block beside it, `most` of them; with
/// contact and a record.
std::string shaken_summary(const RunReport& report, std::size_t most = most_keyblocks);
std::string info_summary(const ResultInfo& info, const std::string& path);

/// "  blocks        512  …": a fact and its value, aligned with the others.
std::string fact(const std::string& name, const std::string& value);

}  // namespace rockfold
