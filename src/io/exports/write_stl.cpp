#include "src/io/exports/writers.hpp"

namespace rockfold {

void write_stl(const ExportData& data, TextFile& file) {
  const BlockArrays& blocks = data.blocks;
  const PolygonMesh& triangles = data.triangles;
  Index t = 0;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    file.print("solid block_{}\n", b + 1);
    for (; t < triangles.size() && triangles.polygon_face[t] < blocks.face_begin[b + 1]; ++t) {
      file.print("facet normal {}\nouter loop\n",
                 spaced(blocks.face_normal[triangles.polygon_face[t]]));
      for (const Index v : triangles.polygon(t))
        file.print("vertex {}\n", spaced(blocks.vertex[v]));
      file.print("endloop\nendfacet\n");
    }
    file.print("endsolid block_{}\n", b + 1);
  }
}

}  // namespace rockfold
