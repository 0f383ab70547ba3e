// What several documents share.
#pragma once

#include <nlohmann/json.hpp>

#include "src/report/documents/documents.hpp"

namespace rockfold {

/// totals, keyblocks and blocks of block theory.
void add_support(Json& document, const Model& model, const BlockArrays& blocks,
                 const KeyblockReport& report, const SupportDesign& design,
                 BlockList list = BlockList::whole);

/// What block theory says of each key block and what it did, and what else moved; with contact and key blocks.
Json confirmed_json(const RunReport& report);
/// Blocks under a record of the ground, and Newmark's rigid block beside each; with contact.
Json shaken_json(const RunReport& report);
/// "bolts", "mobilisation" and what else its bolts and shotcrete mean for a key block.
void add_block_support(Json& keyblock, const BoltingReport& bolting, const BlockSupport& support);
/// How many bolts of each type in the catalogue the force on a key block asks for.
void add_spot_bolts(Json& keyblock, const Keyblock& key, const Model& model);
/// "bolting", "bolts", "pattern_search" and "classification", each where the model asks for it.
void add_design(Json& document, const Model& model, const SupportDesign& design);
/// The states of excavation that have openings and, in a whole document, the joint faces of finite blocks in each.
Json joint_stress_json(const BlockArrays& blocks, const JointStressReport& report, BlockList faces);
Json classification_json(const ClassificationReport& report);

/// statistics, intensities, stages and flagged.
void add_measures(Json& document, const RockMeasures& measures);

/// "small_volume", "elongated" of a block's flags.
Json flags_json(std::uint8_t flags);

/// As users count them, from 1.
Json ids_json(const std::vector<Index>& blocks);

/// m³, summed in the order of the blocks.
Real total_volume(const BlockArrays& blocks);

}  // namespace rockfold
