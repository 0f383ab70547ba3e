// [[material]] and [[joint_material]].
#include "src/model/draft.hpp"

namespace rockfold {

void read_materials(Draft& draft) {
  read_entries(draft, "material", [&](TableReader& in, Index number) {
    Material material;
    material.name = in.read_name(draft.materials, "material" + std::to_string(number));
    material.place = in.place();
    // Cutting needs none of these; what the other commands need, check_model knows.
    in.read("density", material.density, positive("kg/m3"), Need::optional);
    Range poisson = between(-1, 0.5, "0.5 would be incompressible, which these elements cannot be");
    poisson.low_open = poisson.high_open = true;
    const bool elastic = in.has("young_modulus") || in.has("poisson_ratio");
    const Need need = elastic ? Need::required : Need::optional;
    in.read("young_modulus", material.young_modulus, positive("Pa"), need);
    in.read("poisson_ratio", material.poisson_ratio, poisson, need);
    draft.model.materials.push_back(material);
  });
}

void read_joint_materials(Draft& draft) {
  read_entries(draft, "joint_material", [&](TableReader& in, Index number) {
    JointMaterial material;
    material.name = in.read_name(draft.joint_materials, "joint_material" + std::to_string(number));
    Range friction = between(0, 90, "deg");
    friction.high_open = true;
    in.read("friction_angle", material.friction_angle, friction);
    in.read("cohesion", material.cohesion, not_negative("Pa"), Need::optional);
    in.read("tensile_strength", material.tensile_strength, not_negative("Pa"), Need::optional);
    in.read("normal_stiffness", material.normal_stiffness, positive("Pa/m"));
    in.read("shear_stiffness", material.shear_stiffness, positive("Pa/m"));
    draft.model.joint_materials.push_back(material);
  });
}

}  // namespace rockfold
