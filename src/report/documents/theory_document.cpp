#include "src/base/vector.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/names.hpp"

namespace rockfold {

namespace {

Json movement_json(const std::optional<Movement>& movement,
                   const std::vector<std::string>& planes) {
  if (!movement) return {{"mode", nullptr}, {"planes", Json::array()}, {"direction", nullptr}};
  return {{"mode", mode_name(movement->mode)},
          {"planes", planes},
          {"direction", movement->direction + Vec3{}},
          {"sliding_force", movement->sliding_force()},
          {"factor_of_safety", movement->factor_of_safety()}};
}

Json pyramid_json(const PyramidEntry& entry) {
  Json json{{"code", entry.code},
            {"exists", entry.exists},
            {"edges", entry.space.edges},
            {"solid_angle", entry.space.solid_angle},
            {"removable_from", entry.removable_from}};
  if (entry.exists) json.update(movement_json(entry.unit.movement, entry.unit.planes));
  json["key"] = entry.unit.key;
  return json;
}

Json block_json(const TheoryBlock& block) {
  Json json{{"code", block.code},
            {"key", block.key},
            {"volume", block.shape.volume},
            {"weight", block.weight},
            {"free_area", block.shape.free_area},
            {"joint_area", block.shape.joint_area}};
  json.update(movement_json(block.movement, block.planes));
  json["support_force"] = block.support_force;
  json["support_pressure"] = block.support_pressure;
  return json;
}

Json scan_json(const Scan& scan, bool tunnel) {
  const char* direction = tunnel ? "trend" : "dip_direction";
  const auto entry_json = [&](const ScanEntry& entry) {
    Json json{{direction, entry.direction}};
    if (tunnel) json["plunge"] = entry.plunge;
    json["key_blocks"] = entry.key_blocks;
    json["largest_volume"] = entry.largest_volume;
    json["support_force"] = entry.largest_support;
    json["support_pressure"] = entry.largest_pressure;
    return json;
  };
  Json entries = Json::array();
  for (const ScanEntry& entry : scan.entries) entries.push_back(entry_json(entry));
  return {{"best", entry_json(scan.entries[static_cast<std::size_t>(scan.best)])},
          {"worst", entry_json(scan.entries[static_cast<std::size_t>(scan.worst)])},
          {"entries", entries}};
}

Json probability_json(const Probability& p) {
  return {{"count", p.count}, {"value", p.value}, {"low", p.low}, {"high", p.high}};
}

Json distribution_json(const SampleDistribution& d) {
  Json quantiles = Json::array();
  for (const Quantile& q : d.quantiles)
    quantiles.push_back({{"level", q.level}, {"value", q.value}, {"low", q.low}, {"high", q.high}});
  return {{"count", d.count},         {"mean", d.mean},           {"mean_low", d.mean_low},
          {"mean_high", d.mean_high}, {"deviation", d.deviation}, {"least", d.least},
          {"greatest", d.greatest},   {"quantiles", quantiles}};
}

Json monte_carlo_json(const MonteCarloResult& result) {
  Json pyramids = Json::array();
  for (const PyramidProbability& p : result.pyramids)
    if (p.block.count > 0)
      pyramids.push_back({{"code", p.code},
                          {"block", probability_json(p.block)},
                          {"key", probability_json(p.key)},
                          {"volume", distribution_json(p.volume)}});
  return {{"realisations", result.realisations},
          {"seed", result.seed},
          {"length", result.length},
          {"reach", result.reach},
          {"probability_of_key_block", probability_json(result.key)},
          {"key_blocks", distribution_json(result.key_blocks)},
          {"largest_volume", distribution_json(result.largest_volume)},
          {"support_pressure", distribution_json(result.support_pressure)},
          {"support_force", distribution_json(result.support_force)},
          {"pyramids", pyramids}};
}

Json excavation_json(const ExcavationTheory& theory) {
  Json json{{"name", theory.name}};
  json[theory.tunnel ? "trend" : "dip_direction"] = theory.direction;
  if (theory.tunnel) json["plunge"] = theory.plunge;
  auto& blocks = json["blocks"] = Json::array();
  for (const TheoryBlock& block : theory.blocks) blocks.push_back(block_json(block));
  if (theory.scan) json["scan"] = scan_json(*theory.scan, theory.tunnel);
  if (theory.monte_carlo) json["monte_carlo"] = monte_carlo_json(*theory.monte_carlo);
  return json;
}

}  // namespace

Json theory_document(const DocumentHead& head, const TheoryReport& report) {
  Json document = head_json(head);
  auto& sets = document["joint_sets"] = Json::array();
  for (const TheorySet& set : report.sets)
    sets.push_back({{"name", set.name},
                    {"normal", set.upward},
                    {"friction", set.friction},
                    {"cohesion", set.cohesion}});
  auto& pyramids = document["pyramids"] = Json::array();
  for (const PyramidEntry& entry : report.pyramids) pyramids.push_back(pyramid_json(entry));
  document["tunnels"] = Json::array();
  document["slopes"] = Json::array();
  for (const ExcavationTheory& theory : report.excavations)
    document[theory.tunnel ? "tunnels" : "slopes"].push_back(excavation_json(theory));
  return document;
}

}  // namespace rockfold
