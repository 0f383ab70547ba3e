#include "src/report/shaken_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/keyblock/motions/sliding_block.hpp"
#include "src/base/vector.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/names.hpp"
#include "src/run/base_motion.hpp"

namespace rockfold {
namespace {

/// s, of the rigid block's steps: a hundredth of the shortest period that an earthquake's record has much of.
constexpr Real longest_step = 1e-3;

bool slides(const Keyblock& key) {
  return key.movement &&
         (key.mode == SlidingMode::single_plane || key.mode == SlidingMode::two_planes);
}

/// Of the planes that a block slides on, as their joints' materials have it; block theory's strengths are the peak ones.
std::array<PlaneStrength, 2> residual_strengths(const Keyblock& key, const RunReport& report) {
  std::array<PlaneStrength, 2> left;
  const auto& materials = report.model.joint_materials;
  for (std::size_t k = 0; k < key.planes.size() && k < 2; ++k) {
    const ContactPlane& plane = key.contact[key.movement->planes[k]];
    left[k] = {plane.friction, 0};
    const auto origin = std::find_if(report.blocks.origins.begin(), report.blocks.origins.end(),
                                     [&](const FaceOrigin& o) { return o.name == key.planes[k]; });
    if (origin == report.blocks.origins.end() || origin->joint_material == none) continue;
    const JointMaterial& joint = materials[origin->joint_material];
    if (joint.residual_friction_angle)
      left[k].friction = std::tan(*joint.residual_friction_angle * std::numbers::pi / 180);
    left[k].cohesion = joint.residual_cohesion * plane.area;
  }
  return left;
}

/// The analysis as a rigid block goes through it.
class Shaking {
 public:
  explicit Shaking(const RunReport& report)
      : report_(report),
        analysis_(*report.model.analysis),
        ground_(base_acceleration(report.model)) {}

  /// Sets what Newmark's block does.
  void shake(const Keyblock& key, ShakenBlock& shaken) const {
    Real mass = 0;
    for (const Index b : key.members) mass += report_.blocks.mass[b];
    SlidingBlock block(key.contact, *key.movement, residual_strengths(key, report_), mass);
    const Vec3 at_rest =
        key.resultant - (mass * norm(report_.model.gravity)) *
                            report_.model.support.value_or(SupportSpec{}).seismic_coefficient;
    Vec3 from{};
    Real start = 0;
    for (Index s = 0; s < std::ssize(analysis_.stages); ++s) {
      const AnalysisStage& stage = analysis_.stages[s];
      if (stage.reset_displacement) from = block.displacement();
      const Real end = std::min(start + duration(stage), report_.run.time);
      if (stage.type == AnalysisType::dynamic && s >= first_stage(key))
        go(block, at_rest, mass, start, end);
      else
        block.stop();
      start += duration(stage);
    }
    shaken.newmark = norm(block.displacement() - from);
    shaken.lifts = block.has_lifted();
  }

 private:
  /// In which it is free: a block of an excavation that a step digs is held until then.
  Index first_stage(const Keyblock& key) const {
    for (Index s = 0; s < std::ssize(analysis_.stages); ++s)
      if (key.stage > 0 && analysis_.stages[s].excavate == key.stage) return s;
    return 0;
  }

  void go(SlidingBlock& block, const Vec3& at_rest, Real mass, Real start, Real end) const {
    const Real steps = std::ceil((end - start) / longest_step), dt = (end - start) / steps;
    for (Real n = 0; n < steps; ++n)
      block.go(at_rest - mass * ground_.at(start + (n + 0.5) * dt), dt);
  }

  const RunReport& report_;
  const Analysis& analysis_;
  TimeTable ground_;  // m/s²
};

/// The body's displacement in the analysis.
void add_motion(ShakenBlock& shaken, const RunReport& report) {
  for (const Index b : shaken.members) {
    shaken.volume += report.blocks.volume[b];
    shaken.displacement += report.blocks.volume[b] * report.run.blocks[b].displacement;
  }
  shaken.displacement = (1 / shaken.volume) * shaken.displacement;
}

/// Rock that goes on beyond the model may move too, where nothing holds it.
bool is_free(Index b, const RunReport& report) {
  const bool gone = !report.run.gone.empty() && report.run.gone[b] != 0;
  return !report.run.courses[b].held && !gone;
}

}  // namespace

bool is_shaken(const RunReport& report) {
  return report.model.base_acceleration && report.run.rest && !report.reduction;
}

std::vector<ShakenBlock> shaken_blocks(const RunReport& report) {
  std::vector<ShakenBlock> list;
  std::vector<std::uint8_t> told(report.blocks.volume.size(), 0);
  const auto add = [&](std::vector<Index> members, const Keyblock* mode) {
    if (!std::all_of(members.begin(), members.end(),
                     [&](Index b) { return is_free(b, report) && !told[b]; }))
      return;
    for (const Index b : members) told[b] = 1;
    ShakenBlock shaken;
    shaken.members = std::move(members);
    shaken.mode = mode;
    add_motion(shaken, report);
    list.push_back(std::move(shaken));
  };
  if (report.keyblocks)
    for (const auto* keys : {&report.keyblocks->keyblocks, &report.keyblocks->stable})
      for (const Keyblock& key : *keys) add(key.members, &key);
  for (Index b = 0; b < report.blocks.block_count(); ++b) add({b}, nullptr);
  const Shaking shaking(report);
  for (ShakenBlock& shaken : list)
    if (shaken.mode && slides(*shaken.mode)) shaking.shake(*shaken.mode, shaken);
  const auto way = [](const ShakenBlock& s) {
    return std::max(norm(s.displacement), s.newmark.value_or(0));
  };
  std::stable_sort(list.begin(), list.end(),
                   [&](const ShakenBlock& a, const ShakenBlock& b) { return way(a) > way(b); });
  return list;
}

Json shaken_json(const RunReport& report) {
  Json list = Json::array();
  for (const ShakenBlock& shaken : shaken_blocks(report)) {
    Json entry{{"block", shaken.members.front() + 1}, {"blocks", ids_json(shaken.members)}};
    entry["mode"] = shaken.mode ? Json(mode_name(shaken.mode->mode)) : Json(nullptr);
    entry["planes"] = shaken.mode ? Json(shaken.mode->planes) : Json::array();
    entry["displacement"] = shaken.displacement;
    entry["moved"] = norm(shaken.displacement);
    entry["newmark"] = shaken.newmark ? Json(*shaken.newmark) : Json(nullptr);
    entry["lifts"] = shaken.lifts;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace rockfold
