// The writers of the formats, one file each.
#pragma once

#include "src/io/exports/export.hpp"
#include "src/io/exports/text_file.hpp"

namespace rockfold {

/// VTK XML PolyData, ASCII, triangles, with cell data block, face, origin, volume, stage, with block theory class, batch and
/// factor_of_safety; the names of the origins stand in the field
/// data `origin_name`.
void write_vtp(const ExportData& data, TextFile& file);

/// Wavefront OBJ: a group block_ID for each block, vertices of its own.
void write_obj(const ExportData& data, TextFile& file);

/// ASCII STL: a solid block_ID for each block.
void write_stl(const ExportData& data, TextFile& file);

/// 3DEC 7 and 9 commands: `block create polyhedron` for each convex part, in the group block_ID of the slot rockfold; the
/// parts of one block are joined.
/// https://docs.itascacg.com/itasca900/3dec/block/doc/manual/block_manual/block_commands/block/cmd_block.create.html
void write_3ddat(const ExportData& data, TextFile& file);

/// Blocks with vertices, faces as loops, and the joints that end inside them.
void write_json(const ExportData& data, TextFile& file);

/// A block's stage; 0 where no stages are known.
inline Index stage_of(const BlockArrays& blocks, Index b) {
  return blocks.stage.empty() ? 0 : blocks.stage[b];
}

/// Text on one line of ASCII, for comments.
std::string one_line(const std::string& text);

}  // namespace rockfold
