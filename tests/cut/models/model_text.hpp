// A model as the text of a model file, so that a failure of a random test can be run by itself.
#pragma once

#include <string>

#include "src/model/model.hpp"

namespace rockfold::test {

/// Solids, excavations, joints, joint sets and joint meshes; numbers read back exactly. Surfaces of triangles are named surface0.obj,
/// … in the order in which they stand; `surface_text` is such a file.
std::string to_toml(const Model& model);

std::string surface_text(const TriangleSurface& surface);

}  // namespace rockfold::test
