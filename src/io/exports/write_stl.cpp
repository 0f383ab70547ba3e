#include "src/io/exports/surfaces.hpp"
#include "src/io/exports/writers.hpp"

namespace rockfold {

void write_stl(const ExportData& data, TextFile& file) {
  const BlockArrays& blocks = data.blocks;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    file.print("solid block_{}\n", b + 1);
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
      for (const auto& triangle : face_triangles(blocks, f)) {
        file.print("facet normal {}\nouter loop\n", spaced(blocks.face_normal[f]));
        for (const Index v : triangle) file.print("vertex {}\n", spaced(blocks.vertex[v]));
        file.print("endloop\nendfacet\n");
      }
    file.print("endsolid block_{}\n", b + 1);
  }
}

}  // namespace rockfold
