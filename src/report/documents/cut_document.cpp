#include <numeric>

#include <nlohmann/json.hpp>

#include "src/report/documents/document_parts.hpp"
#include "src/report/documents/documents.hpp"

namespace rockfold {

namespace {

Json intent_json(const IntentReport& intent, Index vertices_identified) {
  return {{"planes_identified", intent.planes_identified},
          {"edges_identified", intent.edges_identified},
          {"corners_identified", intent.corners_identified},
          {"identified", intent.identified},
          {"slivers", intent.slivers},
          {"openings_closed", intent.openings_closed},
          {"vertices_identified", vertices_identified},
          {"doubts", intent.doubts},
          {"near_decisions", intent.doubts},
          {"near_planes", intent.near_planes}};
}

/// A block's own counts by id difference of the offset arrays.
Index count_of(const std::vector<Index>& begin, Index b) {
  return begin[b + 1] - begin[b];
}

Json totals_json(const CutTotals& totals, const BlockArrays& blocks) {
  const auto edges =
      std::accumulate(blocks.edge_count.begin(), blocks.edge_count.end(), std::int64_t{0});
  return {{"blocks", blocks.block_count()},
          {"faces", blocks.face_normal.size()},
          {"vertices", blocks.vertex.size()},
          {"edges", edges},
          {"volume", total_volume(blocks)},
          {"solid_volume", totals.solid_volume},
          {"joint_area", totals.joint_area},
          {"dangling_joint_area", totals.dangling_joint_area},
          {"cells", totals.cells}};
}

/// null where the model gives no materials, which cutting does not need.
Json material_name(const Model& model, Index material) {
  return material == none ? Json() : Json(model.materials[material].name);
}

Json specks_json(const SpeckReport& specks) {
  Json merged = Json::array();
  Real volume = 0;
  for (const Speck& speck : specks.merged) {
    volume += speck.volume;
    merged.push_back({{"id", speck.id + 1},
                      {"volume", speck.volume},
                      {"centroid", speck.centroid},
                      {"block", speck.block + 1}});
  }
  return {{"limit", specks.limit},
          {"count", specks.merged.size()},
          {"volume", volume},
          {"merged", std::move(merged)},
          {"left", ids_json(specks.left)}};
}

}  // namespace

void add_specks(Json& document, const CutTotals& totals) {
  if (totals.specks) document["specks"] = specks_json(*totals.specks);
}

void add_body_fit(Json& document, const Model& model) {
  if (!model.body_fit) return;
  const BodyFit& fit = *model.body_fit;
  document["bodies"] = {{"tolerance", fit.tolerance},
                        {"tolerance_from", fit.is_given ? "contact.tolerance" : "files"},
                        {"fitted", fit.bodies},
                        {"convex", fit.convex},
                        {"contacts", fit.contacts},
                        {"largest_move", fit.largest_move}};
}

Json block_json(const Model& model, const BlockArrays& blocks, const BlockStatistics& statistics,
                Index b) {
  const BlockShape& shape = statistics.shape[b];
  Json json{{"id", b + 1},
            {"volume", blocks.volume[b]},
            {"centroid", blocks.centroid[b]},
            {"faces", count_of(blocks.face_begin, b)},
            {"edges", blocks.edge_count[b]},
            {"vertices", count_of(blocks.vertex_begin, b)},
            {"convex", bool(blocks.convex[b])},
            {"shells", blocks.shell_count[b]},
            {"genus", blocks.genus[b]},
            {"finite", bool(blocks.finite[b])},
            {"material", material_name(model, blocks.material[b])},
            {"dead_end_area", blocks.dead_end_area.empty() ? 0.0 : blocks.dead_end_area[b]},
            {"stage", blocks.stage.empty() ? 0 : blocks.stage[b]},
            {"surface_area", shape.surface_area},
            {"alpha", shape.alpha},
            {"beta", shape.beta},
            {"aspect_ratio", shape.aspect_ratio}};
  if (!statistics.flags.empty()) json["flags"] = flags_json(statistics.flags[b]);
  return json;
}

Json cut_document_without_blocks(const DocumentHead& head, const CutTotals& totals,
                                 const BlockArrays& blocks, const RockMeasures& measures) {
  Json document = head_json(head);
  document["totals"] = totals_json(totals, blocks);
  document["intent"] = intent_json(totals.intent, blocks.vertices_identified);
  add_specks(document, totals);
  add_measures(document, measures);
  document["blocks"] = Json::array();
  return document;
}

Json cut_document(const DocumentHead& head, const Model& model, const CutTotals& totals,
                  const BlockArrays& blocks, const RockMeasures& measures) {
  Json document = cut_document_without_blocks(head, totals, blocks, measures);
  add_body_fit(document, model);
  for (Index b = 0; b < blocks.block_count(); ++b)
    document["blocks"].push_back(block_json(model, blocks, measures.blocks, b));
  return document;
}

}  // namespace rockfold
