// Bolts, patterns and the search for one, as JSON.
#include "src/report/design_names.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/names.hpp"

namespace rockfold {

namespace {

constexpr Real degrees = 57.29577951308232;

Json crossing_json(const BoltingReport& bolting, const BoltCrossing& crossing) {
  return {{"bolt", bolt_name(bolting, crossing.bolt)},
          {"length_within", crossing.embedment.within},
          {"anchored_length", crossing.embedment.anchored},
          {"axial_capacity", crossing.axial_capacity},
          {"angle", crossing.force.angle * degrees},
          {"capacity", crossing.capacity},
          {"force", crossing.force.force},
          {"load", crossing.load},
          {"utilisation", 100 * crossing.force_mobilisation},
          {"mobilisation",
           {{"force", crossing.force_mobilisation},
            {"displacement", crossing.displacement_mobilisation}}}};
}

Json group_json(const BoltGroup& group) {
  const BoltType& type = group.type;
  Json json{{"name", group.name},
            {"kind", group.is_pattern ? "pattern" : "bolt"},
            {"bolts", group.bolts},
            {"coupling", coupling_name(type.coupling)},
            {"action", type.action == BoltAction::active ? "active" : "passive"},
            {"force_capacity", type.force_capacity},
            {"displacement_capacity", type.displacement_capacity}};
  if (!type.name.empty()) json["type"] = type.name;
  if (group.is_pattern) {
    json["on"] = group.on;
    json["wall_area"] = group.wall_area;
  }
  return json;
}

Json bolt_json(const BoltingReport& bolting, Index id) {
  const Bolt& bolt = bolting.bolts[id];
  const BoltType& type = bolting.groups[bolt.group].type;
  Json crossed = Json::array();
  for (const RockSegment& segment : bolt.rock)
    crossed.push_back({{"block", segment.block + 1}, {"from", segment.from}, {"to", segment.to}});
  return {{"name", bolt_name(bolting, id)},
          {"collar", bolt.collar},
          {"direction", bolt.direction},
          {"length", bolt.length},
          {"category", category_name(bolt_category(type, bolt.length))},
          {"rock", crossed}};
}

Json trial_json(const PatternTrial& trial, const Model& model, const char* weight) {
  return {{"type", model.bolt_types[trial.type].name},
          {"spacing", trial.spacing},
          {"length", trial.length},
          {"bolts", trial.bolts},
          {weight, trial.weight},
          {"held", trial.held},
          {"disturbed", trial.disturbed},
          {"least_factor_of_safety", trial.least_factor_of_safety}};
}

Json search_json(const PatternSearchReport& search, const Model& model) {
  const char* weight = search.by_mass ? "mass" : "length_times_capacity";
  Json json{{"key_blocks", search.wanted},
            {"patterns", search.patterns},
            {"best", nullptr},
            {"nearest", nullptr},
            {"not_held", ids_json(search.not_held)},
            {"disturbed", ids_json(search.disturbed)}};
  if (search.best != none) json["best"] = trial_json(search.trials[search.best], model, weight);
  if (search.nearest != none)
    json["nearest"] = trial_json(search.trials[search.nearest], model, weight);
  auto& tried = json["tried"] = Json::array();
  for (const PatternTrial& trial : search.trials) tried.push_back(trial_json(trial, model, weight));
  return json;
}

}  // namespace

void add_block_support(Json& keyblock, const BoltingReport& bolting, const BlockSupport& support) {
  auto& bolts = keyblock["bolts"] = Json::array();
  for (const BoltCrossing& crossing : support.crossings)
    bolts.push_back(crossing_json(bolting, crossing));
  keyblock["mobilisation"] = {{"force", support.force_mobilisation},
                              {"displacement", support.displacement_mobilisation}};
  keyblock["utilisation"] = nullptr;  // of no bolts
  if (!support.crossings.empty()) keyblock["utilisation"] = 100 * support.force_mobilisation;
  if (support.shotcrete.edge > 0)
    keyblock["shotcrete"] = {{"edge", support.shotcrete.edge}, {"force", support.shotcrete.force}};
  keyblock["supported_factor_of_safety"] = support.held.factor_of_safety;
  keyblock["supported_mode"] = mode_name(support.mode);
  keyblock["adequate"] = support.held.adequate;
  keyblock["missing_force"] = support.held.missing_force;
}

void add_spot_bolts(Json& keyblock, const Keyblock& key, const Model& model) {
  if (model.bolt_types.empty()) return;
  auto& list = keyblock["spot_bolts"] = Json::array();
  for (const BoltType& type : model.bolt_types)
    list.push_back({{"type", type.name},
                    {"bolts", bolts_needed(key.support_force, type.force_capacity)},
                    {"spacing", square_spacing(type.force_capacity, key.support_pressure)}});
}

void add_design(Json& document, const Model& model, const SupportDesign& design) {
  if (design.bolting) {
    const BoltingReport& bolting = *design.bolting;
    document["bolting"] = {{"bolts", bolting.bolts.size()},
                           {"length", bolting.length},
                           {"adequate", bolting.adequate},
                           {"first_batch", bolting.first_batch},
                           {"first_batch_adequate", bolting.first_batch_adequate},
                           {"disturbed", ids_json(bolting.disturbed)}};
    auto& groups = document["bolting"]["groups"] = Json::array();
    for (const BoltGroup& group : bolting.groups) groups.push_back(group_json(group));
    auto& bolts = document["bolts"] = Json::array();
    for (std::size_t i = 0; i < bolting.bolts.size(); ++i)
      bolts.push_back(bolt_json(bolting, static_cast<Index>(i)));
  }
  if (design.search) document["pattern_search"] = search_json(*design.search, model);
  if (design.classification)
    document["classification"] = classification_json(*design.classification);
}

}  // namespace rockfold
