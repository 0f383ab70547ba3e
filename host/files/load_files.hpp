// Geometry that a model names by file: meshes, terrains, tables of joints.
#pragma once

#include "src/model/model.hpp"

namespace rockfold {

/// Of a model that could be read in part too. Fills MeshShape::surface, TerrainShape::ground, JointMesh::surface and JointTable::rows of a model from their files.
/// Throws Error with all that is wrong: kind io for a file that cannot be read, model for one whose content is wrong (with
/// the file's own line where it has lines, and what is broken: NaN, truncation, another format, a solid's surface that is
/// open, self-intersecting or inside out and where).
void load_files(Model& model);

/// The files that load_files reads, each as often as the model names it.
std::vector<std::string> files_named_by(const Model& model);

}  // namespace rockfold
