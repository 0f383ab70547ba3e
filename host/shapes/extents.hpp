// Where the shapes and surfaces of a model lie, for people to see whether they are where they are meant to be.
#pragma once

#include <string>
#include <vector>

#include "host/joints/disc.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct NamedExtent {
  std::string kind;  ///< "solid", "excavation", "joint_mesh"
  std::string name;
  bool bounded = true;  ///< false: half-spaces that are subtracted or excavated
  Extent box{};         ///< m, of a bounded one
};

/// Of all solids, excavations and joint meshes, in the order of the file. Files have been read before (host/files). Throws what
/// shape_geometry throws.
std::vector<NamedExtent> named_extents(const Model& model);

/// A warning for each shape or surface from a file that is some thousand times larger, or smaller, than the solids that the model
/// gives by numbers: files in other units.
std::vector<Diagnostic> files_out_of_scale(const Model& model);

}  // namespace rockfold
