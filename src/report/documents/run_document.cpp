#include "src/base/vector.hpp"
#include "src/io/viewers/stress_measures.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/documents/met_surfaces.hpp"
#include "src/report/documents/settled.hpp"
#include "src/report/joint_strength.hpp"
#include "src/report/names.hpp"
#include "src/report/shaken_blocks.hpp"

namespace rockfold {

namespace {

Json run_totals_json(const RunReport& report) {
  const auto& covers = report.covers;
  return {{"blocks", report.blocks.block_count()},
          {"mathematical_covers", mathematical_covers(covers)},
          {"physical_covers", covers.cover_count()},
          {"elements", covers.element_count()},
          {"element_vertices", covers.element_vertices},
          {"element_faces", covers.element_faces},
          {"dof", 3 * std::int64_t{covers.unknown_count()}},
          {"steps", report.run.steps},
          {"time", report.run.time},
          {"interrupted", report.run.interrupted},
          {"largest_substeps", report.run.largest_substeps},
          {"divided_steps", report.run.divided_steps},
          {"largest_displacement", report.run.largest_displacement.length},
          {"largest_displacement_block", report.run.largest_displacement.block + 1},
          {"largest_displacement_point", report.run.largest_displacement.point},
          {"support_gap", report.run.support_gap}};
}

/// What a stress means for the rock; the strength ratio only of a material that has one.
void add_measures(Json& to, const Stress& stress, const Material* material) {
  to["principal_stress"] = principal_stresses(stress);
  to["von_mises"] = von_mises(stress);
  if (material && has_strength(*material)) to["strength_ratio"] = strength_ratio(stress, *material);
}

const Material* material_at(const Model& model, Index material) {
  return material == none ? nullptr : &model.materials[material];
}

Json monitor_json(const MonitorHistory& m, const RunReport& report) {
  Json json{{"name", m.name},
            {"time", m.time},
            {"displacement", m.displacement},
            {"velocity", m.velocity},
            {"acceleration", m.acceleration},
            {"stress", m.stress}};
  for (const Stress& stress : m.stress) {
    Json measures;
    add_measures(measures, stress, material_at(report.model, m.material));
    for (const auto& [name, value] : measures.items()) json[name].push_back(value);
  }
  const auto& base = report.run.base;
  for (std::size_t i = 0; i < base.size(); ++i) {
    json["absolute_displacement"].push_back(m.displacement[i] + base[i].displacement);
    json["absolute_velocity"].push_back(m.velocity[i] + base[i].velocity);
    json["absolute_acceleration"].push_back(m.acceleration[i] + base[i].acceleration);
  }
  return json;
}

Json joint_monitor_json(const JointHistory& m) {
  Json json{{"name", m.name},
            {"joint", m.joint},
            {"time", m.time},
            {"normal_stress", m.normal_stress},
            {"shear_stress", m.shear_stress},
            {"opening", m.opening},
            {"slip", m.slip},
            {"state", Json::array()}};
  for (const Contact state : m.state) json["state"].push_back(contact_name(state));
  return json;
}

/// In the order of the model.
Json monitors_json(const RunReport& report) {
  Json list = Json::array();
  auto rock = report.run.monitors.begin();
  auto joint = report.run.joint_monitors.begin();
  for (const Monitor& monitor : report.model.monitors)
    list.push_back(monitor.is_of_rock() ? monitor_json(*rock++, report)
                                        : joint_monitor_json(*joint++));
  return list;
}

Json largest_json(const LargestAtJoint& largest, const RunReport& report) {
  if (largest.block[0] == none) return nullptr;
  return {{"value", largest.value},
          {"joint", joint_name(report.blocks, largest.joint)},
          {"blocks", {largest.block[0] + 1, largest.block[1] + 1}}};
}

Json rest_json(const RunReport& report) {
  const Rest& rest = *report.run.rest;
  return {{"moved_blocks", rest.moved},
          {"largest_slip", largest_json(rest.slip, report)},
          {"largest_opening", largest_json(rest.opening, report)},
          {"speed", rest.speed},
          {"at_rest", rest.at_rest},
          {"since", rest.since}};
}

Json blocks_json(const RunReport& report) {
  Json list = Json::array();
  for (std::size_t b = 0; b < report.run.blocks.size(); ++b) {
    const BlockMotion& motion = report.run.blocks[b];
    Json block{{"id", b + 1},
               {"displacement", motion.displacement},
               {"rotation", motion.rotation},
               {"volume", motion.volume},
               {"stress", report.run.block_stress[b]}};
    if (!report.run.gone.empty()) block["excavated"] = report.run.gone[b] != 0;
    add_measures(block, report.run.block_stress[b],
                 material_at(report.model, report.blocks.material[b]));
    list.push_back(std::move(block));
  }
  return list;
}

/// null where no rock has a strength.
Json strength_json(const RockStrength& strength) {
  if (strength.block == none) return nullptr;
  return {{"least_ratio", strength.least_ratio},
          {"block", strength.block + 1},
          {"point", strength.point},
          {"failed_volume", strength.failed_volume}};
}

Json energy_json(const Energy& e) {
  return {{"kinetic", e.kinetic},   {"strain", e.strain},         {"potential", e.potential},
          {"contact", e.contact},   {"dissipated", e.dissipated}, {"damping", e.damping},
          {"quiet", e.quiet},       {"ratio", e.ratio},           {"friction", e.friction},
          {"impact", e.impact},     {"numerical", e.numerical},   {"loads", e.loads},
          {"supports", e.supports}, {"excavated", e.excavated},   {"bolts", e.bolts}};
}

/// Rock that steps take away: how what it had pressed its walls with was let go before they went on.
Json excavation_json(const RunReport& report) {
  const auto& stages = report.model.analysis->stages;
  Json excavation{{"walls", report.run.walls}, {"settled", Json::array()}};
  for (const Settled& s : report.run.settled)
    excavation["settled"].push_back(settled_json(s, stages[s.stage]));
  if (const auto& settling = report.run.settling)
    excavation["settling"] = settling_json(*settling, stages[settling->stage]);
  return excavation;
}

Json contacts_json(const RunReport& report) {
  const RunResult& run = report.run;
  const ContactCount& c = run.contacts;
  const Rest rest = run.rest.value_or(Rest{});
  Json contacts{{"open", c.open},
                {"stick", c.stick},
                {"slide", c.slide},
                {"max_penetration", c.largest_penetration},
                {"max_opening", rest.opening.value},
                {"max_slip", rest.slip.value}};
  if (!run.met.empty()) contacts["met"] = met_json(report.model, run.met);
  return contacts;
}

Json contacts_history_json(const RunResult& run) {
  const ContactHistory& h = run.contact_history;
  return {{"time", h.open.empty() ? std::vector<Real>{} : run.energy_time},
          {"open", h.open},
          {"stick", h.stick},
          {"slide", h.slide},
          {"iterations", h.iterations},
          {"substeps", h.substeps}};
}

/// A list over time for each part of the energy.
Json energy_history_json(const RunResult& run) {
  Json history{{"time", run.energy_time}};
  for (const Energy& energy : run.energies) {
    const Json parts = energy_json(energy);
    for (const auto& [name, value] : parts.items()) history[name].push_back(value);
  }
  return history;
}

Json trials_json(const Reduction& reduction) {
  Json trials = Json::array();
  for (const ReductionTrial& t : reduction.trials)
    trials.push_back(
        {{"factor", t.factor}, {"stands", t.stands}, {"time", t.time}, {"speed", t.speed}});
  return trials;
}

Json or_null(const std::optional<Real>& value) {
  return value ? Json(*value) : Json();
}

Json reduction_json(const RunReport& report) {
  const Reduction& reduction = *report.reduction;
  Json blocks = Json::array(), weaker = Json::array();
  for (const JointMaterial* m : materials_that_lose_strength(report.model, report.blocks))
    weaker.push_back(m->name);
  if (reduction.fails())
    for (const Index b : failing_blocks(report.model, report.blocks, report.run))
      blocks.push_back(b + 1);
  return {{"factor", or_null(reduction.factor())},
          {"stands", or_null(reduction.stands())},
          {"fails", or_null(reduction.fails())},
          {"blocks", blocks},
          {"shown", reduction.shown()},
          {"trials", trials_json(reduction)},
          {"loses_strength", weaker}};
}

Json reactions_json(const std::vector<Reaction>& conditions) {
  Json list = Json::array();
  for (std::size_t n = 0; n < conditions.size(); ++n)
    list.push_back(
        {{"fixed", n + 1}, {"force", conditions[n].force}, {"moment", conditions[n].moment}});
  return list;
}

Vec3 sum_of_forces(const std::vector<Reaction>& conditions) {
  Vec3 total{};
  for (const auto& condition : conditions) total += condition.force;
  return total;
}

/// Why steps are explicit.
Json reason(const BySubsteps& by) {
  if (by.failed != 0) return {{"asked", false}, {"failed", true}};
  if (by.iterated == 0) return {{"asked", true}};
  return {{"asked", false}, {"iterations", by.iterated}, {"substeps", by.instead}};
}

Json substeps_json(const RunReport& report) {
  Json list = Json::array();
  for (const BySubsteps& by : report.run.by_substeps)
    list.push_back({{"step", report.model.analysis->stages[by.stage].name},
                    {"first", by.first},
                    {"steps", by.steps},
                    {"substeps", by.substeps},
                    {"visits", by.visits},
                    {"shortest", by.shortest},
                    {"added_mass", by.added_mass},
                    {"because", reason(by)}});
  return list;
}

Json bolts_json(const std::vector<BoltResult>& bolts) {
  Json list = Json::array();
  for (const BoltResult& bolt : bolts)
    list.push_back({{"name", bolt.name},
                    {"collar", bolt.collar},
                    {"direction", bolt.direction},
                    {"length", bolt.length},
                    {"state", bolt.installed ? bolt_status_name(bolt.status) : "not installed"},
                    {"force", bolt.force},
                    {"shear", bolt.shear},
                    {"plate", bolt.plate},
                    {"peak", bolt.peak},
                    {"mobilisation", bolt.mobilisation},
                    {"broken_at", bolt.broken_at ? Json(*bolt.broken_at) : Json()},
                    {"along", {{"at", bolt.at}, {"force", bolt.along}}}});
  return list;
}

}  // namespace

Index mathematical_covers(const CoverArrays& covers) {
  Index nodes = 0;
  for (std::size_t p = 0; p < covers.cover_node.size(); ++p)
    nodes += p == 0 || covers.cover_node[p] != covers.cover_node[p - 1];
  return nodes;
}

bool has_confirmed(const RunReport& report) {
  return report.keyblocks && report.run.rest && !report.reduction;
}

Json run_document(const DocumentHead& head, const RunReport& report, BlockList list) {
  Json document = head_json(head);
  document["totals"] = run_totals_json(report);
  document["monitors"] = monitors_json(report);
  document["energy"] = energy_json(report.run.energy);
  document["energy_history"] = energy_history_json(report.run);
  document["contacts"] = contacts_json(report);
  document["contacts_history"] = contacts_history_json(report.run);
  if (report.run.rest) document["rest"] = rest_json(report);
  if (const auto& water = report.run.water)
    document["water"] = {{"area", water->area},
                         {"largest_pressure", water->largest_pressure},
                         {"force", water->force},
                         {"whole_force", water->whole_force}};
  if (!report.run.bolts.empty()) document["bolts"] = bolts_json(report.run.bolts);
  if (const auto& shotcrete = report.run.shotcrete)
    document["shotcrete"] = {{"length", shotcrete->length},
                             {"yielding", shotcrete->yielding},
                             {"broken", shotcrete->broken},
                             {"force", shotcrete->force},
                             {"mobilisation", shotcrete->mobilisation}};
  if (!report.run.gone.empty()) document["excavation"] = excavation_json(report);
  if (const auto& unbalanced = report.run.unbalanced)
    document["unbalanced"] = {
        {"share", unbalanced->share},
        {"block", unbalanced->block == none ? Json() : Json(unbalanced->block + 1)},
        {"force", unbalanced->force}};
  document["reaction"] = sum_of_forces(report.run.conditions);
  document["reactions"] = reactions_json(report.run.conditions);
  document["strength"] = strength_json(report.run.strength);
  if (list == BlockList::whole) document["blocks"] = blocks_json(report);
  if (report.keyblocks)
    add_support(document["support"] = Json::object(), report.model, report.blocks,
                *report.keyblocks, *report.design, list);
  if (has_confirmed(report)) document["confirmed"] = confirmed_json(report);
  if (is_shaken(report)) document["shaken"] = shaken_json(report);
  if (report.reduction) document["reduction"] = reduction_json(report);
  if (!report.run.by_substeps.empty()) document["substeps"] = substeps_json(report);
  document["iterations"] = {{"pcg", report.run.iterations.pcg},
                            {"open_close", report.run.iterations.open_close},
                            {"fallbacks", report.run.iterations.fallbacks},
                            {"preconditioner", preconditioner_name(report.run.preconditioner)}};
  return document;
}

Json search_document(const DocumentHead& head, const Reduction& reduction) {
  Json document = head_json(head);
  document["totals"] = {{"interrupted", true}};
  document["reduction"] = {{"factor", nullptr},
                           {"stands", or_null(reduction.stands())},
                           {"fails", or_null(reduction.fails())},
                           {"trials", trials_json(reduction)}};
  return document;
}

}  // namespace rockfold
