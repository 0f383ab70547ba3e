#include <algorithm>
#include <cmath>
#include <limits>

#include "host/keyblock/face_shape.hpp"
#include "src/base/vector.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/names.hpp"
#include "src/report/summaries/keyblock_words.hpp"

namespace rockfold {

namespace {

Json rotation_json(const Rotation& rotation) {
  return {{"about", rotation.about == Rotation::About::edge ? "edge" : "corner"},
          {"point", rotation.point},
          {"axis", rotation.axis},
          {"driving_moment", rotation.driving},
          {"resisting_moment", rotation.resisting}};
}

/// Of a group: of its volume.
Vec3 centroid(const Keyblock& key, const BlockArrays& blocks) {
  if (key.members.size() < 2) return blocks.centroid[static_cast<std::size_t>(key.block)];
  Vec3 sum{};
  for (const Index b : key.members)
    sum += (blocks.volume[static_cast<std::size_t>(b)] / key.volume) *
           blocks.centroid[static_cast<std::size_t>(b)];
  return sum;
}

Json keyblock_json(const Keyblock& key, const BlockArrays& blocks) {
  Json json{
      {"block", key.block + 1},
      {"batch", key.batch},
      {"volume", key.volume},
      {"weight", key.weight},
      {"mode", mode_name(key.mode)},
      {"motion", mode_words(key)},
      {"planes", key.planes},
      {"direction", key.direction},
      {"sliding_force", key.sliding_force},
      {"factor_of_safety", key.factor_of_safety},  // NaN is written as null
      {"free_area", key.free_area},
      {"support_force", key.support_force},
      {"support_pressure", key.support_pressure},
      {"support_direction", key.support_direction},
      {"bolts", Json::array()},
      {"mobilisation", {{"force", 0.0}, {"displacement", 0.0}}},
      {"centroid", centroid(key, blocks)},
      {"blocks", ids_json(key.members)},
      {"stage", key.stage},
      {"residual_factor_of_safety", key.residual_factor_of_safety},
      {"driving_force", key.driving_force},
      {"resisting_force", key.resisting_force},
      {"normal_forces", key.normal_forces},
      {"removable", {{"edges", key.removable.edges}, {"solid_angle", key.removable.solid_angle}}}};
  for (const MeshPlaneCount& mesh : key.mesh_planes) json["mesh_planes"][mesh.mesh] = mesh.planes;
  json["free_face"] =
      key.free_face == none
          ? Json()
          : Json{{"centre", face_centre(blocks, key.free_face)},
                 {"normal", blocks.face_normal[static_cast<std::size_t>(key.free_face)]}};
  if (key.mode == SlidingMode::rotation) json["rotation"] = rotation_json(key.rotations[0]);
  return json;
}

/// The least of some blocks that are not too small to be listed, 0 where nothing resists.
class LeastFactor {
 public:
  explicit LeastFactor(const KeyblockReport& report) : smallest_(report.smallest_block) {}
  void look_at(const Keyblock& key) {
    if (key.volume < smallest_) return;
    least_ = std::min(least_, std::isfinite(key.factor_of_safety) ? key.factor_of_safety : 0);
  }
  Json json() const { return std::isfinite(least_) ? Json(least_) : Json(); }

 private:
  Real smallest_, least_ = std::numeric_limits<Real>::infinity();
};

Json least_factors_of_batches(const KeyblockReport& report) {
  std::vector<LeastFactor> least(report.batches.size(), LeastFactor(report));
  for (const Keyblock& key : report.keyblocks)
    least[static_cast<std::size_t>(key.batch) - 1].look_at(key);
  Json list = Json::array();
  for (const LeastFactor& of_batch : least) list.push_back(of_batch.json());
  return list;
}

/// Of what moves first: at each stage before anything else has moved. Blocks of later batches move because those before them have gone.
Json least_factor_json(const KeyblockReport& report) {
  const auto is_first = [&](Index batch) {
    const auto b = static_cast<std::size_t>(batch) - 1;
    return b == 0 || report.batch_stage[b] != report.batch_stage[b - 1];
  };
  LeastFactor least(report);
  for (const Keyblock& key : report.keyblocks)
    if (is_first(key.batch)) least.look_at(key);
  for (const Keyblock& key : report.stable) least.look_at(key);
  return least.json();
}

Json support_totals_json(const BlockArrays& blocks, const KeyblockReport& report) {
  struct Sums {
    std::size_t blocks = 0;
    Real volume = 0, force = 0;
    void add(const Keyblock& key) { ++blocks, volume += key.volume, force += key.support_force; }
    Json json() const {
      return {{"keyblocks", blocks}, {"volume", volume}, {"support_force", force}};
    }
  } all, first, listed;
  for (const auto& key : report.keyblocks) {
    all.add(key);
    if (key.batch == 1) first.add(key);
    if (key.volume >= report.smallest_block) listed.add(key);
  }
  Sums below_target;
  for (const auto& key : report.stable) {
    if (key.support_force > 0) below_target.add(key);
  }
  const auto unexamined =
      std::count(report.block_class.begin(), report.block_class.end(), BlockClass::not_examined);
  return {
      {"blocks", blocks.block_count()},
      {"keyblocks", all.blocks},
      {"batches", report.batches},
      {"batch_stages", report.batch_stage},
      {"keyblock_volume", all.volume},
      {"support_force", all.force},
      {"first_batch", first.json()},
      {"listed", listed.json()},
      {"least_factor_of_safety", least_factor_json(report)},
      {"least_factors_of_batches", least_factors_of_batches(report)},
      {"below_target", {{"blocks", below_target.blocks}, {"support_force", below_target.force}}},
      {"further_batches", unexamined > 0 || report.groups_left ? "not_examined" : "none"}};
}

Json blocks_json(const KeyblockReport& report) {
  Json list = Json::array();
  for (std::size_t b = 0; b < report.block_class.size(); ++b)
    list.push_back(
        {{"id", b + 1}, {"class", class_name(report.block_class[b])}, {"batch", report.batch[b]}});
  return list;
}

}  // namespace

Json ids_json(const std::vector<Index>& blocks) {
  Json ids = Json::array();
  for (const Index b : blocks) ids.push_back(b + 1);
  return ids;
}

void add_support(Json& document, const Model& model, const BlockArrays& blocks,
                 const KeyblockReport& report, const SupportDesign& design, BlockList block_list) {
  document["totals"] = support_totals_json(blocks, report);
  auto& keys = document["keyblocks"] = Json::array();
  const BoltingReport* bolting = design.bolting ? &*design.bolting : nullptr;
  const auto add_to_last = [&](Json& list, const Keyblock& key, const BlockSupport* support) {
    add_spot_bolts(list.back(), key, model);
    if (support) add_block_support(list.back(), *bolting, *support);
  };
  for (std::size_t i = 0; i < report.keyblocks.size(); ++i) {
    keys.push_back(keyblock_json(report.keyblocks[i], blocks));
    add_to_last(keys, report.keyblocks[i], bolting ? &bolting->keyblocks[i] : nullptr);
  }
  auto& stable = document["stable"] = Json::array();
  for (const auto& [key, support] : staying_blocks(report, bolting)) {
    stable.push_back(keyblock_json(key, blocks));
    add_to_last(stable, key, support);
  }
  if (block_list == BlockList::whole) document["blocks"] = blocks_json(report);
  add_design(document, model, design);
  if (design.joint_stress)
    document["joint_stress"] = joint_stress_json(blocks, *design.joint_stress, block_list);
}

Json support_document(const DocumentHead& head, const Model& model, const BlockArrays& blocks,
                      const KeyblockReport& report, const SupportDesign& design,
                      BlockList block_list) {
  Json document = head_json(head);
  add_support(document, model, blocks, report, design, block_list);
  return document;
}

}  // namespace rockfold
