// [[material]] and [[joint_material]].
#include <cmath>
#include <numbers>

#include "src/model/read/draft.hpp"

namespace rockfold {

namespace {

constexpr Real radians = std::numbers::pi / 180;

void read_mohr_coulomb(TableReader& in, Material& material) {
  MohrCoulombStrength strength;
  Range friction = between(0, 90, "deg");
  friction.high_open = true;
  const bool cohesion = in.read("cohesion", strength.cohesion, not_negative("Pa"));
  const bool angle = in.read("friction_angle", strength.friction_angle, friction);
  const bool tension =
      in.read("tensile_strength", strength.tensile_strength, not_negative("Pa"), Need::optional);
  if (!cohesion || !angle) return;
  const Real slope = std::tan(strength.friction_angle * radians);
  const Real apex = slope > 0 ? strength.cohesion / slope : largest_number;
  if (tension && strength.tensile_strength > apex)
    in.wrong("tensile_strength", "found " + number_text(strength.tensile_strength) +
                                     ", must be at most cohesion / tan(friction_angle) = " +
                                     number_text(apex) + " (Pa)");
  if (!in.has("tensile_strength")) strength.tensile_strength = apex;
  material.strength = strength;
}

/// From the geological strength index and the disturbance (Hoek, Carranza-Torres & Corkum 2002).
void reduce(HoekBrownStrength& strength, Real m_i, Real gsi, Real d) {
  strength.m_b = m_i * std::exp((gsi - 100) / (28 - 14 * d));
  strength.s = std::exp((gsi - 100) / (9 - 3 * d));
  strength.a = 0.5 + (std::exp(-gsi / 15) - std::exp(-20.0 / 3)) / 6;
}

void read_hoek_brown(TableReader& entry, Material& material) {
  TableReader in(*entry.find("hoek_brown"), entry.path_of("hoek_brown"), entry.out());
  HoekBrownStrength strength;
  Real m_i = 0, gsi = 100, d = 0;
  in.read("sigma_ci", strength.sigma_ci, positive("Pa"));
  if (in.has("m_b") == in.has("m_i"))
    in.missing({"m_i", "m_b"}, "must have m_i (intact rock), or m_b (rock mass), not both");
  in.read("m_i", m_i, between(1, 50, ""), Need::optional);
  in.read("m_b", strength.m_b, positive(""), Need::optional);
  in.read("GSI", gsi, between(1, 100, ""), Need::optional);
  in.read("D", d, between(0, 1, ""), Need::optional);
  if (m_i > 0) reduce(strength, m_i, gsi, d);
  in.read("s", strength.s, between(0, 1, ""), Need::optional);
  in.read("a", strength.a, between(0.5, 1, ""), Need::optional);
  const bool index = in.has("GSI") || in.has("D");
  for (const char* key : {"m_b", "s", "a"})
    if (index && in.has(key))
      in.wrong(key, std::string("GSI and D say what ") + key + " is: give one or the other");
  if (strength.sigma_ci > 0 && strength.m_b > 0) material.strength = strength;
}

void read_strength(TableReader& in, Material& material) {
  const bool hoek_brown = in.has("hoek_brown");
  const bool mohr_coulomb =
      in.has("cohesion") || in.has("friction_angle") || in.has("tensile_strength");
  if (hoek_brown && mohr_coulomb)
    in.wrong("hoek_brown", "give one strength: either cohesion and friction_angle, or hoek_brown");
  if (mohr_coulomb) read_mohr_coulomb(in, material);
  if (hoek_brown) read_hoek_brown(in, material);
}

/// A part of the strength that may be smaller, not larger, than the whole under `key_of_most`.
void require_at_most(TableReader& in, const char* key, Real found, const char* key_of_most,
                     Real most, const char* unit) {
  if (found > most)
    in.wrong(key, "found " + number_text(found) + ", must be at most " + key_of_most + " = " +
                      number_text(most) + " (" + unit + ")");
}

/// What is left of the strength after the first slip: without these keys all of it (docs/decisions/0021-strength-after-slip.md).
void read_residual_strength(TableReader& in, JointMaterial& material, bool angle, bool cohesion) {
  Range friction = between(0, 90, "deg");
  friction.high_open = true;
  if (in.read("residual_friction_angle", material.residual_friction_angle, friction) && angle)
    require_at_most(in, "residual_friction_angle", *material.residual_friction_angle,
                    "friction_angle", material.friction_angle, "deg");
  material.residual_cohesion = material.cohesion;
  if (in.read("residual_cohesion", material.residual_cohesion, not_negative("Pa"),
              Need::optional) &&
      cohesion)
    require_at_most(in, "residual_cohesion", material.residual_cohesion, "cohesion",
                    material.cohesion, "Pa");
}

/// Dilation steeper than friction would give slip energy instead of taking it.
void read_dilation(TableReader& in, JointMaterial& material, bool angle) {
  Range dilation = between(0, 90, "deg");
  dilation.high_open = true;
  if (in.read("dilation_angle", material.dilation_angle, dilation, Need::optional) && angle)
    require_at_most(in, "dilation_angle", material.dilation_angle, "friction_angle",
                    material.friction_angle, "deg");
  in.read("dilation_limit", material.dilation_limit, length(), Need::optional);
  if (in.has("dilation_limit") && !in.has("dilation_angle"))
    in.wrong("dilation_limit", "belongs to dilation, but there is no dilation_angle");
}

}  // namespace

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
    read_strength(in, material);
    draft.model.materials.push_back(material);
  });
}

void read_joint_materials(Draft& draft) {
  read_entries(draft, "joint_material", [&](TableReader& in, Index number) {
    JointMaterial material;
    material.name = in.read_name(draft.joint_materials, "joint_material" + std::to_string(number));
    material.place = in.place();
    Range friction = between(0, 90, "deg");
    friction.high_open = true;
    const bool angle = in.read("friction_angle", material.friction_angle, friction);
    const bool cohesion =
        in.read("cohesion", material.cohesion, not_negative("Pa"), Need::optional) ||
        !in.has("cohesion");
    in.read("tensile_strength", material.tensile_strength, not_negative("Pa"), Need::optional);
    in.read("normal_stiffness", material.normal_stiffness, positive("Pa/m"));
    in.read("shear_stiffness", material.shear_stiffness, positive("Pa/m"));
    read_dilation(in, material, angle);
    read_residual_strength(in, material, angle, cohesion);
    draft.model.joint_materials.push_back(material);
  });
}

}  // namespace rockfold
