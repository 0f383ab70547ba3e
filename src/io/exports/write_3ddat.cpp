#include "src/io/exports/writers.hpp"

namespace rockfold {

namespace {

/// 3DEC wants the corners of a face clockwise seen from outside, and no vector broken over two lines.
void write_part(const PartArrays& parts, Index p, TextFile& file) {
  file.print("block create polyhedron ...\n");
  for (Index f = parts.face_begin[p]; f < parts.face_begin[p + 1]; ++f) {
    file.print("  face");
    for (Index c = parts.corner_begin[f + 1]; c-- > parts.corner_begin[f];) {
      const Vec3& x = parts.vertex[parts.corner_vertex[c]];
      file.print(" ({},{},{})", x[0], x[1], x[2]);
    }
    file.print(" ...\n");
  }
  file.print("  group 'block_{}' slot 'rockfold'\n", parts.block[p] + 1);
}

}  // namespace

void write_3ddat(const ExportData& data, TextFile& file) {
  const PartArrays& parts = data.parts;
  if (!data.title.empty()) file.print("; {}\n", one_line(data.title));
  file.print("; {} blocks, {} convex parts; commands of 3DEC 7 and 9; lengths in m\n",
             data.blocks.block_count(), parts.part_count());
  file.print("; Block N of the reports is the group block_N of the slot rockfold.\n");
  for (Index p = 0; p < parts.part_count(); ++p) {
    const bool first = p == 0 || parts.block[p - 1] != parts.block[p];
    const bool last = p + 1 == parts.part_count() || parts.block[p + 1] != parts.block[p];
    if (const Index stage = stage_of(data.blocks, parts.block[p]); first && stage > 0)
      file.print("; block_{}: excavated at stage {}\n", parts.block[p] + 1, stage);
    write_part(parts, p, file);
    if (last && !first)
      file.print("block join range group 'block_{}' slot 'rockfold'\n", parts.block[p] + 1);
  }
}

}  // namespace rockfold
