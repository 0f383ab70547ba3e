// Blocks for other programs: one file of a format that the file's name tells.
#pragma once

#include <string>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/part_arrays.hpp"
#include "src/arrays/polygon_mesh.hpp"
#include "src/io/result_file.hpp"

namespace rockfold {

enum class ExportFormat { vtp, obj, stl, three_dec, json };

/// The format of ".vtp", ".obj", ".stl", ".3ddat" or ".json" (in either case). Throws Error(usage), which names these, for
/// any other name.
ExportFormat export_format(const std::string& path);

/// What is exported; all coordinates in m, ids from 1. What is not read may be empty.
struct ExportData {
  const BlockArrays& blocks;
  const PolygonMesh& polygons;          ///< convex ones of all faces; read for .obj alone
  const PolygonMesh& triangles;         ///< of all faces; read for .vtp and .stl alone
  const PartArrays& parts;              ///< read for .3ddat alone
  std::string title;                    ///< of the model
  const BlockFields* theory = nullptr;  ///< of block theory, if it was done; read for .vtp alone
};

/// Writes aside and renames, so that the file is whole under its name. Throws Error(io) with the file and the reason.
void export_blocks(const ExportData& data, const std::string& path);

}  // namespace rockfold
