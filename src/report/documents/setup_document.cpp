// What was computed, for the printed report: the model's materials, joints, conditions and analyses with their defaults filled in.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "host/files/load_files.hpp"
#include "host/keyblock/water/water.hpp"
#include "src/model/openings.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/drawings/stereonet.hpp"
#include "src/report/names.hpp"
#include "src/report/summaries/keyblock_words.hpp"

namespace rockfold {

namespace {

constexpr std::size_t most_joints = 100;  // single joints that the report lists

Json or_null(Real value, bool given) {
  return given ? Json(value) : Json(nullptr);
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json material_json(const Material& m) {
  Json json{{"name", m.name},
            {"density", or_null(m.density, m.density > 0)},
            {"young_modulus", or_null(m.young_modulus, m.young_modulus > 0)},
            {"poisson_ratio", or_null(m.poisson_ratio, m.young_modulus > 0)}};
  if (const auto* c = std::get_if<MohrCoulombStrength>(&m.strength))
    json["strength"] = {{"cohesion", c->cohesion},
                        {"friction_angle", c->friction_angle},
                        {"tensile_strength", c->tensile_strength}};
  if (const auto* h = std::get_if<HoekBrownStrength>(&m.strength))
    json["strength"] = {{"sigma_ci", h->sigma_ci}, {"m_b", h->m_b}, {"s", h->s}, {"a", h->a}};
  return json;
}

Json joint_material_json(const JointMaterial& m) {
  return {{"name", m.name},
          {"friction_angle", m.friction_angle},
          {"cohesion", m.cohesion},
          {"tensile_strength", m.tensile_strength},
          {"normal_stiffness", or_null(m.normal_stiffness)},
          {"shear_stiffness", or_null(m.shear_stiffness)},
          {"dilation_angle", m.dilation_angle},
          {"residual_friction_angle", m.residual_friction_angle.value_or(m.friction_angle)},
          {"residual_cohesion", m.residual_cohesion}};
}

Json plane_json(const Model& model, const NetPlane& plane, Index material) {
  return {{"name", plane.name},
          {"normal", plane.normal},
          {"dip", plane.dip},
          {"dip_direction", plane.dip_direction},
          {"material", material == none || model.joint_materials.empty()
                           ? ""
                           : model.joint_materials[material].name}};
}

Json distribution_json(const Distribution& d) {
  using Kind = Distribution::Kind;
  const char* kind = d.kind == Kind::constant      ? "constant"
                     : d.kind == Kind::exponential ? "exponential"
                     : d.kind == Kind::log_normal  ? "log_normal"
                                                   : "power_law";
  Json json{{"distribution", kind}};
  if (d.kind != Kind::power_law) json["mean"] = d.mean;
  if (d.kind == Kind::log_normal) json["standard_deviation"] = d.standard_deviation;
  if (d.kind == Kind::power_law) json["exponent"] = d.exponent;
  json["min"] = d.min;
  json["max"] = or_null(d.max, std::isfinite(d.max));
  return json;
}

Json random_json(const RandomSet& random) {
  Json json{{"seed", random.seed},
            {"fisher_kappa", or_null(random.fisher_kappa, std::isfinite(random.fisher_kappa))}};
  if (random.radius) json["radius"] = distribution_json(*random.radius);
  if (random.spacing) json["spacing"] = distribution_json(*random.spacing);
  if (random.p32) json["p32"] = *random.p32;
  if (random.p10) json["p10"] = *random.p10;
  if (random.count) json["count"] = *random.count;
  return json;
}

/// Sets, then single joints.
Json joints_json(const Model& model) {
  Json list = Json::array();
  for (const JointSet& set : model.joint_sets) {
    list.push_back(plane_json(model, net_plane(set.name, set.orientation), set.material));
    list.back()["kind"] = set.random ? "random set" : "set";
    list.back()["spacing"] = or_null(set.spacing, set.spacing > 0);
    list.back()["radius"] = or_null(set.radius);
    if (set.random) list.back()["random"] = random_json(*set.random);
  }
  for (std::size_t i = 0; i < std::min(model.joints.size(), most_joints); ++i) {
    const Joint& joint = model.joints[i];
    list.push_back(
        plane_json(model, net_plane(joint.name, joint.plane.orientation), joint.material));
    list.back()["kind"] = "joint";
    list.back()["spacing"] = nullptr;
    list.back()["radius"] = or_null(joint.radius);
  }
  return list;
}

const char* type_name(AnalysisType type) {
  switch (type) {
    case AnalysisType::static_:
      return "static";
    case AnalysisType::quasi_static:
      return "quasi-static";
    case AnalysisType::dynamic:
      return "dynamic";
  }
  return "";
}

Json analysis_json(const Model& model) {
  Json stages = Json::array();
  for (const AnalysisStage& stage : model.analysis->stages) {
    stages.push_back({{"name", stage.name},
                      {"type", type_name(stage.type)},
                      {"time_step", stage.time_step},
                      {"steps", stage.steps},
                      {"dynamic_ratio", stage.share_handed_on()}});
    if (stage.seismic) stages.back()["seismic"] = true;
  }
  Json json{{"stages", stages},
            {"kinematics", model.analysis->large() ? "large" : "small"},
            {"contact", has_contact(model)}};
  if (model.cover) {
    json["lattice"] = lattice_name(model.cover->lattice);
    json["spacing"] = model.cover->spacing;
    json["order"] = model.cover->order;
    json["joints"] = model.cover->joints == JointTreatment::welded ? "welded" : "separate";
  }
  return json;
}

Json water_json(const Water& water) {
  Json json{{"joints", water.joints},
            {"density", water.density},
            {"drains", is_drained(water)},
            {"law", water_law_name(law_of(water))}};
  if (const auto* constant = std::get_if<WaterPressure>(&water.level))
    json["pressure"] = constant->value;
  if (const auto* head = std::get_if<WaterHead>(&water.level)) json["head"] = head->elevation;
  if (const auto* table = std::get_if<WaterTable>(&water.level))
    json["table"] = {{"point", table->point}, {"normal", table->normal}};
  if (!water.course.empty()) {
    Json rows = Json::array();
    for (std::size_t row = 0; row < water.course.time.size(); ++row)
      rows.push_back({water.course.time[row], water.course.value[row][0]});
    json[std::holds_alternative<WaterHead>(water.level) ? "head_table" : "pressure_table"] = rows;
  }
  if (water.factor != 1) json["factor"] = water.factor;
  if (water.drained_at) json["drained_at"] = *water.drained_at;
  return json;
}

Json shotcrete_json(const Shotcrete& shotcrete) {
  Json on = Json::array();
  for (const WallFaces& faces : shotcrete.on) on.push_back(faces.name);
  return {{"on", on},
          {"thickness", shotcrete.thickness},
          {"shear_strength", shotcrete.shear_strength},
          {"adhesion_strength", or_null(shotcrete.adhesion_strength)}};
}

Json support_json(const Model& model) {
  const SupportSpec s = model.support.value_or(SupportSpec{});
  Json water = Json::array();
  for (const Water& w : model.waters) water.push_back(water_json(w));
  Json json{{"target_factor_of_safety", s.target_factor_of_safety},
            {"water_pressure", s.water_pressure},
            {"seismic_coefficient", s.seismic_coefficient},
            {"rotation", s.rotation},
            {"largest_group", s.largest_group},
            {"smallest_block", s.smallest_block},
            {"clamping", s.clamping},
            {"elastic_stress", has_elastic_joint_stress(model)},
            {"in_situ_stress", model.initial_stress.any},
            {"support_direction", or_null(s.support_direction)},
            {"pushed_out_within", pushed_out_within},
            {"water", water}};
  if (model.shotcrete) json["shotcrete"] = shotcrete_json(*model.shotcrete);
  return json;
}

}  // namespace

Json setup_json(const Model& model, bool with_support, bool with_run) {
  Json json{{"gravity", model.gravity}};
  auto& materials = json["materials"] = Json::array();
  for (const Material& m : model.materials) materials.push_back(material_json(m));
  auto& joint_materials = json["joint_materials"] = Json::array();
  for (const JointMaterial& m : model.joint_materials)
    joint_materials.push_back(joint_material_json(m));
  json["joints"] = joints_json(model);
  json["counts"] = {{"solids", model.solids.size()},
                    {"joint_sets", model.joint_sets.size()},
                    {"joints", model.joints.size()},
                    {"joint_meshes", model.joint_meshes.size()},
                    {"joint_tables", model.joint_tables.size()},
                    {"excavations", model.excavations.size()},
                    {"fixed", model.fixed.size()},
                    {"tractions", model.tractions.size()},
                    {"point_loads", model.point_loads.size()},
                    {"water", model.waters.size()}};
  auto& from_files = json["joint_files"] = Json::array();
  for (const JointMesh& mesh : model.joint_meshes)
    from_files.push_back({{"name", mesh.name},
                          {"kind", "mesh"},
                          {"triangles", mesh.surface ? mesh.surface->triangles.size() : 0}});
  for (const JointTable& table : model.joint_tables)
    from_files.push_back({{"name", table.name}, {"kind", "table"}, {"joints", table.rows.size()}});
  auto& files = json["files"] = Json::array();
  for (const std::string& file : files_named_by(model))
    files.push_back(std::filesystem::path(file).filename().string());
  if (with_support) json["support"] = support_json(model);
  if (with_run && model.analysis) json["analysis"] = analysis_json(model);
  return json;
}

}  // namespace rockfold
