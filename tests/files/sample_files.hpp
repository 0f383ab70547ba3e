// What tests of data files share: one cube in every format, writers of binary numbers, temporary folders.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "host/files/meshes/read_mesh.hpp"
#include "host/files/terrain/read_terrain.hpp"

namespace rockfold {

inline const Place sample_place{"sample", 0, 0, "solid[1].file"};

/// A mesh as lists, to be written in any format.
struct PlainMesh {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;  ///< counter-clockwise from outside
};

/// A box whose 12 triangles are used vertex by vertex, so that formats without indices give the same order.
PlainMesh box_mesh(const Vec3& min, const Vec3& max);
/// The faces turned inside out.
PlainMesh inverted(PlainMesh mesh);
/// Both, the second one's vertices behind the first one's.
PlainMesh joined(PlainMesh first, const PlainMesh& second);

std::string as_obj(const PlainMesh& mesh);
std::string as_off(const PlainMesh& mesh);
std::string as_text_stl(const PlainMesh& mesh);
std::string as_binary_stl(const PlainMesh& mesh);
std::string as_text_ply(const PlainMesh& mesh);
std::string as_binary_ply(const PlainMesh& mesh, bool big_endian);

/// A folder of its own that is removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Writes a file; its path.
  std::string write(const std::string& name, std::string_view bytes) const;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// The errors that `read` throws; empty if none.
template <typename Read>
std::vector<Diagnostic> errors_of_reading(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    return error.diagnostics();
  }
  return {};
}

/// Joint materials of these names.
inline std::vector<JointMaterial> named_materials(const std::vector<std::string>& names) {
  std::vector<JointMaterial> materials(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) materials[i].name = names[i];
  return materials;
}

/// "line:column: message" of each error.
std::string listed(const std::vector<Diagnostic>& errors);

/// Six times the volume inside a surface.
Real six_volumes(const TriangleSurface& surface);
/// Twice the area in plan.
Real double_plan_area(const TriangleSurface& ground);

}  // namespace rockfold
