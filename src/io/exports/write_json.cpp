#include <nlohmann/json.hpp>

#include "src/io/exports/writers.hpp"

namespace rockfold {

namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string point(const Vec3& x) {
  return fmt::format("[{},{},{}]", x[0], x[1], x[2]);
}

std::string origin_name(const BlockArrays& blocks, Index origin) {
  return origin == none ? "null" : quoted(blocks.origins[origin].name);
}

/// Loops of a face: vertices of the block by number, from 0.
void write_face(const BlockArrays& blocks, Index b, Index f, TextFile& file) {
  file.print("{{\"origin\":{},\"normal\":{},\"area\":{},\"loops\":[",
             origin_name(blocks, blocks.face_origin[f]), point(blocks.face_normal[f]),
             blocks.face_area[f]);
  for (Index l = blocks.loop_begin[f]; l < blocks.loop_begin[f + 1]; ++l) {
    file.print("{}[", l > blocks.loop_begin[f] ? "," : "");
    for (Index c = blocks.corner_begin[l]; c < blocks.corner_begin[l + 1]; ++c)
      file.print("{}{}", c > blocks.corner_begin[l] ? "," : "",
                 blocks.corner_vertex[c] - blocks.vertex_begin[b]);
    file.print("]");
  }
  file.print("]}}");
}

void write_dead_end(const BlockArrays& blocks, Index d, TextFile& file) {
  file.print("{{\"origin\":{},\"points\":[", origin_name(blocks, blocks.dead_end_origin[d]));
  const Index begin = blocks.dead_end_corner_begin[d];
  for (Index c = begin; c < blocks.dead_end_corner_begin[d + 1]; ++c)
    file.print("{}{}", c > begin ? "," : "", point(blocks.dead_end_vertex[c]));
  file.print("]}}");
}

/// [B] the dead ends of each block.
std::vector<std::vector<Index>> dead_ends_by_block(const BlockArrays& blocks) {
  std::vector<std::vector<Index>> of(blocks.block_count());
  for (std::size_t d = 0; d < blocks.dead_end_block.size(); ++d)
    of[blocks.dead_end_block[d]].push_back(static_cast<Index>(d));
  return of;
}

}  // namespace

void write_json(const ExportData& data, TextFile& file) {
  const BlockArrays& blocks = data.blocks;
  const auto dead_ends = dead_ends_by_block(blocks);
  file.print("{{\"schema\":\"rockfold blocks/1\",\"title\":{},\"units\":\"m\",\n\"blocks\":[",
             quoted(data.title));
  for (Index b = 0; b < blocks.block_count(); ++b) {
    file.print(
        "{}\n{{\"id\":{},\"volume\":{},\"centroid\":{},\"convex\":{},\"stage\":{},\n\"vertices\":[",
        b > 0 ? "," : "", b + 1, blocks.volume[b], point(blocks.centroid[b]), blocks.convex[b] != 0,
        stage_of(blocks, b));
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v)
      file.print("{}{}", v > blocks.vertex_begin[b] ? "," : "", point(blocks.vertex[v]));
    file.print("],\n\"faces\":[");
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f) {
      file.print("{}", f > blocks.face_begin[b] ? ",\n" : "");
      write_face(blocks, b, f, file);
    }
    file.print("],\n\"dead_ends\":[");
    for (const Index d : dead_ends[b]) {
      file.print("{}", d != dead_ends[b].front() ? ",\n" : "");
      write_dead_end(blocks, d, file);
    }
    file.print("]}}");
  }
  file.print("\n]}}\n");
}

}  // namespace rockfold
