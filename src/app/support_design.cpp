#include "src/app/support_design.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "src/base/place_text.hpp"
#include "src/base/vector.hpp"
#include "src/report/design_names.hpp"

namespace rockfold {

StageKeys keys_of_support_design(const Model& model) {
  StageKeys keys{"support design",
                 {"bolt_type", "bolt", "bolt_pattern", "shotcrete", "pattern_search",
                  "classification", "drawing"}};
  if (!std::all_of(model.tables.begin(), model.tables.end(), std::mem_fn(&TableFile::is_history)))
    keys.keys.emplace_back("table");
  return keys;
}

SupportDesign design_support(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                             const RockMeasures* measures, const Model& model) {
  SupportDesign design;
  if (wants_bolting(model)) design.bolting = support_blocks(blocks, keyblocks, model);
  if (model.pattern_search) design.search = search_pattern(blocks, keyblocks, model);
  if (model.classification) design.classification = classify(blocks, keyblocks, *measures, model);
  return design;
}

namespace {

/// Grids may have rows on the very end of the rock.
void warn_of_idle_bolts(const BoltingReport& bolting, Terminal& terminal) {
  std::vector<Index> idle(bolting.groups.size());
  for (const Bolt& bolt : bolting.bolts) idle[bolt.group] += bolt.rock.empty();
  for (std::size_t g = 0; g < idle.size(); ++g)
    if (idle[g] > 0)
      terminal.warn(fmt::format(
          "{}: {} of its {} bolts cross no rock; `offset` moves the grid off the rock's ends",
          bolting.groups[g].name, idle[g], bolting.groups[g].bolts));
}

/// A plate needs a face, with rock behind it; a wider gap than a millimetre is air there (bolting.cpp).
void warn_of_collars_off_the_face(const BoltingReport& bolting, Terminal& terminal) {
  constexpr Real gap = 1e-3, recess = 0.1;  // m: a plate may be sunk so deep, and collars mapped so
  for (const Bolt& bolt : bolting.bolts) {
    const BoltGroup& group = bolting.groups[bolt.group];
    if (group.is_pattern || bolt.rock.empty()) continue;
    const RockSegment& first = bolt.rock.front();
    if (first.behind > recess && group.type.plate_capacity > 0)
      terminal.warn(fmt::format(
          "{}: its collar lies {:.3g} m inside block {}, where no face carries the plate that is "
          "counted; on the block's face it is at {}, and plate_capacity = 0 is a bolt without one",
          group.name, first.behind, first.block + 1,
          place_text(bolt.collar - first.behind * bolt.direction)));
    if (!(first.from > gap)) continue;
    const Vec3 face = bolt.collar + first.from * bolt.direction;
    terminal.warn(fmt::format(
        "{}: its collar is {:.3g} m off the rock, so that its plate holds nothing; on the face it "
        "is at {}",
        group.name, bolt.rock.front().from, place_text(face)));
  }
}

void warn_of_no_pattern(const PatternSearchReport& search, Terminal& terminal) {
  const auto named = [](const std::vector<Index>& blocks) {
    return (blocks.size() == 1 ? "block " : "blocks ") + block_list(blocks);
  };
  std::string left;
  if (!search.not_held.empty()) left = " leaves " + named(search.not_held);
  if (!search.disturbed.empty())
    left +=
        (left.empty() ? "" : " and") + (" brings, by its active bolts, " + named(search.disturbed));
  terminal.warn(fmt::format(
      "pattern_search: none of the {} patterns holds all {} key blocks: the nearest one{} below "
      "the target factor of safety; look at those that no bolt crosses, or let smallest_block "
      "leave small ones to mesh or shotcrete",
      search.patterns, search.wanted, left));
}

}  // namespace

void warn_of_support_design(const SupportDesign& design, Terminal& terminal) {
  if (design.bolting)
    for (const BoltGroup& group : design.bolting->groups)
      if (!group.type.bond_strength)
        terminal.warn(fmt::format(
            "{}: no bond_strength is given: any length beyond a block anchors the whole capacity",
            group.name));
  if (design.bolting) {
    warn_of_idle_bolts(*design.bolting, terminal);
    warn_of_collars_off_the_face(*design.bolting, terminal);
  }
  if (design.bolting && !design.bolting->disturbed.empty())
    terminal.warn(fmt::format(
        "active bolts bring blocks that stay without them below the target factor of safety: {}",
        block_list(design.bolting->disturbed)));
  if (design.search && design.search->best == none) warn_of_no_pattern(*design.search, terminal);
}

void warn_of_anchors_that_move(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                               const BoltingReport& bolting, const Model& model,
                               const FaceTractions* in_situ, Terminal& terminal) {
  const Index batches = most_batches(model);
  const auto holds = [](const BlockSupport& s) { return s.held.in_balance || s.held.adequate; };
  if (batches == 0 || std::none_of(bolting.keyblocks.begin(), bolting.keyblocks.end(), holds))
    return;
  Model further = model;
  if (!further.support) further.support.emplace();
  further.support->batches = batches + 1;
  const KeyblockReport next = find_keyblocks(blocks, further, in_situ);
  const BoltingReport of_next = support_blocks(blocks, next, further);
  std::vector<std::uint8_t> falls(blocks.block_count(), 0);
  for (std::size_t k = 0; k < next.keyblocks.size(); ++k)
    if (!of_next.keyblocks[k].held.adequate)
      for (const Index member : next.keyblocks[k].members)
        falls[member] = keyblocks.batch[member] == 0;
  std::set<Index> held, anchors;
  for (const BlockSupport& support : bolting.keyblocks) {
    if (!holds(support)) continue;
    for (const BoltCrossing& crossing : support.crossings)
      for (const RockSegment& segment : bolting.bolts[crossing.bolt].rock)
        if (falls[segment.block] != 0) {
          held.insert(support.block);
          anchors.insert(segment.block);
        }
  }
  if (held.empty()) return;
  const auto list = [](const std::set<Index>& of) { return block_list({of.begin(), of.end()}); };
  terminal.warn(fmt::format(
      "bolts that hold key blocks ({}) go into blocks that these keep in place and that no bolts "
      "hold enough ({}): all of them may come down together; support.batches = 0 looks at them",
      list(held), list(anchors)));
}

}  // namespace rockfold
