#include "src/report/confirmed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/bolting/bolt_elements.hpp"
#include "src/base/vector.hpp"
#include "src/report/confirmed_reasons.hpp"
#include "src/report/design_names.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/names.hpp"

namespace rockfold {
namespace {

constexpr Real degrees = 180 / std::numbers::pi, nan = std::numeric_limits<Real>::quiet_NaN();
/// deg, within which two directions are one.
constexpr Real near = 5;
/// Of its weight, with which rock that stays presses a block that still falls freely: a plane that bears so little dips by more than 89.4°.
constexpr Real free_share = 0.01;

Real angle_between(const Vec3& a, const Vec3& b) {
  return degrees * std::atan2(norm(cross(a, b)), dot(a, b));
}

/// m, from their common centroid to their farthest vertex.
Real reach(const std::vector<Index>& members, const BlockArrays& blocks) {
  Vec3 centre{};
  Real volume = 0, far = 0;
  for (const Index b : members) {
    centre += blocks.volume[b] * blocks.centroid[b];
    volume += blocks.volume[b];
  }
  centre = (1 / volume) * centre;
  for (const Index b : members)
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v)
      far = std::max(far, norm(blocks.vertex[v] - centre));
  return far;
}

/// Means of the members that began to move.
struct Beginning {
  Vec3 displacement{};  ///< m
  Real volume = 0;      ///< m³
  Real mass = 0;        ///< kg
  Real pressing = 0;    ///< N
  Real rotation = 0;    ///< deg, of the one that had turned most
};

/// What turns about an edge or a corner of its own moves by at most 2 R sin(θ/2); half of that tells turning from sliding.
/// Support that yields presses a block that falls against the rock beside it, so that the way alone tells.
SeenMode mode_of(const Beginning& first, Real reach, const Vec3& gravity, bool supported) {
  const Real way = norm(first.displacement);
  if (4 * reach * std::sin(0.5 * first.rotation / degrees) > way) return SeenMode::rotation;
  const bool falls = angle_between(first.displacement, gravity) <= near &&
                     (supported || first.pressing < free_share * first.mass * norm(gravity));
  return falls ? SeenMode::falling : SeenMode::sliding;
}

SeenMode mode_predicted(const Keyblock& key) {
  switch (key.mode) {
    case SlidingMode::lifting:
      return SeenMode::falling;
    case SlidingMode::single_plane:
    case SlidingMode::two_planes:
      return SeenMode::sliding;
    case SlidingMode::rotation:
      return SeenMode::rotation;
    case SlidingMode::at_rest:
      break;
  }
  return SeenMode::stays;
}

/// A chord of the arc that a point goes as it turns by θ is off the arc's beginning by θ/2.
bool agrees(const Confirmed& c, const Beginning& first) {
  const Real bend = c.seen == SeenMode::rotation ? 0.5 * first.rotation : 0;
  if (!c.key || c.is_held()) return false;
  return c.seen == mode_predicted(*c.key) && c.off <= near + bend;
}

Confirmed confirm(const Keyblock* key, const BlockSupport* support, std::vector<Index> members,
                  const RunReport& report) {
  const BlockArrays& blocks = report.blocks;
  Confirmed c;
  c.key = key;
  c.support = support;
  c.members = std::move(members);
  c.began = c.off = nan;
  Beginning first;
  Real volume = 0;
  for (const Index b : c.members) {
    const BlockCourse& course = report.run.courses[b];
    const Real v = blocks.volume[b];
    volume += v;
    c.displacement += v * course.displacement;
    c.rotation = std::max(c.rotation, degrees * norm(course.rotation));
    if (std::isnan(course.began)) continue;
    first.volume += v;
    first.mass += blocks.mass[b];
    first.pressing += course.first_pressing;
    first.displacement += v * course.first_displacement;
    first.rotation = std::max(first.rotation, degrees * norm(course.first_rotation));
    c.began = std::isnan(c.began) ? course.began : std::min(c.began, course.began);
  }
  c.displacement = (1 / volume) * c.displacement;
  if (!has_moved(c.displacement, volume) || !(first.volume > 0.5 * volume)) {
    c.began = nan;
    c.agrees = c.is_held();
    return c;
  }
  first.displacement = (1 / first.volume) * first.displacement;
  c.seen = mode_of(first, reach(c.members, blocks), report.model.gravity, support != nullptr);
  c.direction = normalized(first.displacement);
  if (key) c.off = angle_between(key->direction, c.direction);
  c.agrees = agrees(c, first);
  return c;
}

}  // namespace

std::vector<Confirmed> confirmed_motion(const RunReport& report) {
  std::vector<Confirmed> list;
  std::vector<std::uint8_t> told(report.blocks.volume.size(), 0);
  const auto is_gone = [&](Index b) { return !report.run.gone.empty() && report.run.gone[b] != 0; };
  const auto& keys = report.keyblocks->keyblocks;
  const bool acts = has_bolts(report.model) || has_shotcrete(report.model);
  const BoltingReport* bolting =
      acts && report.design && report.design->bolting ? &*report.design->bolting : nullptr;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Keyblock& key = keys[i];
    if (std::any_of(key.members.begin(), key.members.end(), is_gone)) continue;
    list.push_back(confirm(&key, bolting ? &bolting->keyblocks[i] : nullptr, key.members, report));
    for (const Index b : key.members) told[b] = 1;
  }
  for (Index b = 0; b < report.blocks.block_count(); ++b) {
    if (told[b] || !report.blocks.finite[b]) continue;
    Confirmed other = confirm(nullptr, nullptr, {b}, report);
    if (other.seen != SeenMode::stays) list.push_back(std::move(other));
  }
  const Reasons reasons(report);
  for (Confirmed& c : list)
    if (!c.agrees) c.reason = reason_name(reasons.of(c));
  const bool other_loads = has_other_loads(report.model);
  for (Confirmed& c : list) c.other_loads = other_loads;
  return list;
}

namespace {

/// The bolts that hold a block: what each was predicted to bear, and bears at the end.
Json held_by_json(const Confirmed& c, const RunReport& report) {
  Json list = Json::array();
  for (const BoltCrossing& crossing : c.support->crossings) {
    const std::string name = bolt_name(*report.design->bolting, crossing.bolt);
    const auto& bolts = report.run.bolts;
    const auto seen = std::find_if(bolts.begin(), bolts.end(),
                                   [&](const BoltResult& bolt) { return bolt.name == name; });
    list.push_back({{"bolt", name},
                    {"predicted", crossing.load},
                    {"capacity", crossing.capacity},
                    {"seen", seen == bolts.end() ? Json() : Json(seen->force)}});
  }
  return list;
}

}  // namespace

Json confirmed_json(const RunReport& report) {
  Json list = Json::array();
  for (const Confirmed& c : confirmed_motion(report)) {
    Json entry{{"block", c.members.front() + 1}, {"blocks", ids_json(c.members)}};
    entry["batch"] = c.key ? Json(c.key->batch) : Json(nullptr);
    entry["predicted"] = nullptr;
    if (c.key)
      entry["predicted"] = {{"mode", mode_name(c.key->mode)},
                            {"direction", c.key->direction},
                            {"factor_of_safety", c.key->factor_of_safety},
                            {"residual_factor_of_safety", c.key->residual_factor_of_safety}};
    if (c.support) {
      entry["predicted"]["supported_factor_of_safety"] = c.support->held.factor_of_safety;
      entry["predicted"]["held"] = c.is_held();
      entry["bolts"] = held_by_json(c, report);
    }
    entry["seen"] = {{"mode", seen_name(c.seen)}, {"moved", norm(c.displacement)},
                     {"direction", c.direction},  {"displacement", c.displacement},
                     {"rotation", c.rotation},    {"began", c.began},
                     {"off_direction", c.off}};
    entry["agree"] = c.agrees;
    entry["other_loads"] = c.other_loads;
    entry["reason"] = c.reason.empty() ? Json(nullptr) : Json(c.reason);
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace rockfold
