#include "src/run/contact_setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "src/base/vector.hpp"
#include "src/model/pair_law.hpp"

namespace rockfold {
namespace {

/// Share of a block by which a joint closes under its overburden. Points serve on while blocks move by no more.
constexpr Real wanted_closure = 1e-5;
/// Of the blocks' size: how near surfaces have points, so that what closes within a step is mostly there before it …
constexpr Real reach_of_size = 0.02;
/// … and how far vertices may go before boxes are sorted again, twice over.
constexpr Real skin_of_size = 0.1;

Real tangent(Real degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

/// m: the cube root of the mean volume.
Real size_of(const BlockArrays& blocks) {
  const Real volume = std::accumulate(blocks.volume.begin(), blocks.volume.end(), Real{0});
  return std::cbrt(volume / static_cast<Real>(blocks.block_count()));
}

/// Pa: ρ g H of all blocks.
Real overburden(const Model& model, const BlockArrays& blocks) {
  const Real volume = std::accumulate(blocks.volume.begin(), blocks.volume.end(), Real{0});
  const Real mass = std::accumulate(blocks.mass.begin(), blocks.mass.end(), Real{0});
  const Real g = norm(model.gravity);
  if (!(g > 0)) return 0;
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const Vec3& x : blocks.vertex) {
    const Real height = -dot(x, model.gravity) / g;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return mass / volume * g * (high - low);
}

JointLaw law_of(const JointMaterial& m, Real stiffness) {
  JointLaw law;
  law.normal_stiffness = m.normal_stiffness.value_or(stiffness);
  law.shear_stiffness = m.shear_stiffness.value_or(law.normal_stiffness);
  law.friction = tangent(m.friction_angle);
  law.residual_friction = tangent(m.residual_friction_angle.value_or(m.friction_angle));
  law.cohesion = m.cohesion;
  law.residual_cohesion = m.residual_cohesion;
  law.tensile_strength = m.tensile_strength;
  law.dilation = tangent(m.dilation_angle);
  law.dilation_limit = m.dilation_limit;
  return law;
}

/// ContactOptions::law_of_pair.
std::vector<std::int16_t> laws_of_pairs(const Model& model) {
  std::vector<std::int16_t> law;
  const Index surfaces = surface_of_solid(model, static_cast<Index>(model.contact_solids.size()));
  for (Index one = none; one < surfaces; ++one)
    for (Index other = none; other < surfaces; ++other)
      law.push_back(
          static_cast<std::int16_t>(std::max<Index>(0, law_between(model, one, other).material)));
  return law;
}

/// No joint made them: [contact] material, where it is given, is that of them all.
Index of_free_faces(const Model& model, const Solid& solid) {
  return model.contact.material_given ? none : solid.interface;
}

/// The joint material of a surface, or none: of intact rock that came apart, of a solid without an interface.
Index own_material(const Model& model, Index surface) {
  const Index first = surface_of_solid(model, 0);
  if (surface >= first) return model.solids[model.contact_solids[surface - first]].interface;
  return surface == intact_law(model) ? none : surface;
}

}  // namespace

MetSurfaces law_between(const Model& model, Index one, Index other) {
  using By = MetSurfaces::By;
  const Index a = own_material(model, one), b = own_material(model, other);
  if (const Index said = paired_material(model, {one, a}, {other, b}); said != none)
    return {{one, other}, said, By::pair};
  if (a == none && b == none) {
    const By by = model.contact.material_given       ? By::given
                  : model.joint_materials.size() > 1 ? By::guess
                                                     : By::own;
    return {{one, other}, model.contact.material, by};
  }
  if (a == none || b == none || a == b) return {{one, other}, a == none ? b : a, By::own};
  return {{one, other}, weaker_material(model, std::min(a, b), std::max(a, b)), By::weaker};
}

std::vector<MetSurfaces> met_surfaces(const Model& model, const std::vector<std::uint8_t>& met) {
  std::vector<MetSurfaces> found;
  const Index surfaces = surface_of_solid(model, static_cast<Index>(model.contact_solids.size()));
  std::size_t place = 0;
  for (Index one = none; one < surfaces; ++one)
    for (Index other = none; other < surfaces; ++other, ++place) {
      const std::size_t mirror = (other + 1) * (surfaces + 1) + one + 1;
      if (one <= other && place < met.size() && (met[place] != 0 || met[mirror] != 0))
        found.push_back(law_between(model, one, other));
    }
  return found;
}

std::string surface_name(const Model& model, Index surface) {
  const Index first = surface_of_solid(model, 0);
  if (surface >= first) return model.solids[model.contact_solids[surface - first]].name;
  if (surface == intact_law(model)) return "broken rock";
  return surface == none ? "faces without a joint material" : model.joint_materials[surface].name;
}

FaceMaterials face_materials(const Model& model) {
  FaceMaterials materials{intact_law(model), {}, {}};
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    materials.of_solid.push_back(of_free_faces(model, model.solids[s]));
    materials.of_interface.push_back(interface_surface(model, static_cast<Index>(s)));
  }
  for (std::size_t k = 0; k < model.contact_solids.size(); ++k)
    materials.of_solid[model.contact_solids[k]] = surface_of_solid(model, static_cast<Index>(k));
  return materials;
}

Index intact_law(const Model& model) {
  return std::max<Index>(1, static_cast<Index>(model.joint_materials.size()));
}

ContactOptions contact_options(const Model& model, const BlockArrays& blocks) {
  const Real size = size_of(blocks);
  Real youngs_modulus = std::numeric_limits<Real>::infinity();
  for (const Material& m : model.materials)
    youngs_modulus = std::min(youngs_modulus, m.young_modulus);
  Real stiffness = youngs_modulus / size;
  if (const Real stress = overburden(model, blocks); stress > 0)
    stiffness = std::min(stiffness, stress / (wanted_closure * size));
  ContactOptions options;
  for (const JointMaterial& m : model.joint_materials) options.laws.push_back(law_of(m, stiffness));
  if (options.laws.empty()) options.laws.push_back(law_of({}, stiffness));  // smooth
  JointLaw intact = law_of({}, stiffness);
  intact.cohesion = intact.tensile_strength = std::numeric_limits<Real>::infinity();
  options.laws.push_back(intact);
  options.law_of_pair = laws_of_pairs(model);
  options.restitution = model.contact.restitution;
  options.search_distance = reach_of_size * size;
  options.skin = skin_of_size * size;
  options.still = wanted_closure * size;
  options.initial_stress = model.initial_stress;
  return options;
}

}  // namespace rockfold
