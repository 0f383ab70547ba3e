#include "host/keyblock/keyblock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "host/keyblock/bodies.hpp"
#include "host/keyblock/groups.hpp"
#include "host/keyblock/motions/least_support.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"
#include "src/model/openings.hpp"

namespace rockfold {
namespace {

/// The batch of blocks that are excavated.
constexpr Index excavated = -1;

/// −0 as 0, so that no report shows a sign that means nothing.
Vec3 without_negative_zero(const Vec3& v) {
  return v + Vec3{};
}

/// Of the motion that governs: NaN where nothing resists, infinite where nothing drives.
Real factor_of(const BlockVerdict& verdict) {
  if (!verdict.movement && verdict.rotations.empty()) return std::numeric_limits<Real>::infinity();
  return verdict.rotates() ? verdict.rotations[0].factor_of_safety()
                           : verdict.movement->factor_of_safety();
}

std::vector<Vec3> normals_of(const std::vector<ContactPlane>& planes) {
  std::vector<Vec3> normals;
  for (const ContactPlane& p : planes) normals.push_back(p.normal);
  return normals;
}

/// The state between batches: which blocks are left, and what each of them is.
class KeyblockSearch {
 public:
  KeyblockSearch(const BlockArrays& blocks, const Model& model, const FaceTractions* in_situ);
  KeyblockReport run();

 private:
  struct Judged {
    RockBody body;
    BlockVerdict verdict;
    Real residual_factor = 0;
  };
  void excavate(Index stage);
  void find_batches(std::vector<Index> candidates);
  bool goes_on_after(Index batches) const;
  void leave_unexamined(const std::vector<Index>& blocks);
  std::vector<Index> move_single_blocks(const std::vector<Index>& candidates);
  std::vector<Index> move_groups();
  std::vector<Index> group_seeds() const;
  bool is_described(const BlockVerdict& verdict) const;
  std::vector<Judged> judge(const std::vector<Index>& candidates) const;
  std::vector<Index> left() const;
  bool stays(Index block) const;
  Index stage_of(Index block) const;
  static Index largest_free_face(const RockBody& body);
  Real residual_factor(const RockBody& body, const BlockVerdict& verdict) const;
  Keyblock describe(const RockBody& body, const BlockVerdict& verdict, Real residual_factor) const;
  void describe_translation(Keyblock& key, const RockBody& body, const BlockVerdict& verdict) const;
  void describe_rotation(Keyblock& key, const RockBody& body, const BlockVerdict& verdict) const;
  SupportForce support_of(const RockBody& body, const BlockVerdict& verdict) const;
  const std::string& plane_name(const RockBody& body, Index face) const;
  std::vector<MeshPlaneCount> mesh_planes_of(const RockBody& body,
                                             const BlockVerdict& verdict) const;
  void start_batch();

  const BlockArrays& blocks_;
  const Model& model_;
  SupportSpec spec_;
  Bodies bodies_;
  bool anchored_;  // active bolts may move what is described
  Index stage_ = 0;
  Index batch_ = 0;
  KeyblockReport report_;
  std::vector<std::optional<Keyblock>> stable_;  // of each block, as last looked at
  bool groups_searched_ = false;                 // once, everywhere
  std::vector<Index> gone_since_;                // what has left since groups were searched
};

KeyblockSearch::KeyblockSearch(const BlockArrays& blocks, const Model& model,
                               const FaceTractions* in_situ)
    : blocks_(blocks),
      model_(model),
      spec_(model.support.value_or(SupportSpec{})),
      bodies_(blocks, model, in_situ),
      anchored_(has_active_bolts(model)) {
  const auto count = static_cast<std::size_t>(blocks.block_count());
  report_.block_class.assign(count, BlockClass::tapered);
  report_.batch.assign(count, 0);
  stable_.resize(count);
}

/// At which a block is excavated; 0 = never.
Index KeyblockSearch::stage_of(Index block) const {
  return blocks_.stage.empty() ? 0 : blocks_.stage[static_cast<std::size_t>(block)];
}

/// Rock that is still there and that no stage excavates.
bool KeyblockSearch::stays(Index block) const {
  return report_.batch[static_cast<std::size_t>(block)] == 0 && stage_of(block) == 0;
}

std::vector<Index> KeyblockSearch::left() const {
  std::vector<Index> blocks;
  for (Index b = 0; b < blocks_.block_count(); ++b)
    if (stays(b)) blocks.push_back(b);
  return blocks;
}

/// Blocks that move, or would without friction, or might with anchors.
bool KeyblockSearch::is_described(const BlockVerdict& verdict) const {
  return verdict.movement || !verdict.rotations.empty() ||
         (anchored_ && verdict.block_class == BlockClass::stable);
}

/// Each candidate by itself: the order of the results is that of the candidates, whatever the
/// threads.
std::vector<KeyblockSearch::Judged> KeyblockSearch::judge(
    const std::vector<Index>& candidates) const {
  std::vector<Judged> judged(candidates.size());
  const auto judge_one = [&](std::int64_t i) {
    Judged& one = judged[static_cast<std::size_t>(i)];
    const Index block = candidates[static_cast<std::size_t>(i)];
    // A closed block without a free face has no removable direction: most are such.
    if (blocks_.finite[static_cast<std::size_t>(block)] != 0 &&
        bodies_.is_encased(block, report_.batch))
      return;
    RockBody body = bodies_.body({block}, report_.batch);
    one.verdict = bodies_.judge(body, report_.batch);
    if (!is_described(one.verdict)) return;  // what is not described needs no faces
    one.residual_factor = residual_factor(body, one.verdict);
    one.body = std::move(body);
  };
  const auto count = static_cast<std::int64_t>(candidates.size());
  constexpr std::int64_t chunk = 256;  // some 0.1 ms of work: less is not worth waking the threads
  parallel_for(count, chunk, judge_one);
  return judged;
}

const std::string& KeyblockSearch::plane_name(const RockBody& body, Index face) const {
  return bodies_.origin(body.face_id[static_cast<std::size_t>(face)]).name;
}

void KeyblockSearch::describe_translation(Keyblock& key, const RockBody& body,
                                          const BlockVerdict& verdict) const {
  const Movement& movement = *verdict.movement;
  key.mode = movement.mode;
  for (std::size_t k = 0; k < 2; ++k) {
    if (movement.planes[k] == none) continue;
    const auto& plane = verdict.planes[static_cast<std::size_t>(movement.planes[k])];
    key.planes.push_back(plane_name(body, plane.face));
    key.normal_forces.push_back(movement.normal_force[k]);
  }
  key.direction = without_negative_zero(movement.direction);
  key.driving_force = movement.driving;
  key.resisting_force = movement.resisting;
  key.sliding_force = movement.sliding_force();
  key.factor_of_safety = movement.factor_of_safety();
}

void KeyblockSearch::describe_rotation(Keyblock& key, const RockBody& body,
                                       const BlockVerdict& verdict) const {
  const Rotation& rotation = verdict.rotations[0];
  const Real arm = norm(rotation.velocity);
  key.mode = SlidingMode::rotation;
  key.planes.push_back(plane_name(body, rotation.face));
  key.direction = without_negative_zero(normalized(rotation.velocity));
  key.driving_force = rotation.driving / arm;
  key.resisting_force = rotation.resisting / arm;
  key.sliding_force = rotation.sliding_force();
  key.factor_of_safety = rotation.factor_of_safety();
}

std::vector<MeshPlaneCount> KeyblockSearch::mesh_planes_of(const RockBody& body,
                                                           const BlockVerdict& verdict) const {
  std::map<std::string, std::set<const ContactPlane*>> planes;
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    if (!(body.faces[f].contact_area > 0) || !bodies_.mesh_planes().flatness(body.face_id[f]))
      continue;
    const auto plane =
        std::find_if(verdict.planes.begin(), verdict.planes.end(), [&](const ContactPlane& p) {
          return norm(p.normal - body.faces[f].normal) <= direction_tolerance;
        });
    if (plane != verdict.planes.end())
      planes[plane_name(body, static_cast<Index>(f))].insert(&*plane);
  }
  std::vector<MeshPlaneCount> counts;
  for (const auto& [mesh, its] : planes) counts.push_back({mesh, static_cast<Index>(its.size())});
  return counts;
}

/// What brings each motion that the block can start to the target.
SupportForce KeyblockSearch::support_of(const RockBody& body, const BlockVerdict& verdict) const {
  const Real target = spec_.target_factor_of_safety;
  std::vector<SupportCondition> conditions;
  if (verdict.movement) conditions = support_conditions(verdict.planes, *verdict.movement, target);
  if (!verdict.rotations.empty()) {
    const Vec3 at = bodies_.free_centre(body);
    for (const Rotation& rotation : verdict.rotations)
      conditions.push_back(support_condition(rotation, at, target));
  }
  if (const auto& along = spec_.support_direction)
    return {support_force_along(conditions, *along), *along};
  return least_support(conditions);
}

Index KeyblockSearch::largest_free_face(const RockBody& body) {
  std::size_t largest = 0;
  Real area = 0;
  for (std::size_t f = 0; f < body.faces.size(); ++f)
    if (const BlockFace& face = body.faces[f];
        !(face.contact_area > 0) && !face.continues && face.area > area)
      largest = f, area = face.area;
  return area > 0 ? body.face_id[largest] : none;
}

/// On joints that have slipped, with the same rock round it.
Real KeyblockSearch::residual_factor(const RockBody& body, const BlockVerdict& verdict) const {
  if (!bodies_.loses_strength()) return factor_of(verdict);
  return factor_of(bodies_.judge(bodies_.with_residual_strength(body), report_.batch));
}

Keyblock KeyblockSearch::describe(const RockBody& body, const BlockVerdict& verdict,
                                  Real residual_factor) const {
  Keyblock key;
  key.block = body.members.front();
  key.members = body.members;
  key.batch = report_.batch[static_cast<std::size_t>(key.block)];
  key.stage = stage_;
  key.volume = body.volume;
  key.weight = body.mass * norm(model_.gravity);
  key.free_area = verdict.free_area;
  key.free_face = largest_free_face(body);
  key.removable = removable_space(normals_of(verdict.planes));
  key.contact = verdict.planes;
  key.mesh_planes = mesh_planes_of(body, verdict);
  key.movement = verdict.movement;
  key.rotations = verdict.rotations;
  key.resultant = verdict.resultant;
  key.residual_factor_of_safety = residual_factor;
  if (anchored_) {
    key.patches = verdict.patches;
    key.body = verdict.body;
  }
  if (!verdict.movement && verdict.rotations.empty()) {
    key.mode = SlidingMode::at_rest;
    key.factor_of_safety = std::numeric_limits<Real>::infinity();
    return key;
  }
  if (verdict.rotates())
    describe_rotation(key, body, verdict);
  else
    describe_translation(key, body, verdict);
  const SupportForce support = support_of(body, verdict);
  key.support_force = support.force;
  key.support_direction = without_negative_zero(support.direction);
  key.support_pressure = key.free_area > 0 ? key.support_force / key.free_area : 0;
  return key;
}

void KeyblockSearch::start_batch() {
  ++batch_;
  report_.batches.push_back(0);
  report_.batch_stage.push_back(stage_);
}

/// The next batch among the candidates; the blocks that it removed.
std::vector<Index> KeyblockSearch::move_single_blocks(const std::vector<Index>& candidates) {
  const std::vector<Judged> judged = judge(candidates);
  std::vector<Index> removed;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto b = static_cast<std::size_t>(candidates[i]);
    const auto& [body, verdict, residual] = judged[i];
    report_.block_class[b] = verdict.block_class;
    stable_[b].reset();
    if (verdict.block_class == BlockClass::stable && is_described(verdict))
      stable_[b] = describe(body, verdict, residual);
    if (verdict.block_class != BlockClass::key) continue;
    if (removed.empty()) start_batch();
    report_.batch[b] = batch_;
    ++report_.batches.back();
    report_.keyblocks.push_back(describe(body, verdict, residual));
    removed.push_back(candidates[i]);
  }
  return removed;
}

/// Where groups may be that were not found before: what a block takes with it is known by the blocks that
/// chains of `largest_group` contacts reach.
std::vector<Index> KeyblockSearch::group_seeds() const {
  if (!groups_searched_) return left();
  std::vector<std::uint8_t> seen(report_.batch.size(), 0);
  std::vector<Index> front = gone_since_, seeds;
  for (Index step = 0; step < spec_.largest_group && !front.empty(); ++step) {
    std::erase_if(front = bodies_.interfaces().neighbours(front, report_.batch), [&](Index b) {
      return std::exchange(seen[static_cast<std::size_t>(b)], std::uint8_t{1}) != 0;
    });
    seeds.insert(seeds.end(), front.begin(), front.end());
  }
  std::erase_if(seeds, [&](Index b) { return !stays(b); });
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

/// The groups that move now are a batch; the blocks that it removed.
std::vector<Index> KeyblockSearch::move_groups() {
  const auto may_move = [&](Index block) {
    return stays(block) && blocks_.finite[static_cast<std::size_t>(block)] != 0;
  };
  auto groups = find_groups(bodies_, group_seeds(), report_.batch, spec_.largest_group, may_move);
  groups_searched_ = true;
  gone_since_.clear();
  std::vector<Index> removed;
  if (groups.empty()) return removed;
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return a.body.members.front() < b.body.members.front();
  });
  std::vector<Real> residual;  // before the rock round them is gone
  for (const Group& group : groups) residual.push_back(residual_factor(group.body, group.verdict));
  start_batch();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    for (const Index block : group.body.members) {
      const auto b = static_cast<std::size_t>(block);
      report_.batch[b] = batch_;
      report_.block_class[b] = BlockClass::key;
      stable_[b].reset();
      removed.push_back(block);
    }
    ++report_.batches.back();
    report_.keyblocks.push_back(describe(group.body, group.verdict, residual[g]));
  }
  return removed;
}

/// Whether another batch is looked for after so many of a stage.
bool KeyblockSearch::goes_on_after(Index batches) const {
  const Index most = most_batches(model_);
  return most == 0 || batches < most;
}

/// Blocks that only the loss of reported ones lays free: what they would do is not known.
void KeyblockSearch::leave_unexamined(const std::vector<Index>& blocks) {
  for (const Index block : blocks)
    if (auto& its_class = report_.block_class[static_cast<std::size_t>(block)];
        its_class == BlockClass::tapered)
      its_class = BlockClass::not_examined;
}

void KeyblockSearch::find_batches(std::vector<Index> candidates) {
  bool single = false;  // the last batch was one of single blocks
  for (Index batches = 0;; ++batches) {
    if (!goes_on_after(batches)) {
      report_.groups_left = report_.groups_left || (single && spec_.largest_group > 1);
      return leave_unexamined(candidates);
    }
    std::vector<Index> removed = move_single_blocks(candidates);
    single = !removed.empty();
    if (removed.empty()) removed = move_groups();
    if (removed.empty()) return;
    gone_since_.insert(gone_since_.end(), removed.begin(), removed.end());
    candidates = bodies_.interfaces().neighbours(removed, report_.batch);
    std::erase_if(candidates, [&](Index b) { return !stays(b); });
  }
}

/// Takes the rock of a stage out and looks at what leaned on it.
void KeyblockSearch::excavate(Index stage) {
  stage_ = stage;
  bodies_.excavate(stage);
  std::vector<Index> removed;
  for (Index b = 0; b < blocks_.block_count(); ++b)
    if (stage_of(b) == stage && report_.batch[static_cast<std::size_t>(b)] == 0) {
      report_.batch[static_cast<std::size_t>(b)] = excavated;
      removed.push_back(b);
    }
  gone_since_.insert(gone_since_.end(), removed.begin(), removed.end());
  std::vector<Index> candidates = bodies_.interfaces().neighbours(removed, report_.batch);
  if (bodies_.stress_follows_openings())
    for (std::size_t b = 0; b < stable_.size(); ++b)
      if (stable_[b]) candidates.push_back(static_cast<Index>(b));
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::erase_if(candidates, [&](Index b) { return !stays(b); });
  find_batches(std::move(candidates));
}

KeyblockReport KeyblockSearch::run() {
  report_.smallest_block = spec_.smallest_block;
  std::set<Index> stages(blocks_.stage.begin(), blocks_.stage.end());
  stages.erase(0);
  find_batches(left());
  for (const Index stage : stages) excavate(stage);
  for (const auto& block : stable_)
    if (block)
      (block->mode == SlidingMode::at_rest ? report_.at_rest : report_.stable).push_back(*block);
  for (std::size_t b = 0; b < report_.batch.size(); ++b)
    if (report_.batch[b] == excavated) {
      report_.batch[b] = 0;
      report_.block_class[b] = BlockClass::excavated;
    }
  return std::move(report_);
}

}  // namespace

bool has_active_bolts(const Model& model) {
  const auto is_active = [](const BoltType& type) { return type.action == BoltAction::active; };
  const auto any = [&](const auto& bolts) {
    return std::any_of(bolts.begin(), bolts.end(),
                       [&](const auto& b) { return is_active(b.type); });
  };
  return any(model.bolts) || any(model.bolt_patterns) ||
         (model.pattern_search &&
          std::any_of(model.bolt_types.begin(), model.bolt_types.end(), is_active));
}

StageKeys keys_of_keyblocks(const Model& model) {
  StageKeys stage{"key blocks",
                  {"gravity", "material.density", "joint_material.friction_angle",
                   "joint_material.cohesion", "joint_material.residual_friction_angle",
                   "joint_material.residual_cohesion", "joint_mesh.flatness", "support", "water",
                   "point_load", "traction", "bolt", "bolt_pattern", "shotcrete"}};
  if (model.initial_stress.any)
    for (const char* key :
         {"initial_stress", "joint_material.normal_stiffness", "joint_material.shear_stiffness"})
      stage.keys.emplace_back(key);
  if (has_elastic_joint_stress(model))
    for (const char* key : {"material.young_modulus", "material.poisson_ratio"})
      stage.keys.emplace_back(key);
  if (model.support && !model.support->joint_faces_only) stage.keys.emplace_back("fixed.where");
  return stage;
}

Index most_batches(const Model& model) {
  const auto given = model.support ? model.support->batches : std::nullopt;
  return given.value_or(model.excavations.empty() ? 0 : 1);
}

KeyblockReport find_keyblocks(const BlockArrays& blocks, const Model& model,
                              const FaceTractions* in_situ) {
  return KeyblockSearch(blocks, model, in_situ).run();
}

}  // namespace rockfold
