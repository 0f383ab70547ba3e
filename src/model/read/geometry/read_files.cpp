// What a model names by file.
#include <filesystem>

#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"
#include "src/model/text/file_kind.hpp"

namespace rockfold {

std::optional<std::string> read_file_name(TableReader& in, const std::string& model_path) {
  std::string name;
  if (!in.read("file", name)) return {};
  if (name.empty() || name.find('\0') != std::string::npos) {
    in.wrong("file", "found " + described({name, {}}) + ", must be the name of a file");
    return {};
  }
  namespace fs = std::filesystem;
  const fs::path path = fs::path(model_path).parent_path() / name;
  std::error_code failure;
  const auto status = fs::status(path, failure);
  if (fs::is_directory(status)) {
    in.unreadable("file", "\"" + path.string() + "\" is a folder, must be a file");
  } else if (!fs::exists(status)) {
    in.unreadable("file", "there is no file " + described({path.string(), {}}) +
                              "; names are relative to the model's folder" +
                              file_hint(path.string()));
  } else {
    return path.string();
  }
  return {};
}

namespace {

/// An array of words.
void read_words(TableReader& in, const std::string& key, std::vector<std::string>& target) {
  const Value* value = in.find(key);
  const Array* array =
      value ? array_from(*value, in.path_of(key), 3, "3 names of columns", in.out()) : nullptr;
  if (!array) return;
  std::vector<std::string> words;
  for (std::size_t i = 0; i < array->size(); ++i)
    if (auto word = text_from((*array)[i], item_path(in.path_of(key), i), in.out()))
      words.push_back(std::move(*word));
  if (words.size() == array->size()) target = std::move(words);
}

}  // namespace

std::optional<Shape> read_mesh(TableReader& in, const std::string& model_path) {
  MeshShape mesh;
  const auto file = read_file_name(in, model_path);
  if (!file) return {};
  mesh.file = *file;
  return mesh;
}

std::optional<Shape> read_terrain(TableReader& in, const std::string& model_path) {
  TerrainShape terrain;
  const auto file = read_file_name(in, model_path);
  const bool base = in.read("base", terrain.base, coordinate());
  read_words(in, "columns", terrain.columns);
  if (!file || !base) return {};
  terrain.file = *file;
  return terrain;
}

void read_joint_meshes(Draft& draft) {
  read_entries(draft, "joint_mesh", [&](TableReader& in, Index number) {
    JointMesh mesh;
    mesh.name = in.read_name(draft.joints, "joint_mesh" + std::to_string(number));
    mesh.place = in.place();
    if (auto file = read_file_name(in, draft.model.path)) mesh.file = std::move(*file);
    in.read_reference("material", draft.joint_materials, mesh.material);
    read_within(in, draft, mesh.within);
    in.read("flatness", mesh.flatness,
            Range{.low = 0, .high = 45, .high_open = true, .unit = "deg"}, Need::optional);
    draft.model.joint_meshes.push_back(std::move(mesh));
  });
}

void read_joint_tables(Draft& draft) {
  read_entries(draft, "joint_table", [&](TableReader& in, Index number) {
    JointTable table;
    table.name = in.read_name(draft.joints, "joint_table" + std::to_string(number));
    table.place = in.place();
    if (auto file = read_file_name(in, draft.model.path)) table.file = std::move(*file);
    in.read_reference("material", draft.joint_materials, table.material);
    table.left_hand = is_left_hand(in);
    const auto extents =
        in.choose("extents", {{"from_columns", "through_going"}, {}}, Need::optional);
    if (extents == 1) table.extent = JointTable::Extent::through_going;
    read_sides(in, table.sides);
    read_within(in, draft, table.within);
    draft.model.joint_tables.push_back(std::move(table));
  });
}

}  // namespace rockfold
