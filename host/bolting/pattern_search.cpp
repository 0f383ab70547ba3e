#include "host/bolting/pattern_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace rockfold {
namespace {

/// The key blocks that have to be held, and the blocks that stay if anchors may drive them; everything else of the report stays, for what is gone when.
KeyblockReport wanted_blocks(const KeyblockReport& all, const Model& model) {
  const PatternSearch& search = *model.pattern_search;
  KeyblockReport wanted = all;
  const bool anchors = std::any_of(search.types.begin(), search.types.end(), [&](Index t) {
    return model.bolt_types[t].action == BoltAction::active;
  });
  if (!anchors) wanted.stable.clear();
  std::erase_if(wanted.keyblocks, [&](const Keyblock& key) {
    return (search.hold == HoldTarget::first_batch && key.batch != 1) ||
           key.volume < search.smallest_block;
  });
  return wanted;
}

/// The bolts of one spacing, drilled when they are first needed.
struct Grid {
  std::vector<Bolt> bolts;
  bool drilled = false;
};

/// What is left of a drilled bolt that is shorter.
Bolt shortened(const Bolt& bolt, Real length) {
  Bolt shorter = bolt;
  shorter.length = length;
  std::erase_if(shorter.rock, [&](const RockSegment& s) { return s.from >= length; });
  for (RockSegment& segment : shorter.rock)
    if (segment.to > length) segment.to = length, segment.exit_face = none;
  return shorter;
}

class Search {
 public:
  Search(const BlockArrays& blocks, const KeyblockReport& keyblocks, const Model& model)
      : blocks_(blocks),
        model_(model),
        search_(*model.pattern_search),
        walls_(walls_of(blocks, model, search_.pattern)),
        lines_(blocks, model.gravity),
        wanted_(wanted_blocks(keyblocks, model)),
        shotcrete_(shotcrete_on(blocks, keyblocks, model)) {}

  PatternSearchReport run();

 private:
  std::vector<PatternTrial> candidates();
  void drill_grid(Grid& grid) const;
  BoltingReport support_by(const PatternTrial& trial);
  void judge(PatternTrial& trial);
  void name_unsafe(PatternSearchReport& report);
  Real weight(const PatternTrial& trial) const;

  const BlockArrays& blocks_;
  const Model& model_;
  const PatternSearch& search_;
  std::vector<Wall> walls_;
  RockLines lines_;
  KeyblockReport wanted_;
  std::vector<ShotcreteHold> shotcrete_;
  std::vector<Grid> grids_;  ///< [spacings]
};

Real Search::weight(const PatternTrial& trial) const {
  const BoltType& type = model_.bolt_types[trial.type];
  return trial.bolts * trial.length * type.mass_per_metre.value_or(type.force_capacity);
}

/// All patterns, the lightest first; of equal ones the one with fewer bolts, then the first in the catalogue.
std::vector<PatternTrial> Search::candidates() {
  std::vector<PatternTrial> trials;
  for (const Real spacing : search_.spacings) {
    BoltPattern pattern = search_.pattern;
    pattern.spacing = {spacing, spacing};
    pattern.length = search_.lengths.back();
    grids_.push_back({pattern_collars(walls_, blocks_, pattern), false});
    for (const Index type : search_.types)
      for (const Real length : search_.lengths) {
        const auto& anchor = model_.bolt_types[type].anchor_length;
        if (anchor && *anchor > length) continue;  // there is no such bolt
        PatternTrial trial{type, spacing, length, static_cast<Index>(grids_.back().bolts.size())};
        trial.weight = weight(trial);
        trials.push_back(trial);
      }
  }
  std::stable_sort(trials.begin(), trials.end(), [](const PatternTrial& a, const PatternTrial& b) {
    return std::tie(a.weight, a.bolts, a.type) < std::tie(b.weight, b.bolts, b.type);
  });
  return trials;
}

void Search::drill_grid(Grid& grid) const {
  if (grid.drilled) return;
  drill(lines_, grid.bolts);
  leave_out_excavated(blocks_, grid.bolts);
  grid.drilled = true;
}

BoltingReport Search::support_by(const PatternTrial& trial) {
  const auto at = std::find(search_.spacings.begin(), search_.spacings.end(), trial.spacing);
  Grid& grid = grids_[static_cast<std::size_t>(at - search_.spacings.begin())];
  drill_grid(grid);
  BoltingReport report;
  report.groups.emplace_back();
  report.groups.back().type = model_.bolt_types[trial.type];
  report.bolts.reserve(grid.bolts.size());
  for (const Bolt& bolt : grid.bolts) {
    report.bolts.push_back(shortened(bolt, trial.length));
    report.bolts.back().group = 0;
  }
  const Real target = model_.support.value_or(SupportSpec{}).target_factor_of_safety;
  judge_support({blocks_, wanted_, target, shotcrete_}, report);
  return report;
}

void Search::judge(PatternTrial& trial) {
  const BoltingReport report = support_by(trial);
  trial.held = report.adequate;
  trial.disturbed = static_cast<Index>(report.disturbed.size());
  trial.least_factor_of_safety = std::numeric_limits<Real>::quiet_NaN();
  for (const BlockSupport& support : report.keyblocks) {
    const Real safety =
        std::isnan(support.held.factor_of_safety) ? 0 : support.held.factor_of_safety;
    if (!(trial.least_factor_of_safety <= safety)) trial.least_factor_of_safety = safety;
  }
}

/// Of the nearest pattern.
void Search::name_unsafe(PatternSearchReport& report) {
  const auto unsafe = [&](const PatternTrial& trial) {
    return report.wanted - trial.held + trial.disturbed;
  };
  const auto nearest =
      std::min_element(report.trials.begin(), report.trials.end(),
                       [&](const auto& a, const auto& b) { return unsafe(a) < unsafe(b); });
  if (nearest == report.trials.end()) return;
  report.nearest = static_cast<Index>(nearest - report.trials.begin());
  BoltingReport left = support_by(*nearest);
  for (const BlockSupport& support : left.keyblocks)
    if (!support.held.adequate) report.not_held.push_back(support.block);
  report.disturbed = std::move(left.disturbed);
}

PatternSearchReport Search::run() {
  PatternSearchReport report;
  report.wanted = static_cast<Index>(wanted_.keyblocks.size());
  report.by_mass = std::all_of(search_.types.begin(), search_.types.end(), [&](Index t) {
    return model_.bolt_types[t].mass_per_metre.has_value();
  });
  auto trials = candidates();
  report.patterns = static_cast<Index>(trials.size());
  for (PatternTrial& trial : trials) {
    judge(trial);
    report.trials.push_back(trial);
    if (trial.held == report.wanted && trial.disturbed == 0) {
      report.best = static_cast<Index>(report.trials.size()) - 1;
      return report;
    }
  }
  name_unsafe(report);
  return report;
}

}  // namespace

PatternSearchReport search_pattern(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                                   const Model& model) {
  return Search(blocks, keyblocks, model).run();
}

}  // namespace rockfold
