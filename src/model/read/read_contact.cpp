// [contact] and [[contact_pair]].
#include <algorithm>

#include "src/model/read/draft.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

void read_contact(Draft& draft) {
  ContactSpec& contact = draft.model.contact;
  contact.material = draft.joint_materials.empty() ? none : 0;
  read_section(draft, "contact", [&](TableReader& in) {
    contact.place = in.place();
    contact.material_given = in.read_reference("material", draft.joint_materials, contact.material);
    in.read("max_iterations", contact.max_iterations, IntegerRange{.low = 1}, Need::optional);
    in.read("restitution", contact.restitution, between(0, 1, "0 plastic, 1 elastic impact"),
            Need::optional);
    Range depth = not_negative("m");
    depth.largest = largest_coordinate;
    in.read("max_penetration", contact.max_penetration, depth, Need::optional);
    Range rounding = positive("m");
    rounding.largest = largest_coordinate;
    in.read("tolerance", contact.tolerance, rounding);
  });
}

namespace {

/// A surface by the name of its joint material, or of the solid whose face it is; none where there is no such name.
Index surface_named(Draft& draft, const std::string& name, TableReader& in) {
  const Index material = draft.joint_materials.find(name), solid = draft.solids.find(name);
  if (material != none && solid != none)
    in.wrong("between", "\"" + name +
                            "\" is the name of a joint material and of a solid: give them "
                            "different names");
  if (material != none) return material;
  if (solid == none) return none;
  std::vector<Index>& solids = draft.model.contact_solids;
  const auto found = std::find(solids.begin(), solids.end(), solid);
  const Index place = static_cast<Index>(found - solids.begin());
  if (found == solids.end()) solids.push_back(solid);
  return surface_of_solid(draft.model, place);
}

bool read_between(TableReader& in, Draft& draft, ContactPair& pair) {
  const std::string expected = "2 names of joint materials or solids";
  const auto* value = in.find("between", expected);
  const auto* list =
      value ? array_from(*value, in.path_of("between"), 2, expected, in.out()) : nullptr;
  if (!list) return false;
  if (list->size() != 2) {
    in.wrong("between", "found " + std::to_string(list->size()) + ", must be " + expected);
    return false;
  }
  for (int side = 0; side < 2; ++side) {
    const auto* name = std::get_if<std::string>(&(*list)[side].data);
    pair.between[side] = name ? surface_named(draft, *name, in) : none;
    if (pair.between[side] != none) continue;
    if (!name || (draft.joint_materials.complete() && draft.solids.complete()))
      in.wrong("between", name ? "no joint material and no solid is called \"" + *name + "\""
                               : "must be " + expected);
    return false;
  }
  return true;
}

}  // namespace

void read_contact_pairs(Draft& draft) {
  read_entries(draft, "contact_pair", [&](TableReader& in, Index) {
    ContactPair pair;
    const bool known = read_between(in, draft, pair);
    if (known && !in.has("material"))
      in.missing({"material"}, "the joint material that these two surfaces give");
    if (!in.read_reference("material", draft.joint_materials, pair.material) || !known) return;
    for (const ContactPair& other : draft.model.contact_pairs)
      if (std::minmax(pair.between[0], pair.between[1]) ==
          std::minmax(other.between[0], other.between[1]))
        in.wrong("between", "names two surfaces that an entry before names too");
    draft.model.contact_pairs.push_back(pair);
  });
}

}  // namespace rockfold
