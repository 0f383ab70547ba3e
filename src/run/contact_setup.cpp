#include "src/run/contact_setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "src/base/vector.hpp"

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

}  // namespace

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
  options.material = std::max(model.contact.material, 0);
  options.restitution = model.contact.restitution;
  options.search_distance = reach_of_size * size;
  options.skin = skin_of_size * size;
  options.still = wanted_closure * size;
  options.initial_stress = model.initial_stress;
  return options;
}

}  // namespace rockfold
