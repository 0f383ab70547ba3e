#include "host/classification/classification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real one_set = 20;  // deg: mean orientations closer than this are one joint set

Vec3 upward_normal(const Orientation& orientation) {
  if (const auto* n = std::get_if<Vec3>(&orientation)) return normalized(*n);
  const auto& dip = std::get<DipOrientation>(orientation);
  constexpr Real degree = std::numbers::pi / 180;
  const Real a = dip.dip * degree, b = dip.dip_direction * degree;
  return {std::sin(a) * std::sin(b), std::sin(a) * std::cos(b), std::cos(a)};
}

/// Sets of the model that look the same way, with their area per volume together.
struct Set {
  Vec3 normal{};
  Real p32 = 0;  ///< m²/m³
};

std::vector<Set> sets_in_rock(const RockMeasures& measures, const Model& model) {
  std::vector<Set> sets;
  const Real same = std::cos(one_set * std::numbers::pi / 180);
  for (const JointSet& joints : model.joint_sets) {
    const auto found =
        std::find_if(measures.intensities.begin(), measures.intensities.end(),
                     [&](const OriginIntensity& i) { return i.name == joints.name; });
    if (found == measures.intensities.end() || found->joints == 0) continue;
    const Vec3 normal = upward_normal(joints.orientation);
    const auto parallel = std::find_if(sets.begin(), sets.end(), [&](const Set& s) {
      return std::abs(dot(s.normal, normal)) >= same;
    });
    if (parallel == sets.end())
      sets.push_back({normal, found->p32});
    else
      parallel->p32 += found->p32;
  }
  return sets;
}

bool has_random_joints(const Model& model) {
  return !model.joints.empty() || !model.joint_meshes.empty() || !model.joint_tables.empty();
}

QReport q_report(const ClassificationSpec& spec, const MeasuredJointing& measured) {
  const QInput& input = *spec.q;
  QReport q;
  q.rqd_proposed = !input.rqd;
  q.jn_proposed = !input.jn;
  const Real location = input.location == QLocation::intersection ? 3
                        : input.location == QLocation::portal     ? 2
                                                                  : 1;
  q.parameters = {
      input.rqd.value_or(measured.rqd),
      location * input.jn.value_or(joint_set_number(measured.sets, measured.random_joints)),
      input.jr,
      input.ja,
      input.jw,
      input.srf};
  q.value = q_value(q.parameters);
  q.unsupported_span = unsupported_span(q.value, input.excavation_support_ratio);
  q.roof_pressure = q_roof_pressure(q.parameters);
  q.roof_pressure_simple = q_roof_pressure_simple(q.parameters);
  if (spec.span) {
    q.equivalent_span = *spec.span / input.excavation_support_ratio;
    q.needs_support = *spec.span > q.unsupported_span;
    q.roof_bolts = q_bolt_length(*spec.span, input.excavation_support_ratio);
  }
  if (spec.height) q.wall_bolts = q_bolt_length(*spec.height, input.excavation_support_ratio);
  return q;
}

RmrReport rmr_report(const ClassificationSpec& spec, const MeasuredJointing& measured,
                     Real unit_weight) {
  const RmrInput& input = *spec.rmr;
  RmrReport rmr;
  rmr.rqd_proposed = !input.rqd;
  rmr.spacing_proposed = !input.spacing;
  rmr.rqd = input.rqd.value_or(measured.rqd);
  rmr.spacing = input.spacing.value_or(measured.closest_spacing);
  rmr.ratings = {input.uniaxial_strength ? strength_rating(*input.uniaxial_strength)
                                         : point_load_rating(*input.point_load_index),
                 rqd_rating(rmr.rqd),
                 spacing_rating(rmr.spacing),
                 input.condition ? condition_rating(*input.condition) : input.condition_rating,
                 water_rating(input.groundwater),
                 orientation_rating(input.orientation, input.use)};
  for (const Real rating : rmr.ratings) rmr.value += rating;
  rmr.value = std::max(rmr.value, Real{0});
  rmr.number = rmr_class(rmr.value);
  rmr.stand_up = stand_up_time(rmr.number);
  rmr.support = rmr_support(rmr.number);
  rmr.deformation_modulus = deformation_modulus(rmr.value);
  if (spec.span) rmr.roof_pressure = unal_pressure(rmr.value, unit_weight, *spec.span);
  return rmr;
}

/// m: how far a block reaches behind the plane of its largest face that is no joint.
Real depth(const BlockArrays& blocks, Index block) {
  Index largest = none;
  for (Index f = blocks.face_begin[block]; f < blocks.face_begin[block + 1]; ++f) {
    if (blocks.origins[blocks.face_origin[f]].kind == FaceOrigin::Kind::joint) continue;
    if (largest == none || blocks.face_area[f] > blocks.face_area[largest]) largest = f;
  }
  if (largest == none) return 0;
  const Vec3& n = blocks.face_normal[largest];
  const Vec3& on =
      blocks.vertex[blocks.corner_vertex[blocks.corner_begin[blocks.loop_begin[largest]]]];
  Real deepest = 0;
  for (Index v = blocks.vertex_begin[block]; v < blocks.vertex_begin[block + 1]; ++v)
    deepest = std::max(deepest, dot(n, on - blocks.vertex[v]));
  return deepest;
}

BlockTheoryDemand demand_of(const BlockArrays& blocks, const KeyblockReport& keyblocks) {
  BlockTheoryDemand demand;
  Real area = 0;
  for (const Keyblock& key : keyblocks.keyblocks) {
    ++demand.keyblocks;
    demand.support_force += key.support_force;
    area += key.free_area;
    demand.largest_pressure = std::max(demand.largest_pressure, key.support_pressure);
    for (const Index block : key.members)
      if (const Real d = depth(blocks, block); d > demand.deepest)
        demand.deepest = d, demand.deepest_block = block;
  }
  if (area > 0) demand.mean_pressure = demand.support_force / area;
  return demand;
}

Real unit_weight(const BlockArrays& blocks, const Model& model) {
  Real mass = 0, volume = 0;
  for (Index b = 0; b < blocks.block_count(); ++b)
    mass += blocks.mass[b], volume += blocks.volume[b];
  return volume > 0 ? mass / volume * norm(model.gravity) : 0;
}

}  // namespace

MeasuredJointing measured_jointing(const RockMeasures& measures, const Model& model) {
  MeasuredJointing measured;
  measured.volumetric_joint_count = measures.volumetric_joint_count;
  measured.rqd = std::isfinite(measures.rqd)
                     ? 100 * measures.rqd
                     : std::clamp(110 - 2.5 * measures.volumetric_joint_count, Real{0}, Real{100});
  const auto sets = sets_in_rock(measures, model);
  measured.sets = static_cast<Index>(sets.size());
  measured.random_joints = has_random_joints(model);
  Real densest = 0;
  for (const Set& set : sets) densest = std::max(densest, set.p32);
  measured.closest_spacing = densest > 0 ? 1 / densest : std::numeric_limits<Real>::infinity();
  measured.block_size = measures.blocks.size_by_volume[2];  // D50
  return measured;
}

ClassificationReport classify(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                              const RockMeasures& measures, const Model& model) {
  const ClassificationSpec& spec = *model.classification;
  ClassificationReport report;
  report.measured = measured_jointing(measures, model);
  report.demand = demand_of(blocks, keyblocks);
  if (spec.q) report.q = q_report(spec, report.measured);
  if (spec.rmr) report.rmr = rmr_report(spec, report.measured, unit_weight(blocks, model));
  return report;
}

}  // namespace rockfold
