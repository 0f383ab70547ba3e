#include "host/keyblock/theory/theory.hpp"

#include <algorithm>
#include <cmath>

#include "host/keyblock/theory/slope_block.hpp"
#include "host/keyblock/theory/tunnel_block.hpp"
#include "host/keyblock/water/water.hpp"
#include "host/parallel.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

ScanEntry demand(const std::vector<TheoryBlock>& blocks) {
  ScanEntry entry;
  for (const TheoryBlock& block : blocks) {
    if (!block.key) continue;
    ++entry.key_blocks;
    entry.largest_volume = std::max(entry.largest_volume, block.shape.volume);
    entry.largest_support = std::max(entry.largest_support, block.support_force);
    entry.largest_pressure = std::max(entry.largest_pressure, block.support_pressure);
  }
  return entry;
}

/// `blocks_at(entry)`: the largest blocks of the excavation turned to there.
template <class BlocksAt>
Scan scan_over(std::vector<ScanEntry> entries, BlocksAt blocks_at) {
  Scan scan{std::move(entries)};
  parallel_for(static_cast<std::int64_t>(scan.entries.size()), 1, [&](std::int64_t i) {
    ScanEntry& entry = scan.entries[static_cast<std::size_t>(i)];
    ScanEntry found = demand(blocks_at(entry));
    found.direction = entry.direction;
    found.plunge = entry.plunge;
    entry = found;
  });
  const auto less = [](const ScanEntry& a, const ScanEntry& b) {
    return a.largest_support < (1 - 1e-12) * b.largest_support;
  };
  for (std::size_t i = 0; i < scan.entries.size(); ++i) {
    const auto at = [&](Index k) -> const ScanEntry& {
      return scan.entries[static_cast<std::size_t>(k)];
    };
    if (scan.best == none || less(scan.entries[i], at(scan.best)))
      scan.best = static_cast<Index>(i);
    if (scan.worst == none || less(at(scan.worst), scan.entries[i]))
      scan.worst = static_cast<Index>(i);
  }
  return scan;
}

std::vector<ScanEntry> directions(const TheoryScan& spec, const std::vector<Real>& plunges) {
  std::vector<ScanEntry> entries;
  for (const Real plunge : plunges)
    for (Index k = 0; k * spec.step < 360 - 1e-9; ++k)
      entries.push_back({.direction = k * spec.step, .plunge = plunge});
  return entries;
}

ExcavationTheory of_tunnel(const Model& model, const TheoryTunnel& tunnel,
                           const std::vector<TheorySet>& sets, const TheoryLoads& loads) {
  ExcavationTheory theory;
  theory.name = tunnel.name;
  theory.direction = tunnel.trend;
  theory.plunge = tunnel.plunge;
  theory.blocks = tunnel_blocks(sets, loads, tunnel);
  if (model.theory->scan)
    theory.scan = scan_over(directions(*model.theory->scan, model.theory->scan->plunges),
                            [&](const ScanEntry& entry) {
                              TheoryTunnel turned = tunnel;
                              turned.trend = entry.direction;
                              turned.plunge = entry.plunge;
                              return tunnel_blocks(sets, loads, turned);
                            });
  if (model.theory->monte_carlo)
    theory.monte_carlo = simulate_tunnel(model, tunnel, *model.theory->monte_carlo);
  return theory;
}

ExcavationTheory of_slope(const Model& model, const TheorySlope& slope,
                          const std::vector<TheorySet>& sets, const TheoryLoads& loads) {
  ExcavationTheory theory;
  theory.name = slope.name;
  theory.tunnel = false;
  theory.direction = slope.face.dip_direction;
  theory.blocks = slope_blocks(sets, loads, slope, slope.face.dip_direction);
  if (model.theory->scan)
    theory.scan = scan_over(directions(*model.theory->scan, {0}), [&](const ScanEntry& entry) {
      return slope_blocks(sets, loads, slope, entry.direction);
    });
  return theory;
}

/// Whether a tunnel leaves a pyramid's blocks finite: it does not hold the axis.
bool is_removable_from(const TunnelFrame& frame, std::span<const Vec3> pyramid) {
  const auto holds = [&](const Vec3& u) {
    return std::all_of(pyramid.begin(), pyramid.end(),
                       [&](const Vec3& n) { return dot(n, u) <= direction_tolerance; });
  };
  return !holds(frame.axis) && !holds(-frame.axis);
}

PyramidEntry pyramid_entry(const Model& model, const std::vector<TheorySet>& sets,
                           const std::string& code) {
  PyramidEntry entry;
  entry.code = code;
  entry.unit.code = code;
  const auto normals = joint_pyramid(upward_normals(sets), code);
  entry.exists = removable_direction(normals).has_value();
  if (!entry.exists) return entry;
  entry.space = removable_space(normals);
  auto dry = sets;
  for (TheorySet& set : dry) set.cohesion = 0, set.water = nullptr;
  TheoryLoads loads = theory_loads(model);
  loads.water_pressure = 0;
  if (const Real g = norm(loads.gravity); g > 0) loads.density = 1 / g;
  entry.unit = judge_theory_block(
      dry, code, {.volume = 1, .free_area = 1, .joint_area = std::vector<Real>(normals.size(), 1)},
      loads);
  for (const TheoryTunnel& tunnel : model.theory->tunnels)
    if (is_removable_from(tunnel_frame(tunnel.trend, tunnel.plunge, tunnel.section), normals))
      entry.removable_from.push_back(tunnel.name);
  for (const TheorySlope& slope : model.theory->slopes)
    if (is_removable(normals, excavation_normals(slope_frame(slope, slope.face.dip_direction))))
      entry.removable_from.push_back(slope.name);
  return entry;
}

/// Depths below a level, and edges that drain, are known in slopes, whose toe is z = 0.
void require_water_that_has_a_place(const Model& model) {
  if (model.theory->tunnels.empty()) return;
  for (const Water& water : model.waters)
    if (!std::holds_alternative<WaterPressure>(water.level))
      refuse(
          water.place, water.place.key,
          "where the blocks of a tunnel lie is not known: water has a pressure there, no head or "
          "table (slopes take these, with their toe at z = 0)");
    else if (is_drained(water))
      refuse(water.place, water.place.key,
             "where the blocks of a tunnel lie is not known: water has the same pressure there to "
             "the edge of every joint, without `drains = true` and with no other law than "
             "\"hydrostatic\"");
}

}  // namespace

std::vector<TheoryBlock> tunnel_blocks(const std::vector<TheorySet>& sets, const TheoryLoads& loads,
                                       const TheoryTunnel& tunnel) {
  std::vector<TheoryBlock> blocks;
  if (sets.size() < 3) return blocks;
  const TunnelFrame frame = tunnel_frame(tunnel.trend, tunnel.plunge, tunnel.section);
  for (const std::string& code : codes_of(sets.size(), 3)) {
    const auto normals = joint_pyramid(upward_normals(sets), code);
    if (const auto pyramid = TunnelPyramid::make(frame, normals))
      blocks.push_back(judge_theory_block(sets, code, pyramid->maximum_block(), loads));
  }
  return blocks;
}

std::vector<TheoryBlock> slope_blocks(const std::vector<TheorySet>& sets, const TheoryLoads& loads,
                                      const TheorySlope& slope, Real dip_direction) {
  std::vector<TheoryBlock> blocks;
  const SlopeFrame frame = slope_frame(slope, dip_direction);
  for (const std::size_t digits : {2, 3}) {
    if (sets.size() < digits) continue;
    for (const std::string& code : codes_of(sets.size(), digits)) {
      const auto normals = joint_pyramid(upward_normals(sets), code);
      if (const auto shape = largest_block(frame, normals))
        blocks.push_back(judge_theory_block(sets, code, *shape, loads));
    }
  }
  return blocks;
}

StageKeys keys_of_theory(const Model&) {
  return {"block theory",
          {"title",
           "gravity",
           "material.name",
           "material.density",
           "joint_material.name",
           "joint_material.friction_angle",
           "joint_material.cohesion",
           "joint_set.name",
           "joint_set.dip",
           "joint_set.dip_direction",
           "joint_set.normal",
           "joint_set.strike",
           "joint_set.rule",
           "joint_set.trend",
           "joint_set.plunge",
           "joint_set.spacing",
           "joint_set.material",
           "joint_set.random",
           "block_theory",
           "support.water_pressure",
           "water",
           "support.seismic_coefficient",
           "support.target_factor_of_safety"}};
}

TheoryReport joint_set_theory(const Model& model) {
  require_water_that_has_a_place(model);
  TheoryReport report;
  report.sets = theory_sets(model);
  const TheoryLoads loads = theory_loads(model);
  const std::size_t n = report.sets.size();
  for (std::size_t bits = 0; bits < (std::size_t{1} << n); ++bits) {
    std::string code;
    for (std::size_t i = n; i-- > 0;) code += (bits >> i & 1) ? '1' : '0';
    report.pyramids.push_back(pyramid_entry(model, report.sets, code));
  }
  for (const TheoryTunnel& tunnel : model.theory->tunnels)
    report.excavations.push_back(of_tunnel(model, tunnel, report.sets, loads));
  for (const TheorySlope& slope : model.theory->slopes)
    report.excavations.push_back(of_slope(model, slope, report.sets, loads));
  return report;
}

}  // namespace rockfold
