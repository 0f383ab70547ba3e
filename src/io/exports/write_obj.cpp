#include "src/io/exports/surfaces.hpp"
#include "src/io/exports/writers.hpp"

namespace rockfold {

void write_obj(const ExportData& data, TextFile& file) {
  const BlockArrays& blocks = data.blocks;
  const PolygonMesh polygons = simple_polygons(blocks, data.polygons);
  if (!data.title.empty()) file.print("# {}\n", one_line(data.title));
  file.print("# {} blocks; lengths in m, x east, y north, z up\n", blocks.block_count());
  Index p = 0;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v)
      file.print("v {}\n", spaced(blocks.vertex[v]));
    file.print("g block_{}\n# volume {} stage {}\n", b + 1, blocks.volume[b], stage_of(blocks, b));
    Index origin = none;
    for (; p < polygons.size() && polygons.polygon_face[p] < blocks.face_begin[b + 1]; ++p) {
      const Index of_face = blocks.face_origin[polygons.polygon_face[p]];
      if (of_face != origin && of_face != none)
        file.print("# {}\n", one_line(blocks.origins[of_face].name));
      origin = of_face;
      file.print("f");
      for (Index c = polygons.polygon_begin[p]; c < polygons.polygon_begin[p + 1]; ++c)
        file.print(" {}", polygons.polygon_vertex[c] + 1);
      file.print("\n");
    }
  }
}

}  // namespace rockfold
