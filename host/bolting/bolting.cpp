#include "host/bolting/bolting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "host/bolting/supported_block.hpp"
#include "host/parallel.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// The bolts that cross each block, ascending.
using BoltsOfBlock = std::unordered_map<Index, std::vector<Index>>;

BoltsOfBlock bolts_of_blocks(const std::vector<Bolt>& bolts) {
  BoltsOfBlock of;
  for (std::size_t i = 0; i < bolts.size(); ++i)
    for (const RockSegment& segment : bolts[i].rock) {
      auto& list = of[segment.block];
      if (list.empty() || list.back() != static_cast<Index>(i))
        list.push_back(static_cast<Index>(i));
    }
  return of;
}

bool is_in(Index block, const std::vector<Index>& members) {
  return std::find(members.begin(), members.end(), block) != members.end();
}

/// Where a bolt last leaves the blocks, m: there it holds them against the rock behind.
Vec3 leaving_point(const Bolt& bolt, const std::vector<Index>& members) {
  Real at = 0;
  for (const RockSegment& segment : bolt.rock)
    if (is_in(segment.block, members)) at = std::max(at, segment.to);
  return bolt.collar + at * bolt.direction;
}

class SupportJudge {
 public:
  SupportJudge(const SupportedRock& rock, const BoltingReport& report)
      : rock_(rock), report_(report), bolts_of_(bolts_of_blocks(report.bolts)) {}

  BlockSupport judge(const Keyblock& key) const;
  bool is_crossed_by_anchors(const Keyblock& key) const;

 private:
  Index batch(Index block) const { return rock_.keyblocks.batch[block]; }
  /// Whether a block is gone when those of a batch move; batch 0 stands for the blocks that stay to the end.
  bool gone(Index block, Index with) const {
    return batch(block) > 0 && (with == 0 || batch(block) <= with);
  }
  const BoltType& type_of(const Bolt& bolt) const { return report_.groups[bolt.group].type; }
  Embedment embedment(const Bolt& bolt, const std::vector<Index>& members, Index with) const;
  Real axial_left(const Bolt& bolt, const std::vector<Index>& members, Index with,
                  const Embedment& own) const;
  std::vector<Index> bolts_through(const std::vector<Index>& members) const;
  BoltCrossing crossing(Index bolt, const Keyblock& key) const;
  void mobilise(BlockSupport& support) const;

  const SupportedRock& rock_;
  const BoltingReport& report_;
  BoltsOfBlock bolts_of_;
};

Embedment SupportJudge::embedment(const Bolt& bolt, const std::vector<Index>& members,
                                  Index with) const {
  constexpr Real gap = 1e-3;  // m: a wider one between plate and block is air
  Embedment e;
  e.length = bolt.length;
  // Where the anchor at the far end begins: all along where none is told.
  const auto& anchor_length = type_of(bolt).anchor_length;
  const Real anchor_from = anchor_length ? bolt.length - *anchor_length : 0;
  const auto add_anchored = [&](Real from, Real to) {
    e.anchored += std::max(to - from, Real{0});
    e.anchor += std::max(to - std::max(from, anchor_from), Real{0});
  };
  Real front = 0;
  bool met = false;
  for (const RockSegment& segment : bolt.rock) {
    const Real length = segment.to - segment.from;
    if (is_in(segment.block, members)) {
      if (!met && segment.from > front + gap) e.plate = false;
      met = true;
      e.within += length;
      e.anchored = e.anchor = 0;  // what lies before the last exit holds nothing
      continue;
    }
    if (met) {
      if (!gone(segment.block, with)) add_anchored(segment.from, segment.to);
      continue;
    }
    // In front of the block: the plate reaches it only through blocks that move with it or later.
    const bool carries = with > 0 && batch(segment.block) >= with;
    if (!carries || segment.from > front + gap) e.plate = false;
    front = segment.to;
  }
  // Where the rock goes on beyond the model, the bolt does too.
  if (met && e.within > 0 && !bolt.rock.empty()) {
    const RockSegment& last = bolt.rock.back();
    const bool beyond = last.exit_face != none &&
                        rock_.blocks.origins[rock_.blocks.face_origin[last.exit_face]].continues;
    if (beyond && !is_in(last.block, members)) add_anchored(last.to, bolt.length);
  }
  return e;
}

/// A bolt's tension does not grow from block to block of one batch: the nearest to the collar takes first. Nor does an active
/// bolt's, tensioned as it is, in blocks that stay.
Real SupportJudge::axial_left(const Bolt& bolt, const std::vector<Index>& members, Index with,
                              const Embedment& own) const {
  Real taken = 0;
  const bool shares = with > 0 || type_of(bolt).action == BoltAction::active;
  for (const RockSegment& segment : bolt.rock) {
    if (is_in(segment.block, members)) break;
    if (shares && batch(segment.block) == with)
      taken =
          std::max(taken, axial_capacity(type_of(bolt), embedment(bolt, {segment.block}, with)));
  }
  return std::max(axial_capacity(type_of(bolt), own) - taken, Real{0});
}

BoltCrossing SupportJudge::crossing(Index id, const Keyblock& key) const {
  const Bolt& bolt = report_.bolts[id];
  BoltCrossing crossing;
  crossing.bolt = id;
  crossing.embedment = embedment(bolt, key.members, key.batch);
  crossing.axial_capacity = axial_left(bolt, key.members, key.batch, crossing.embedment);
  return crossing;
}

void SupportJudge::mobilise(BlockSupport& support) const {
  Real load = 0, capacity = 0;
  for (std::size_t i = 0; i < support.crossings.size(); ++i) {
    BoltCrossing& c = support.crossings[i];
    if (support.held.in_balance && !(c.capacity > 0)) continue;  // it is not needed
    c.force_mobilisation = support.held.mobilised[i];
    c.load = c.force_mobilisation * c.capacity;
    c.displacement_mobilisation =
        support.held.moved[i] / type_of(report_.bolts[c.bolt]).displacement_capacity;
    load += c.load, capacity += c.capacity;
    support.displacement_mobilisation =
        std::max(support.displacement_mobilisation, c.displacement_mobilisation);
  }
  if (capacity > 0) support.force_mobilisation = load / capacity;
  if (support.held.in_balance) return;
  // Bolts that hold nothing are no less at their end than those that hold too little.
  if (!support.crossings.empty()) support.force_mobilisation = 1;
  support.displacement_mobilisation = std::numeric_limits<Real>::infinity();
}

std::vector<Index> SupportJudge::bolts_through(const std::vector<Index>& members) const {
  std::vector<Index> bolts;
  for (const Index block : members)
    if (const auto found = bolts_of_.find(block); found != bolts_of_.end())
      bolts.insert(bolts.end(), found->second.begin(), found->second.end());
  std::sort(bolts.begin(), bolts.end());
  bolts.erase(std::unique(bolts.begin(), bolts.end()), bolts.end());
  return bolts;
}

BlockSupport SupportJudge::judge(const Keyblock& key) const {
  BlockSupport support;
  support.block = key.block;
  support.members = key.members;
  if (!rock_.shotcrete.empty()) support.shotcrete = rock_.shotcrete[key.block];
  std::vector<BoltAtBlock> bolts;
  for (const Index id : bolts_through(key.members)) {
    const BoltCrossing& c = support.crossings.emplace_back(crossing(id, key));
    const Bolt& bolt = report_.bolts[id];
    bolts.push_back(
        {&type_of(bolt), bolt.direction, c.axial_capacity, leaving_point(bolt, key.members)});
  }
  SupportedMotion motion = supported_motion(key, bolts, support.shotcrete, rock_.target);
  support.mode = motion.mode;
  for (std::size_t i = 0; i < bolts.size(); ++i) {
    support.crossings[i].force = motion.forces[i];
    support.crossings[i].capacity = norm(motion.forces[i].force);
  }
  support.held = std::move(motion.held);
  mobilise(support);
  return support;
}

bool SupportJudge::is_crossed_by_anchors(const Keyblock& key) const {
  const auto bolts = bolts_through(key.members);
  return std::any_of(bolts.begin(), bolts.end(), [&](Index bolt) {
    return type_of(report_.bolts[bolt]).action == BoltAction::active;
  });
}

/// Whether a block that stays misses the target with its support and is less safe than without.
bool is_less_safe_now(const Keyblock& key, const BlockSupport& support) {
  // The width tolerance over the model's size: vertices, and with them factors, are known no closer.
  constexpr Real rounding = 1e-9;
  return !support.held.adequate &&
         !(support.held.factor_of_safety >= (1 - rounding) * key.factor_of_safety);
}

}  // namespace

void leave_out_excavated(const BlockArrays& blocks, std::vector<Bolt>& bolts) {
  if (blocks.stage.empty()) return;
  for (Bolt& bolt : bolts)
    std::erase_if(bolt.rock,
                  [&](const RockSegment& segment) { return blocks.stage[segment.block] > 0; });
}

bool wants_bolting(const Model& model) {
  return !model.bolts.empty() || !model.bolt_patterns.empty() || model.shotcrete.has_value();
}

std::vector<ShotcreteHold> shotcrete_on(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                                        const Model& model) {
  if (!model.shotcrete) return {};
  for (const WallFaces& wall : model.shotcrete->on)
    Wall(blocks, model, wall, model.shotcrete->place);  // refuses walls that are not there
  const ShotcreteCover cover(blocks, *model.shotcrete);
  std::vector<ShotcreteHold> holds(static_cast<std::size_t>(blocks.block_count()));
  for (const auto* list : {&keyblocks.keyblocks, &keyblocks.stable, &keyblocks.at_rest})
    for (const Keyblock& key : *list) holds[key.block] = cover.hold(key.members);
  return holds;
}

std::vector<StayingBlock> staying_blocks(const KeyblockReport& keyblocks,
                                         const BoltingReport* bolting) {
  std::vector<StayingBlock> blocks;
  for (std::size_t i = 0; i < keyblocks.stable.size(); ++i)
    blocks.push_back({keyblocks.stable[i], bolting ? &bolting->stable[i] : nullptr});
  if (bolting)
    for (std::size_t i = 0; i < bolting->at_rest.size(); ++i)
      blocks.push_back({keyblocks.at_rest[bolting->key_at_rest[i]], &bolting->at_rest[i]});
  return blocks;
}

void judge_support(const SupportedRock& rock, BoltingReport& report) {
  const SupportJudge judge(rock, report);
  const auto judge_all = [&](const std::vector<Keyblock>& keys, std::vector<BlockSupport>& out) {
    out.assign(keys.size(), {});
    parallel_for(static_cast<std::int64_t>(keys.size()), 16, [&](std::int64_t i) {
      out[static_cast<std::size_t>(i)] = judge.judge(keys[static_cast<std::size_t>(i)]);
    });
  };
  judge_all(rock.keyblocks.keyblocks, report.keyblocks);
  judge_all(rock.keyblocks.stable, report.stable);
  report.at_rest.clear(), report.key_at_rest.clear(), report.disturbed.clear();
  for (std::size_t i = 0; i < rock.keyblocks.at_rest.size(); ++i) {
    const Keyblock& key = rock.keyblocks.at_rest[i];
    if (!judge.is_crossed_by_anchors(key)) continue;
    report.key_at_rest.push_back(static_cast<Index>(i));
    report.at_rest.push_back(judge.judge(key));
  }
  for (const StayingBlock& block : staying_blocks(rock.keyblocks, &report))
    if (is_less_safe_now(block.key, *block.support) && judge.is_crossed_by_anchors(block.key))
      report.disturbed.push_back(block.key.block);
  report.adequate = report.first_batch = report.first_batch_adequate = 0;
  for (std::size_t i = 0; i < report.keyblocks.size(); ++i) {
    const bool adequate = report.keyblocks[i].held.adequate;
    const bool first = rock.keyblocks.keyblocks[i].batch == 1;
    report.adequate += adequate;
    report.first_batch += first;
    report.first_batch_adequate += first && adequate;
  }
}

BoltingReport support_blocks(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                             const Model& model) {
  BoltingReport report;
  DrilledBolts drilled = drill_model(blocks, model);
  leave_out_excavated(blocks, drilled.bolts);
  require_rock(model, drilled);
  report.groups = std::move(drilled.groups);
  report.bolts = std::move(drilled.bolts);
  for (const Bolt& bolt : report.bolts) report.length += bolt.length;
  judge_support({blocks, keyblocks, model.support.value_or(SupportSpec{}).target_factor_of_safety,
                 shotcrete_on(blocks, keyblocks, model)},
                report);
  return report;
}

}  // namespace rockfold
