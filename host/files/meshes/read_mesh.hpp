// Triangle meshes in memory: the files that shape = "mesh" and [[joint_mesh]] name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/model/model.hpp"
#include "src/model/read/file_bodies.hpp"

namespace rockfold {

enum class MeshFormat { obj, off, stl, ply };

enum class MeshUse {
  solid,   ///< must bound a solid (check_solid in mesh_surface.hpp)
  joints,  ///< any triangles with area
};

/// By the end of the file's name, whatever its case.
std::optional<MeshFormat> mesh_format(const std::string& file);

/// `place` names the file and the key that names it. Throws Error(model) with all that is wrong. `warnings` say what is
/// hardly meant, unless it is null.
TriangleSurface read_mesh(std::string_view bytes, MeshFormat format, MeshUse use,
                          const Place& place, std::vector<Diagnostic>* warnings = nullptr);

/// The closed bodies of a mesh, each of which must bound a solid. Throws as read_mesh.
std::vector<FileBody> read_bodies(std::string_view bytes, MeshFormat format, const Place& place);

}  // namespace rockfold
