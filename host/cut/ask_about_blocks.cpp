#include "host/cut/ask_about_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "host/cut/cells/complex.hpp"
#include "host/refuse.hpp"
#include "src/model/model.hpp"

namespace rockfold {

namespace {

/// Joints that one entry of the model, or all [[joint]] together, make.
struct Source {
  std::string key, name;  ///< "joint_table[1]", "of table \"map\""
  Place place;
  std::string advice;
  std::size_t joints = 0;
};

constexpr const char* of_sets = "take a larger spacing, give the set a radius (m)";
constexpr const char* of_joints = "give the joints a radius (m)";

std::string advice_on(const JointTable& table) {
  return table.extent == JointTable::Extent::through_going
             ? "let the table's columns say how far joints reach (no extents = \"through_going\")"
             : "give the table a column of radii, diameters or trace lengths (m)";
}

/// In the order of their origins: each set, all single joints, the meshes, each table.
std::vector<Source> sources_of(const Model& model) {
  std::vector<Source> sources;
  for (std::size_t s = 0; s < model.joint_sets.size(); ++s)
    sources.push_back({fmt::format("joint_set[{}]", s + 1),
                       fmt::format("planes of set \"{}\"", model.joint_sets[s].name),
                       model.joint_sets[s].place, of_sets});
  if (!model.joints.empty())
    sources.push_back({"joint", "[[joint]]", model.joints.front().place, of_joints});
  for (std::size_t m = 0; m < model.joint_meshes.size(); ++m)
    sources.push_back({fmt::format("joint_mesh[{}]", m + 1),
                       fmt::format("triangles of mesh \"{}\"", model.joint_meshes[m].name),
                       model.joint_meshes[m].place, "take a coarser mesh"});
  for (std::size_t t = 0; t < model.joint_tables.size(); ++t)
    sources.push_back({fmt::format("joint_table[{}]", t + 1),
                       fmt::format("rows of table \"{}\"", model.joint_tables[t].name),
                       model.joint_tables[t].place, advice_on(model.joint_tables[t])});
  return sources;
}

/// Into the sources, of an origin of joints; a table has several origins, whose names begin with its own.
std::size_t source_of(const Model& model, const Complex& complex, std::size_t origin,
                      std::size_t sources) {
  const std::size_t sets = model.joint_sets.size(), joints = model.joints.size(),
                    meshes = model.joint_meshes.size();
  if (origin < sets) return origin;
  if (origin < sets + joints) return sets;
  const std::size_t before_meshes = sets + (joints > 0);
  if (origin < sets + joints + meshes) return before_meshes + origin - sets - joints;
  const std::string& name = complex.origins[origin].name;
  for (std::size_t t = 0; t < model.joint_tables.size(); ++t) {
    const std::string& table = model.joint_tables[t].name;
    if (name == table || name.starts_with(table + ".")) return before_meshes + meshes + t;
  }
  return sources - 1;
}

}  // namespace

std::string about_blocks(Real blocks) {
  const Real unit = std::pow(10, std::max(0.0, std::floor(std::log10(blocks)) - 1));
  std::string digits = fmt::format("{:.0f}", std::round(blocks / unit) * unit);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return "about " + digits;
}

void ask_about_blocks(const Model& model, const Complex& complex, Real blocks) {
  std::vector<Source> sources = sources_of(model);
  for (const JointPatch& joint : complex.joints)
    ++sources[source_of(model, complex, static_cast<std::size_t>(joint.origin), sources.size())]
          .joints;
  const auto most =
      std::max_element(sources.begin(), sources.end(),
                       [](const Source& a, const Source& b) { return a.joints < b.joints; });
  refuse(most->place, most->key,
         fmt::format("the joints would cut the rock into {} blocks; {} of the {} joints are {}. If "
                     "that is meant, say --yes or give cut.max_cells. Else {}, or keep joints to a "
                     "part of the rock by within = \"SOLID\"",
                     about_blocks(blocks), most->joints, complex.joints.size(), most->name,
                     most->advice));
}

}  // namespace rockfold
