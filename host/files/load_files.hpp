// Geometry that a model names by file: meshes, terrains, tables of joints.
#pragma once

#include "src/model/model.hpp"
#include "src/model/read/file_bodies.hpp"

namespace rockfold {

/// Of a model that could be read in part too. Fills MeshShape::surface, TerrainShape::ground, JointMesh::surface and JointTable::rows of a model from their files.
/// Then solids from meshes that touch each other are fitted together (host/files/bodies/fit_bodies.hpp).
/// Throws Error with all that is wrong: kind io for a file that cannot be read, model for one whose content is wrong (with
/// the file's own line where it has lines, and what is broken: NaN, truncation, another format, a solid's surface that is
/// open, self-intersecting or inside out and where).
void load_files(Model& model);

/// The closed bodies of a mesh file. `place` names the file and the key that names it. Throws as load_files.
std::vector<FileBody> file_bodies(const Place& place);

/// The files that a model names, each as often as it does; those of several bodies once.
std::vector<std::string> files_named_by(const Model& model);

}  // namespace rockfold
