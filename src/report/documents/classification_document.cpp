// Q, RMR and what block theory asks for, as JSON.
#include "src/report/design_names.hpp"
#include "src/report/documents/document_parts.hpp"

namespace rockfold {

namespace {

/// null where the model does not say enough.
template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json q_json(const QReport& q) {
  const QParameters& p = q.parameters;
  Json proposed = Json::array();
  if (q.rqd_proposed) proposed.push_back("rqd");
  if (q.jn_proposed) proposed.push_back("jn");
  return {{"rqd", p.rqd},
          {"jn", p.jn},
          {"jr", p.jr},
          {"ja", p.ja},
          {"jw", p.jw},
          {"srf", p.srf},
          {"proposed", proposed},
          {"value", q.value},
          {"class", q_class(q.value)},
          {"unsupported_span", q.unsupported_span},
          {"equivalent_span", or_null(q.equivalent_span)},
          {"needs_support", or_null(q.needs_support)},
          {"roof_bolt_length", or_null(q.roof_bolts)},
          {"wall_bolt_length", or_null(q.wall_bolts)},
          {"roof_pressure", q.roof_pressure},
          {"roof_pressure_three_sets", q.roof_pressure_simple},
          {"rmr_bieniawski", rmr_from_q_bieniawski(q.value)},
          {"rmr_barton", rmr_from_q_barton(q.value)}};
}

Json support_json(const RmrSupport& support) {
  return {
      {"excavation", support.excavation},           {"bolts", support.bolts},
      {"bolt_length", support.bolt_length},         {"bolt_spacing", support.bolt_spacing},
      {"shotcrete_crown", support.shotcrete_crown}, {"shotcrete_walls", support.shotcrete_walls},
      {"shotcrete_face", support.shotcrete_face},   {"rib_spacing", support.rib_spacing}};
}

Json rmr_json(const RmrReport& rmr) {
  Json ratings = Json::object();
  for (std::size_t i = 0; i < rmr.ratings.size(); ++i) ratings[rmr_parameters[i]] = rmr.ratings[i];
  Json proposed = Json::array();
  if (rmr.rqd_proposed) proposed.push_back("rqd");
  if (rmr.spacing_proposed) proposed.push_back("spacing");
  const auto row = static_cast<std::size_t>(rmr.number - 1);
  return {{"ratings", ratings},
          {"rqd", rmr.rqd},
          {"spacing", rmr.spacing},
          {"proposed", proposed},
          {"value", rmr.value},
          {"class", rmr_classes[row]},
          {"rock", rmr_rock[row]},
          {"stand_up",
           {{"span", rmr.stand_up.span}, {"time", rmr.stand_up.time}, {"text", rmr.stand_up.text}}},
          {"support_10_m_span", support_json(rmr.support)},
          {"roof_pressure", or_null(rmr.roof_pressure)},
          {"deformation_modulus", rmr.deformation_modulus}};
}

}  // namespace

Json classification_json(const ClassificationReport& report) {
  const MeasuredJointing& measured = report.measured;
  const BlockTheoryDemand& demand = report.demand;
  Json json{{"cut_model",
             {{"rqd", measured.rqd},
              {"volumetric_joint_count", measured.volumetric_joint_count},
              {"joint_sets", measured.sets},
              {"random_joints", measured.random_joints},
              {"closest_spacing", measured.closest_spacing},
              {"block_size", measured.block_size}}}};
  if (report.q) json["q"] = q_json(*report.q);
  if (report.rmr) json["rmr"] = rmr_json(*report.rmr);
  json["block_theory"] = {{"keyblocks", demand.keyblocks},
                          {"support_force", demand.support_force},
                          {"largest_pressure", demand.largest_pressure},
                          {"mean_pressure", demand.mean_pressure},
                          {"deepest", demand.deepest}};
  if (demand.deepest_block != none)
    json["block_theory"]["deepest_block"] = demand.deepest_block + 1;
  return json;
}

}  // namespace rockfold
