// [[solid]].
#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

/// Without a shape only the types are checked.
void read_continues(TableReader& in, const std::optional<Shape>& shape, Solid& solid) {
  const auto* value = in.find("continues");
  const std::string path = in.path_of("continues");
  const auto* list =
      value ? array_from(*value, path, 0, "an array of face names in quotes", in.out()) : nullptr;
  if (shape) solid.continues.assign(face_names(*shape).size(), false);
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const auto name = text_from((*list)[i], item_path(path, i), in.out());
    if (!name || !shape) continue;
    const auto faces = faces_named(*shape, *name);
    for (const Index face : faces) solid.continues[face] = true;
    if (faces.empty())
      in.out().add((*list)[i].spot, item_path(path, i),
                   "unknown face \"" + *name + "\"" +
                       suggestion(*name, names_and_groups(*shape), "its faces are"));
  }
}

void read_operation(TableReader& in, bool first, Solid& solid) {
  // The format's page writes both forms.
  const auto operation =
      in.choose("operation", {{"add", "subtract", "+", "-"}, {}}, Need::optional);
  solid.add = !operation || *operation % 2 == 0;
  if (first && !solid.add)
    in.wrong("operation",
             "found \"subtract\", must be \"add\": there is nothing to subtract from yet");
}

/// The cutter takes planes closer than 1e-10 of the model's size for one: a box's faces must not
/// be.
void check_thickness(Draft& draft) {
  if (std::count(draft.has_shape.begin(), draft.has_shape.end(), false) > 0) return;
  const Real least = 1e-9 * given_size(draft.model);
  for (std::size_t i = 0; i < draft.model.solids.size(); ++i) {
    const auto* box = std::get_if<BoxShape>(&draft.model.solids[i].shape);
    for (int d = 0; box && d < 3; ++d)
      if (const Real thickness = box->max[d] - box->min[d]; thickness < least)
        draft.out.add(draft.solids.spot(i), draft.solids.path(i),
                      "is " + number_text(thickness) +
                          " m thick, must be at least 1e-9 of the model's size (" +
                          number_text(least) + " m)");
  }
}

bool printable(const std::string& name) {
  return std::none_of(name.begin(), name.end(),
                      [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

/// The bodies of the entry's file; none where it cannot be read, which is told.
std::vector<FileBody> read_bodies(TableReader& in, const Draft& draft, const Shape& shape) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  if (!mesh || !draft.bodies) {
    in.wrong("bodies", mesh ? "\"separate\" needs the mesh file, which is not read here"
                            : "belongs to shape = \"mesh\": other shapes are one body");
    return {};
  }
  try {
    return draft.bodies({mesh->file, 0, 0, in.path_of("file")});
  } catch (const Error& error) {
    for (const Diagnostic& found : error.diagnostics()) in.wrong_in_file(found);
    return {};
  }
}

/// One solid a body, each with all that the entry says. Bodies are called as in the file, else by the entry's name and a number.
/// Of a file that cannot be read one without a shape.
void add_bodies(TableReader& in, const std::string& prefix, const std::vector<FileBody>& bodies,
                const Solid& entry, Draft& draft) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Solid solid = entry;
    const std::string& given = bodies[b].name;
    const bool is_named = !given.empty() && printable(given);
    solid.name = in.add_name(draft.solids, is_named ? given : prefix + std::to_string(b + 1));
    std::get<MeshShape>(solid.shape).surface = bodies[b].surface;
    draft.has_shape.push_back(true);
    draft.model.solids.push_back(std::move(solid));
  }
  if (!bodies.empty()) return;
  draft.solids.set_incomplete();
  draft.has_shape.push_back(false);
  Solid& unknown = draft.model.solids.emplace_back(entry);
  unknown.name = in.add_name(draft.solids, prefix);
  unknown.shape = {};
}

bool bodies_are_separate(TableReader& in) {
  return in.choose("bodies", {{"one", "separate"}, {}}, Need::optional).value_or(0) == 1;
}

}  // namespace

void read_solids(Draft& draft) {
  read_entries(draft, "solid", [&](TableReader& in, Index number) {
    Solid solid;
    const std::string fallback = "solid" + std::to_string(number);
    const bool separate = in.gives("bodies") && bodies_are_separate(in);
    solid.name = separate ? in.read_prefix(fallback) : in.read_name(draft.solids, fallback);
    solid.place = in.place();
    read_operation(in, number == 1, solid);
    const auto shape = read_shape(in, solid.add, draft.model.path);
    if (shape && std::holds_alternative<MeshShape>(*shape) && !in.gives("bodies"))
      bodies_are_separate(in);  // it is a key here
    read_continues(in, shape, solid);
    in.read_reference("material", draft.materials, solid.material);
    if (in.read_optional_reference("interface", draft.joint_materials, solid.interface) &&
        solid.interface != none && !solid.add)
      in.wrong("interface",
               "belongs to rock that is added: a solid that is subtracted leaves none");
    if (shape) solid.shape = *shape;
    if (separate) {
      const auto bodies = shape ? read_bodies(in, draft, *shape) : std::vector<FileBody>{};
      add_bodies(in, solid.name, bodies, solid, draft);
      return;
    }
    draft.has_shape.push_back(shape.has_value());
    draft.model.solids.push_back(std::move(solid));
  });
  check_thickness(draft);
}

std::vector<std::string> names_and_groups(const Shape& shape) {
  std::vector<std::string> names;
  for (const char* group : {"side", "cap0", "cap1"})
    if (!faces_named(shape, group).empty()) names.emplace_back(group);
  for (auto& name : face_names(shape)) names.push_back(std::move(name));
  return names;
}

Real given_size(const Model& model) {
  Vec3 low{largest_coordinate, largest_coordinate, largest_coordinate}, high = -low;
  Real largest = 0;
  for (const auto& solid : model.solids)
    for (const auto& point : given_points(solid.shape))
      for (int d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], point[d]);
        high[d] = std::max(high[d], point[d]);
        largest = std::max(largest, std::abs(point[d]));
      }
  if (high[0] < low[0]) return 1;
  return std::max(norm(high - low), 1e-9 * largest);
}

}  // namespace rockfold
