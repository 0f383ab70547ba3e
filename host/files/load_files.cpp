#include "host/files/load_files.hpp"

#include <map>
#include <memory>
#include <new>
#include <utility>
#include <variant>

#include "host/files/bodies/fit_bodies.hpp"
#include "host/files/data_file.hpp"
#include "host/files/faults.hpp"
#include "host/files/foreign_format.hpp"
#include "host/files/hardly_meant.hpp"
#include "host/files/meshes/read_mesh.hpp"
#include "host/files/read_joint_table.hpp"
#include "host/files/read_record.hpp"
#include "host/files/terrain/read_terrain.hpp"

namespace rockfold {

namespace {

using SharedSurface = std::shared_ptr<const TriangleSurface>;

/// Throws Error(model) at a file of a format that is not read.
std::string read_file(const Place& place, FileUse use) {
  std::string bytes = read_data_file(place);
  if (auto foreign = foreign_format(bytes, use); !foreign.empty())
    Faults(place).fail(std::move(foreign));
  return bytes;
}

MeshFormat format_of(const Place& place) {
  const auto format = mesh_format(place.file);
  if (!format)
    Faults(place).fail("triangles are read from files whose names end in .obj, .off, .stl or .ply");
  return *format;
}

/// Loads one file after another and keeps what is wrong with them until the end.
class Loader {
 public:
  explicit Loader(Model& model) : model_(model) {}

  void run() {
    for (auto& solid : model_.solids) load_shape(solid.shape, solid.place);
    for (auto& excavation : model_.excavations) load_shape(excavation.shape, excavation.place);
    for (auto& mesh : model_.joint_meshes)
      if (!mesh.surface)
        attempt(mesh.file, mesh.place,
                [&](const Place& place) { mesh.surface = load_mesh(MeshUse::joints, place); });
    for (auto& table : model_.joint_tables)
      if (table.rows.empty())
        attempt(table.file, table.place, [&](const Place& place) {
          table.rows = read_joint_table(read_file(place, FileUse::table), table,
                                        model_.joint_materials, place, &model_.warnings);
        });
    if (auto& base = model_.base_acceleration; base && !base->file.empty() && base->table.empty())
      attempt(base->file, base->place, [&](const Place& place) {
        base->table = read_record(read_data_file(place), *base, place, &model_.warnings);
      });
    if (!found_.empty())
      throw Error(any_in_content_ ? ErrorKind::model : ErrorKind::io, std::move(found_));
  }

 private:
  void load_shape(Shape& shape, const Place& entry) {
    if (auto* mesh = std::get_if<MeshShape>(&shape); mesh && !mesh->surface)
      attempt(mesh->file, entry,
              [&](const Place& place) { mesh->surface = load_mesh(MeshUse::solid, place); });
    if (auto* terrain = std::get_if<TerrainShape>(&shape); terrain && !terrain->ground)
      attempt(terrain->file, entry, [&](const Place& place) {
        if (auto fault = columns_fault(terrain->columns); !fault.empty())
          Faults({entry.file, entry.line, entry.column, entry.key + ".columns"})
              .fail(entry.line, entry.column, std::move(fault));
        auto ground = load_terrain(place, terrain->columns);
        check_above(*ground, terrain->base, place);
        check_fine_posts(*ground, terrain->base, place);
        if (auto found = geographic_coordinates(*ground, terrain->base, place))
          model_.warnings.push_back(std::move(*found));
        terrain->ground = std::move(ground);
      });
  }

  /// Runs `load` with the file's place and keeps its errors.
  template <typename Load>
  void attempt(const std::string& file, const Place& entry, const Load& load) {
    if (file.empty()) return;  // none could be read
    const Place place{file, 0, 0, entry.key + ".file"};
    try {
      load(place);
    } catch (const Error& error) {
      any_in_content_ = any_in_content_ || error.kind() != ErrorKind::io;
      found_.insert(found_.end(), error.diagnostics().begin(), error.diagnostics().end());
    } catch (const std::bad_alloc&) {
      found_.push_back({place, "is too large for the memory"});
    }
  }

  SharedSurface load_mesh(MeshUse use, const Place& place) {
    auto& surface = meshes_[{place.file, use}];
    if (surface) return surface;
    const std::string bytes = read_file(place, FileUse::mesh);
    surface = std::make_shared<const TriangleSurface>(
        read_mesh(bytes, format_of(place), use, place, &model_.warnings));
    return surface;
  }

  SharedSurface load_terrain(const Place& place, const std::vector<std::string>& columns) {
    auto& ground = terrains_[{place.file, columns}];
    if (!ground)
      ground = std::make_shared<const TriangleSurface>(
          read_terrain(read_file(place, FileUse::ground), place, &model_.warnings, columns));
    return ground;
  }

  Model& model_;
  std::map<std::pair<std::string, MeshUse>, SharedSurface> meshes_;  ///< each file is read once
  std::map<std::pair<std::string, std::vector<std::string>>, SharedSurface> terrains_;
  std::vector<Diagnostic> found_;
  bool any_in_content_ = false;
};

}  // namespace

void load_files(Model& model) {
  Loader(model).run();
  fit_bodies(model);
}

std::vector<FileBody> file_bodies(const Place& place) {
  return read_bodies(read_file(place, FileUse::mesh), format_of(place), place);
}

std::vector<std::string> files_named_by(const Model& model) {
  std::vector<std::string> files;
  const auto add_shape = [&](const Shape& shape) {
    if (const auto* mesh = std::get_if<MeshShape>(&shape))
      if (!mesh->surface || files.empty() || files.back() != mesh->file)
        files.push_back(mesh->file);
    if (const auto* terrain = std::get_if<TerrainShape>(&shape)) files.push_back(terrain->file);
  };
  for (const auto& solid : model.solids) add_shape(solid.shape);
  for (const auto& excavation : model.excavations) add_shape(excavation.shape);
  for (const auto& mesh : model.joint_meshes) files.push_back(mesh.file);
  for (const auto& table : model.joint_tables) files.push_back(table.file);
  if (model.base_acceleration && !model.base_acceleration->file.empty())
    files.push_back(model.base_acceleration->file);
  return files;
}

}  // namespace rockfold
