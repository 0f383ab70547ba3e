// Rock that is excavated or subtracted: when, and what block theory takes the in-situ stress round it for.
#pragma once

#include <algorithm>

#include "src/model/model.hpp"

namespace rockfold {

inline bool has_openings(const Model& model) {
  return !model.excavations.empty() || std::any_of(model.solids.begin(), model.solids.end(),
                                                   [](const Solid& solid) { return !solid.add; });
}

/// Whether a step of the analysis takes rock away.
inline bool excavates_on_the_way(const Model& model) {
  return model.analysis &&
         std::any_of(model.analysis->stages.begin(), model.analysis->stages.end(),
                     [](const AnalysisStage& step) { return step.excavate != 0; });
}

/// Whether rock of a stage of excavation (0: of none) is there as the analysis begins.
inline bool is_there_at_first(const Model& model, Index stage) {
  const auto takes_it = [&](const AnalysisStage& step) { return step.excavate == stage; };
  return stage == 0 || (model.analysis && std::any_of(model.analysis->stages.begin(),
                                                      model.analysis->stages.end(), takes_it));
}

/// Whether the rock may stand for an elastic body that goes on: every solid's material has a Young's modulus, and some face continues.
inline bool has_elastic_body(const Model& model) {
  const auto goes_on = [](const Solid& solid) {
    return solid.add &&
           std::find(solid.continues.begin(), solid.continues.end(), true) != solid.continues.end();
  };
  const auto is_elastic = [&](const Solid& solid) {
    const auto known = static_cast<Index>(model.materials.size());
    return !solid.add || solid.material < 0 || solid.material >= known ||
           model.materials[solid.material].young_modulus > 0;
  };
  return std::any_of(model.solids.begin(), model.solids.end(), goes_on) &&
         std::all_of(model.solids.begin(), model.solids.end(), is_elastic);
}

/// Of a model that does not say: elastic where [initial_stress] meets an opening and the rock has what that needs.
inline JointStress usual_joint_stress(const Model& model) {
  return model.initial_stress.any && has_openings(model) && has_elastic_body(model)
             ? JointStress::elastic
             : JointStress::far_field;
}

/// Whether block theory takes in-situ stress as the openings redistribute it.
inline bool has_elastic_joint_stress(const Model& model) {
  return model.initial_stress.any && has_openings(model) && model.support &&
         model.support->stress == JointStress::elastic;
}

}  // namespace rockfold
