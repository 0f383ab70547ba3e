#include "host/stability/bolt_ties.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "host/bolting/bolting.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// A part of a bolt within one body.
struct Run {
  Index body = none;
  Real from = 0, to = 0;  ///< m along the bolt

  Real length() const { return to - from; }
};

std::vector<Run> runs_of(const Bolt& bolt, const std::vector<Index>& body_of) {
  std::vector<Run> runs;
  for (const RockSegment& segment : bolt.rock) {
    const Index body = body_of[segment.block];
    if (!runs.empty() && runs.back().body == body)
      runs.back().to = segment.to;
    else
      runs.push_back({body, segment.from, segment.to});
  }
  return runs;
}

void add_ties(const Bolt& bolt, const BoltGroup& group, const std::vector<Run>& runs,
              std::vector<BoltTie>& ties) {
  const BoltType& type = group.type;
  const Run& end = runs.back();
  const Real anchor =
      std::min(end.length(), type.anchor_length.value_or(bolt.length) - (bolt.length - end.to));
  constexpr Real at_collar = 1e-6;  // m: where a plate lies on rock
  Real left = type.force_capacity;
  for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
    const Run& run = runs[k];
    if (run.body == end.body) continue;
    const bool plate = k == 0 && run.from <= at_collar;
    const Real capacity = std::min(
        left, axial_capacity(type, {bolt.length, run.length(), end.length(), plate, anchor}));
    if (!(capacity > 0)) continue;
    left -= capacity;
    const bool active = type.action == BoltAction::active && plate;
    ties.push_back({{run.body, end.body},
                    bolt.collar + 0.5 * (run.from + run.to) * bolt.direction,
                    bolt.direction,
                    active ? capacity : 0,
                    capacity,
                    fmt::format("{}.{}", group.name, bolt.number)});
  }
}

}  // namespace

std::vector<BoltTie> bolt_ties(const BlockArrays& blocks, const Model& model,
                               const std::vector<Index>& body_of) {
  std::vector<BoltTie> ties;
  if (!wants_bolting(model)) return ties;
  DrilledBolts drilled = drill_model(blocks, model);
  leave_out_excavated(blocks, drilled.bolts);
  for (const Bolt& bolt : drilled.bolts) {
    const std::vector<Run> runs = runs_of(bolt, body_of);
    if (runs.size() > 1) add_ties(bolt, drilled.groups[bolt.group], runs, ties);
  }
  return ties;
}

}  // namespace rockfold
