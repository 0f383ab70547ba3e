#include "src/model/pair_law.hpp"

#include <algorithm>
#include <utility>

namespace rockfold {

namespace {

/// surface_of_solid() of one that a contact pair names, else none.
Index named_surface(const Model& model, Index solid) {
  const auto& named = model.contact_solids;
  const auto found = std::find(named.begin(), named.end(), solid);
  return found == named.end() ? none
                              : surface_of_solid(model, static_cast<Index>(found - named.begin()));
}

Index said_of(const Model& model, Index one, Index other) {
  if (one == none || other == none) return none;
  for (const ContactPair& pair : model.contact_pairs)
    if ((pair.between[0] == one && pair.between[1] == other) ||
        (pair.between[0] == other && pair.between[1] == one))
      return pair.material;
  return none;
}

}  // namespace

Index weaker_material(const Model& model, Index one, Index other) {
  const auto strength = [&](Index m) {
    const JointMaterial& joint = model.joint_materials[m];
    return std::pair{joint.residual_friction_angle.value_or(joint.friction_angle),
                     joint.residual_cohesion};
  };
  return strength(other) < strength(one) ? other : one;
}

Index paired_material(const Model& model, const PairedSurface& one, const PairedSurface& other) {
  for (const auto& [p, q] : {std::pair{one.solid, other.solid},
                             {one.solid, other.material},
                             {one.material, other.solid},
                             {one.material, other.material}})
    if (const Index said = said_of(model, p, q); said != none) return said;
  return none;
}

Index interface_material(const Model& model, Index solid, Index other) {
  const Index a = model.solids[solid].interface, b = model.solids[other].interface;
  if (a == none && b == none) return none;
  const Index said =
      paired_material(model, {named_surface(model, solid), a}, {named_surface(model, other), b});
  if (said != none) return said;
  if (a == none || b == none || a == b) return a == none ? b : a;
  return weaker_material(model, std::min(a, b), std::max(a, b));
}

Index interface_surface(const Model& model, Index solid) {
  const Index own = model.solids[solid].interface, named = named_surface(model, solid);
  return own == none || named == none ? own : named;
}

}  // namespace rockfold
