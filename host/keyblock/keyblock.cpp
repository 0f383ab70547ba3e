#include "host/keyblock/keyblock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include "host/keyblock/face_contacts.hpp"
#include "host/keyblock/least_support.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// What all faces of one origin have in common.
struct FaceStrength {
  Real friction = 0;       ///< tan φ
  Real cohesion = 0;       ///< Pa
  bool continues = false;  ///< or held: see holds()
};

/// Whether a `fixed` condition stands on this face of a solid.
bool holds(const Fixed& fixed, const FaceOrigin& origin) {
  const auto* region = std::get_if<FaceRegion>(&fixed.where);
  return region && !region->of_excavation && region->solid == origin.solid &&
         std::find(region->faces.begin(), region->faces.end(), origin.solid_face) !=
             region->faces.end();
}

FaceStrength face_strength(const FaceOrigin& origin, const Model& model, bool joint_faces_only) {
  FaceStrength strength;
  strength.continues = origin.continues;
  if (origin.kind == FaceOrigin::Kind::solid_face) {
    if (!joint_faces_only)
      strength.continues |= std::any_of(model.fixed.begin(), model.fixed.end(),
                                        [&](const Fixed& f) { return holds(f, origin); });
  } else if (origin.joint_material != none) {
    const auto& joint = model.joint_materials[static_cast<std::size_t>(origin.joint_material)];
    strength.friction = std::tan(joint.friction_angle * std::numbers::pi / 180);
    strength.cohesion = joint.cohesion;
  }
  return strength;
}

/// The batch of blocks that are excavated: gone before the first.
constexpr Index excavated = -1;

/// The state between batches: which blocks are left, and what each of them is.
class KeyblockSearch {
 public:
  KeyblockSearch(const BlockArrays& blocks, const Model& model);
  KeyblockReport run();

 private:
  std::vector<BlockVerdict> judge(const std::vector<Index>& candidates) const;
  BlockVerdict judge(Index block) const;
  Vec3 load(Index block) const;
  Real weight(Index block) const;
  Keyblock describe(Index block, const BlockVerdict& verdict) const;
  const std::string& plane_name(Index block, const ContactPlane& plane) const;

  const BlockArrays& blocks_;
  const Model& model_;
  SupportSpec spec_;
  FaceContacts contacts_;
  std::vector<FaceStrength> strength_;  ///< [origins]
  KeyblockReport report_;
  std::vector<std::optional<Keyblock>> stable_;  // of each block, as last looked at
};

KeyblockSearch::KeyblockSearch(const BlockArrays& blocks, const Model& model)
    : blocks_(blocks),
      model_(model),
      spec_(model.support.value_or(SupportSpec{})),
      contacts_(blocks) {
  for (const FaceOrigin& origin : blocks.origins)
    strength_.push_back(face_strength(origin, model, spec_.joint_faces_only));
  const auto count = static_cast<std::size_t>(blocks.block_count());
  report_.block_class.assign(count, BlockClass::tapered);
  report_.batch.assign(count, 0);
  for (std::size_t b = 0; b < blocks.stage.size(); ++b)
    if (blocks.stage[b] > 0) report_.batch[b] = excavated;
  stable_.resize(count);
}

Real KeyblockSearch::weight(Index block) const {
  return blocks_.mass[static_cast<std::size_t>(block)] * norm(model_.gravity);
}

/// Weight and earthquake: m g + W k.
Vec3 KeyblockSearch::load(Index block) const {
  return blocks_.mass[static_cast<std::size_t>(block)] * model_.gravity +
         weight(block) * spec_.seismic_coefficient;
}

BlockVerdict KeyblockSearch::judge(Index block) const {
  const auto b = static_cast<std::size_t>(block);
  BlockVerdict verdict;
  if (!blocks_.finite[b]) {
    verdict.block_class = BlockClass::infinite;
    return verdict;
  }
  std::vector<BlockFace> faces;
  faces.reserve(static_cast<std::size_t>(blocks_.face_begin[b + 1] - blocks_.face_begin[b]));
  for (Index id = blocks_.face_begin[b]; id < blocks_.face_begin[b + 1]; ++id) {
    const auto f = static_cast<std::size_t>(id);
    const FaceStrength& strength = strength_[static_cast<std::size_t>(blocks_.face_origin[f])];
    faces.push_back({.normal = blocks_.face_normal[f],
                     .area = blocks_.face_area[f],
                     .contact_area = contacts_.area(id, report_.batch),
                     .friction = strength.friction,
                     .cohesion = strength.cohesion,
                     .continues = strength.continues});
  }
  return judge_block(faces, load(block), spec_.water_pressure);
}

/// Each candidate by itself: the order of the results is that of the candidates, whatever the
/// threads.
std::vector<BlockVerdict> KeyblockSearch::judge(const std::vector<Index>& candidates) const {
  std::vector<BlockVerdict> verdicts(candidates.size());
  const auto judge_one = [&](std::int64_t i) {
    verdicts[static_cast<std::size_t>(i)] = judge(candidates[static_cast<std::size_t>(i)]);
  };
  const auto count = static_cast<std::int64_t>(candidates.size());
  constexpr std::int64_t chunk = 256;  // some 0.1 ms of work: less is not worth waking the threads
  if (count > chunk) {
    parallel_for(count, chunk, judge_one);
  } else {
    for (std::int64_t i = 0; i < count; ++i) judge_one(i);
  }
  return verdicts;
}

const std::string& KeyblockSearch::plane_name(Index block, const ContactPlane& plane) const {
  const auto face = static_cast<std::size_t>(blocks_.face_begin[static_cast<std::size_t>(block)]) +
                    static_cast<std::size_t>(plane.face);
  return blocks_.origins[static_cast<std::size_t>(blocks_.face_origin[face])].name;
}

/// −0 as 0, so that no report shows a sign that means nothing.
Vec3 without_negative_zero(const Vec3& v) {
  return v + Vec3{};
}

Keyblock KeyblockSearch::describe(Index block, const BlockVerdict& verdict) const {
  const Movement& movement = *verdict.movement;
  const Real target = spec_.target_factor_of_safety;
  const SupportForce support =
      spec_.support_direction
          ? SupportForce{support_force_along(verdict.planes, movement, *spec_.support_direction,
                                             target),
                         *spec_.support_direction}
          : least_support(verdict.planes, movement, target);
  Keyblock key;
  key.block = block;
  key.batch = report_.batch[static_cast<std::size_t>(block)];
  key.volume = blocks_.volume[static_cast<std::size_t>(block)];
  key.weight = weight(block);
  key.mode = movement.mode;
  for (Index plane : movement.planes)
    if (plane != none)
      key.planes.push_back(plane_name(block, verdict.planes[static_cast<std::size_t>(plane)]));
  key.direction = without_negative_zero(movement.direction);
  key.sliding_force = movement.sliding_force();
  key.factor_of_safety = movement.factor_of_safety();
  key.free_area = verdict.free_area;
  key.support_force = support.force;
  key.support_pressure = key.free_area > 0 ? support.force / key.free_area : 0;
  key.support_direction = without_negative_zero(support.direction);
  key.contact = verdict.planes;
  key.movement = movement;
  return key;
}

KeyblockReport KeyblockSearch::run() {
  std::vector<Index> candidates;
  for (Index b = 0; b < blocks_.block_count(); ++b)
    if (report_.batch[static_cast<std::size_t>(b)] != excavated) candidates.push_back(b);
  for (Index batch = 1;; ++batch) {
    const std::vector<BlockVerdict> verdicts = judge(candidates);
    std::vector<Index> removed;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto b = static_cast<std::size_t>(candidates[i]);
      report_.block_class[b] = verdicts[i].block_class;
      stable_[b].reset();
      if (verdicts[i].block_class == BlockClass::stable && verdicts[i].movement)
        stable_[b] = describe(candidates[i], verdicts[i]);
      if (verdicts[i].block_class != BlockClass::key) continue;
      report_.batch[b] = batch;
      report_.keyblocks.push_back(describe(candidates[i], verdicts[i]));
      removed.push_back(candidates[i]);
    }
    if (removed.empty()) break;
    report_.batches.push_back(static_cast<Index>(removed.size()));
    candidates = contacts_.neighbours(removed, report_.batch);
  }
  for (const auto& block : stable_)
    if (block) report_.stable.push_back(*block);
  for (std::size_t b = 0; b < report_.batch.size(); ++b)
    if (report_.batch[b] == excavated) {
      report_.batch[b] = 0;
      report_.block_class[b] = BlockClass::excavated;
    }
  return std::move(report_);
}

}  // namespace

KeyblockReport find_keyblocks(const BlockArrays& blocks, const Model& model) {
  return KeyblockSearch(blocks, model).run();
}

}  // namespace rockfold
