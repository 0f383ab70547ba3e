#include "src/model/check_model.hpp"

#include <algorithm>
#include <set>

#include "src/model/openings.hpp"

namespace rockfold {

namespace {

/// 2^n joint pyramids are told of.
constexpr std::size_t largest_theory_sets = 10;

/// Behind what asks for contact.
const std::string contact_needs =
    ", which this analysis does not have: it needs cover.joints = \"separate\", cover.order = 0 or "
    "1, no cover.mixed, analysis.kinematics = \"large\" and no static analysis";

/// Collects what is missing; the parts below read as the list of needs.
class Needs {
 public:
  explicit Needs(const Model& model) : model_(model) {}

  void solid() {
    if (model_.solids.empty())
      missing("solid", "the model has no [[solid]]: there is nothing to cut");
  }

  /// Materials of the rock: solids that are added.
  void materials() {
    if (model_.materials.empty() && !model_.solids.empty())
      missing("material", "the model has no [[material]], which this command needs");
  }

  void densities() {
    for (const Index m : used_materials())
      if (model_.materials[m].density <= 0) of_material(m, "density", "must be > 0 (kg/m3)");
  }

  void elastic_constants() {
    for (const Index m : used_materials())
      if (model_.materials[m].young_modulus <= 0)
        of_material(m, "young_modulus", "must be > 0 (Pa)");
  }

  void joint_materials() {
    const bool no_joints = model_.joints.empty() && model_.joint_sets.empty() &&
                           model_.joint_meshes.empty() && model_.joint_tables.empty();
    if (model_.joint_materials.empty() && !no_joints)
      missing("joint_material",
              "the model has joints but no [[joint_material]], which this command needs");
  }

  void driving_force() {
    const bool water =
        (model_.support && model_.support->water_pressure > 0) || !model_.waters.empty();
    if (model_.gravity == Vec3{} && !water && model_.point_loads.empty() &&
        model_.tractions.empty())
      missing("gravity",
              "is zero and there is neither water_pressure nor a [[water]], [[traction]] or "
              "[[point_load]]: nothing drives the blocks");
  }

  /// In-situ stress clamps joints by how stiff they are.
  void joint_stiffness() {
    if (!model_.initial_stress.any) return;
    for (const auto& joint : model_.joint_materials)
      if (!joint.normal_stiffness || !joint.shear_stiffness)
        missing("joint_material",
                ("\"" + joint.name +
                 "\" has no normal_stiffness and shear_stiffness (Pa/m), which block theory under "
                 "[initial_stress] needs")
                    .c_str());
  }

  /// What the redistribution of in-situ stress asks for.
  void joint_stress() {
    if (!has_elastic_joint_stress(model_)) return;
    const std::string instead =
        ", which support.stress = \"elastic\" needs; \"far_field\" does without";
    for (const Index m : used_materials())
      if (model_.materials[m].young_modulus <= 0)
        of_material(m, "young_modulus", "must be > 0 (Pa)" + instead);
    const auto continues = [](const Solid& solid) {
      return solid.add && std::find(solid.continues.begin(), solid.continues.end(), true) !=
                              solid.continues.end();
    };
    if (std::none_of(model_.solids.begin(), model_.solids.end(), continues))
      missing(
          "solid.continues",
          ("no solid has any: there is no face beyond which the rock goes on" + instead).c_str());
  }

  void cover() {
    if (!model_.cover) missing("cover", "the model has no [cover], which this command needs");
  }

  void analysis() {
    if (!model_.analysis)
      missing("analysis", "the model has no [analysis], which this command needs");
  }

  void theory() {
    if (!model_.theory) {
      missing("block_theory", "the model has no [block_theory], which this command needs");
      return;
    }
    if (model_.joint_sets.empty())
      missing("joint_set", "the model has no [[joint_set]]: there is no block to speak of");
    if (model_.joint_sets.size() > largest_theory_sets)
      missing("joint_set", "there are more than 10 joint sets: too many joint pyramids to tell");
    const Index material = model_.theory->material;
    if (model_.materials.empty())
      missing("material", "the model has no [[material]], which this command needs");
    else if (material != none && model_.materials[material].density <= 0)
      of_material(material, "density", "must be > 0 (kg/m3)");
  }

  void something_fixed() {
    if (model_.analysis && model_.analysis->has(AnalysisType::static_) && model_.fixed.empty())
      missing("fixed",
              "a static analysis needs a [[fixed]]: nothing holds the rock, it is free to move "
              "along x, y and z "
              "and to turn about them");
  }

  /// What only a dynamic analysis, or one that goes on in time, can make use of.
  void loads_in_time() {
    if (!model_.analysis) return;
    const bool in_time = model_.analysis->has(AnalysisType::dynamic);
    if (!in_time && !model_.analysis->has(AnalysisType::quasi_static) && model_.base_acceleration)
      found_.push_back({model_.base_acceleration->place,
                        "has no use in a static analysis; must be type = \"dynamic\""});
    for (const AnalysisStage& stage : model_.analysis->stages)
      if (stage.seismic && !(model_.support && model_.support->seismic_coefficient != Vec3{}))
        found_.push_back(
            {{stage.place.file, stage.place.line, stage.place.column, stage.place.key + ".seismic"},
             "is true, but there is no support.seismic_coefficient to act"});
    if (in_time && model_.analysis->stages.front().type == AnalysisType::quasi_static)
      for (const InitialVelocity& start : model_.initial_velocities)
        found_.push_back({start.place,
                          "is a velocity at t = 0, of which the first step, quasi-static, leaves "
                          "nothing: must begin with a dynamic step"});
    if (in_time) return;
    for (const InitialVelocity& start : model_.initial_velocities)
      found_.push_back({start.place, "has no use without type = \"dynamic\""});
  }

  /// What explicit substeps ask for: one small mass matrix a block, and forces that a short step can follow.
  void scheme() {
    if (!model_.analysis || !model_.cover) return;
    for (const AnalysisStage& stage : model_.analysis->stages) {
      if (stage.scheme != Scheme::explicit_) continue;
      const Place place = key_of(stage.place, "scheme");
      if (stage.type == AnalysisType::static_)
        found_.push_back(
            {place, "is \"explicit\", which is for type = \"dynamic\" or \"quasi_static\""});
      if (model_.cover->lattice != LatticeKind::block || model_.cover->order == 0)
        found_.push_back({place,
                          "is \"explicit\", which is for block covers of order 1 or 2 "
                          "(cover.lattice = \"block\"): elsewhere no step is cheaper than an "
                          "implicit one"});
      if (!model_.analysis->large())
        found_.push_back({place, "is \"explicit\", which is for kinematics = \"large\""});
      if (model_.analysis->rayleigh_beta > 0)
        found_.push_back({place,
                          "is \"explicit\", which takes rayleigh = {alpha = …} alone: damping by "
                          "the stiffness would ask for far shorter substeps"});
    }
  }

  /// What [contact] and monitors of joints ask for.
  void contact() {
    if (!model_.analysis || !model_.cover) return;
    if (!has_contact(model_)) {
      for (const Monitor& monitor : model_.monitors)
        if (!monitor.joint.empty())
          found_.push_back({key_of(monitor.place, "joint"),
                            "records contact" + contact_needs + " (in \"" + monitor.name + "\")"});
      for (const AnalysisStage& step : model_.analysis->stages)
        if (step.excavate != 0)
          found_.push_back(
              {key_of(step.place, "excavate"), "takes rock out of contact" + contact_needs});
      if (model_.reduction)
        found_.push_back({model_.reduction->place, "is of joints in contact" + contact_needs});
      return;
    }
    if (model_.reduction) reduction();
    if (model_.contact.max_penetration > 0)
      found_.push_back({key_of(model_.contact.place, "max_penetration"),
                        "is not supported yet: penetration is what normal_stiffness makes of the "
                        "pressure; a stiffer joint_material has less"});
  }

  std::vector<Diagnostic> found() && { return std::move(found_); }

 private:
  /// What the search for a factor can tell rest by, and what it can reduce.
  void reduction() {
    const Place& place = model_.reduction->place;
    if (model_.analysis->stages.back().type != AnalysisType::dynamic)
      found_.push_back(
          {place,
           "needs an analysis that ends dynamically (analysis.type, or that of the last "
           "[[step]]): the speeds at its end tell whether the mass has come to rest"});
    const auto& joints = model_.joint_materials;
    if (std::none_of(joints.begin(), joints.end(), [](const JointMaterial& joint) {
          return joint.friction_angle > 0 || joint.cohesion > 0;
        }))
      found_.push_back(
          {place, "divides friction and cohesion of joints, but no [[joint_material]] has any"});
  }

  void missing(const char* key, const char* message) {
    found_.push_back({{model_.path, 1, 1, key}, message});
  }

  static Place key_of(Place place, const std::string& key) {
    place.key += "." + key;
    return place;
  }

  void of_material(Index m, const std::string& key, const std::string& expected) {
    Place place = model_.materials[m].place;
    place.key += "." + key;
    found_.push_back(
        {place, "is missing, " + expected + " (in \"" + model_.materials[m].name + "\")"});
  }

  std::set<Index> used_materials() const {
    std::set<Index> used;
    for (const auto& solid : model_.solids)
      if (solid.add && solid.material != none) used.insert(solid.material);
    return used;
  }

  const Model& model_;
  std::vector<Diagnostic> found_;
};

void add_rock_needs(Needs& needs) {
  needs.materials();
  needs.densities();
}

void add_support_needs(Needs& needs) {
  needs.joint_materials();
  needs.driving_force();
}

void add_theory_needs(Needs& needs) {
  needs.theory();
  needs.joint_materials();
  needs.driving_force();
}

void add_run_needs(Needs& needs) {
  needs.elastic_constants();
  needs.cover();
  needs.analysis();
  needs.something_fixed();
  needs.loads_in_time();
  needs.scheme();
  needs.contact();
}

}  // namespace

std::vector<Diagnostic> missing_for(const Model& model, Purpose purpose) {
  const bool run =
      purpose == Purpose::run || (purpose == Purpose::check && model.analysis.has_value());
  const bool support =
      purpose == Purpose::support || (purpose != Purpose::cut && model.support.has_value());
  Needs needs(model);
  if (purpose == Purpose::theory) {
    add_theory_needs(needs);
    return std::move(needs).found();
  }
  if (purpose == Purpose::check && model.theory) {
    add_theory_needs(needs);
    if (model.solids.empty()) return std::move(needs).found();
  }
  needs.solid();
  if (support || run) add_rock_needs(needs);
  if (support) add_support_needs(needs);
  if (purpose == Purpose::support) needs.joint_stiffness();
  if (support) needs.joint_stress();
  if (run) add_run_needs(needs);
  return std::move(needs).found();
}

void check_for(const Model& model, Purpose purpose) {
  auto missing = missing_for(model, purpose);
  if (!missing.empty()) throw Error(ErrorKind::model, std::move(missing));
}

}  // namespace rockfold
