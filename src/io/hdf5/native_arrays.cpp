#include "src/io/hdf5/native_arrays.hpp"

#include "src/base/sum.hpp"

namespace rockfold {
namespace {

using hdf5::File;

template <typename T>
std::int64_t count(const std::vector<T>& of) {
  return static_cast<std::int64_t>(of.size());
}

/// One member of each entry of a table as an array.
template <typename Table, typename Get>
auto column(const Table& table, Get get) {
  std::vector<std::decay_t<decltype(get(table.front()))>> values;
  values.reserve(table.size());
  for (const auto& entry : table) values.push_back(get(entry));
  return values;
}

template <typename Table>
void write_name_column(File& file, const std::string& path, const Table& table) {
  file.write_names(path, column(table, [](const auto& entry) { return entry.name; }));
}

void write_origins(File& file, const std::vector<FaceOrigin>& origins) {
  const std::string group = "/rockfold/origins/";
  write_name_column(file, group + "name", origins);
  file.write(group + "kind", column(origins, [](const FaceOrigin& o) {
               return static_cast<std::uint8_t>(o.kind);
             }));
  file.write(group + "joint_material",
             column(origins, [](const FaceOrigin& o) { return o.joint_material; }));
  file.write(group + "solid", column(origins, [](const FaceOrigin& o) { return o.solid; }));
  file.write(group + "solid_face",
             column(origins, [](const FaceOrigin& o) { return o.solid_face; }));
  file.write(group + "continues", column(origins, [](const FaceOrigin& o) {
               return static_cast<std::uint8_t>(o.continues);
             }));
}

void write_interfaces(File& file, const std::vector<BlockArrays::Interface>& interfaces) {
  using Pair = std::array<Index, 2>;
  const std::string group = "/rockfold/interfaces/";
  file.write(group + "block", column(interfaces, [](const auto& i) {
               return Pair{i.block[0], i.block[1]};
             }));
  file.write(group + "face", column(interfaces, [](const auto& i) {
               return Pair{i.face[0], i.face[1]};
             }));
  file.write(group + "area", column(interfaces, [](const auto& i) { return i.area; }));
}

void write_block_totals(File& file, const BlockArrays& blocks) {
  const std::string group = "/rockfold/totals";
  file.set_integers(group, "blocks", {blocks.block_count()});
  file.set_integers(group, "faces", {count(blocks.face_area)});
  file.set_integers(group, "vertices", {count(blocks.vertex)});
  file.set_integers(group, "interfaces", {count(blocks.interfaces)});
  Sum volume;
  for (const Real v : blocks.volume) volume += v;
  file.set_real(group, "volume", volume.value());
}

void write_lattice(File& file, const Lattice& lattice) {
  const std::string group = "/rockfold/lattice/";
  file.write(group + "origin", std::vector<Real>(lattice.origin.begin(), lattice.origin.end()));
  file.set_text("/rockfold/lattice", "kind", lattice_name(lattice.kind));
  file.set_integers("/rockfold/lattice", "odd_origin", {lattice.odd_origin ? 1 : 0});
  if (!lattice.block_origin.empty()) file.write(group + "block_origin", lattice.block_origin);
  file.write(group + "edge", std::vector<Vec3>(lattice.edge.begin(), lattice.edge.end()));
  file.write(group + "cells", std::vector<Index>(lattice.cells.begin(), lattice.cells.end()));
}

}  // namespace

void write_origin(File& file, const Model& model, const ResultHeader& header) {
  file.make_group("/rockfold");
  file.set_text("/rockfold", "format", "rockfold result");
  file.set_integers("/rockfold", "format_version", {result_format_version});
  file.set_text("/rockfold", "title", model.title);
  file.set_text("/rockfold", "command", header.command);
  file.set_text("/rockfold", "version", header.version);
  file.set_text("/rockfold", "commit", header.commit);
  file.set_text("/rockfold", "units",
                "SI: m, kg, s, N, Pa, J; angles in degrees; x east, y north, z up");
  file.write_text("/rockfold/model", model.text);
  write_name_column(file, "/rockfold/materials/name", model.materials);
  write_name_column(file, "/rockfold/joint_materials/name", model.joint_materials);
}

void write_block_arrays(File& file, const BlockArrays& blocks) {
  const std::string group = "/rockfold/blocks/";
  file.write(group + "face_begin", blocks.face_begin);
  file.write(group + "vertex_begin", blocks.vertex_begin);
  file.write(group + "volume", blocks.volume);
  file.write(group + "centroid", blocks.centroid);
  file.write(group + "edge_count", blocks.edge_count);
  file.write(group + "shell_count", blocks.shell_count);
  file.write(group + "genus", blocks.genus);
  file.write(group + "convex", blocks.convex);
  file.write(group + "finite", blocks.finite);
  file.write(group + "material", blocks.material);
  const auto or_zeros = [&](auto values) {
    values.resize(blocks.volume.size());
    return values;
  };
  file.write(group + "stage", or_zeros(blocks.stage));
  file.write(group + "dead_end_area", or_zeros(blocks.dead_end_area));
  file.write(group + "loop_begin", blocks.loop_begin);
  file.write(group + "face_normal", blocks.face_normal);
  file.write(group + "face_area", blocks.face_area);
  file.write(group + "face_origin", blocks.face_origin);
  file.write(group + "face_up", blocks.face_up);
  file.write(group + "face_plane", blocks.face_plane);
  if (!blocks.dead_end_block.empty()) {
    file.write(group + "dead_end_block", blocks.dead_end_block);
    file.write(group + "dead_end_origin", blocks.dead_end_origin);
    file.write(group + "dead_end_corner_begin", blocks.dead_end_corner_begin);
    file.write(group + "dead_end_vertex", blocks.dead_end_vertex);
  }
  write_interfaces(file, blocks.interfaces);
  write_origins(file, blocks.origins);
  write_block_totals(file, blocks);
}

void write_block_theory(File& file, const BlockFields& fields) {
  const std::string group = "/rockfold/block_theory/";
  file.write(group + "class", fields.block_class);
  file.write(group + "batch", fields.batch);
  file.write(group + "mode", fields.mode);
  file.write(group + "factor_of_safety", fields.factor_of_safety);
  file.write(group + "sliding_force", fields.sliding_force);
  file.write(group + "support_force", fields.support_force);
  if (!fields.supported_factor_of_safety.empty()) {
    file.write(group + "supported_factor_of_safety", fields.supported_factor_of_safety);
    file.write(group + "utilisation", fields.utilisation);
  }
  file.write(group + "direction", fields.direction);
}

void write_first_looks(File& file, const FirstLookArrays& looks) {
  const std::string group = "/rockfold/first_looks/";
  const auto write = [&](const char* name, const auto& values) {
    file.write(group + name, values);
  };
  write("block", looks.block);
  write("stage", looks.stage);
  write("volume", looks.volume);
  write("mass", looks.mass);
  write("free_area", looks.free_area);
  write("centroid", looks.centroid);
  write("load", looks.load);
  write("moment", looks.moment);
  write("free_centre", looks.free_centre);
  write("inertia", looks.inertia);
  write("neighbour_begin", looks.neighbour_begin);
  write("neighbour", looks.neighbour);
  write("held_block", looks.held_block);
  write("held_stage", looks.held_stage);
  write("held_neighbour_begin", looks.held_neighbour_begin);
  write("held_neighbour", looks.held_neighbour);
  write("face_begin", looks.face_begin);
  write("origin", looks.origin);
  write("normal", looks.normal);
  write("plane_normal", looks.plane_normal);
  write("contact_area", looks.contact_area);
  write("share", looks.share);
  write("loop_begin", looks.loop_begin);
  write("corner_begin", looks.corner_begin);
  write("corner", looks.corner);
  write("outline", looks.outline);
  write("outline_begin", looks.outline_begin);
  write("outline_normal", looks.outline_normal);
  write("outline_corner", looks.outline_corner);
  write("outline_drains", looks.outline_drains);
  write("outline_edge_drains", looks.outline_edge_drains);
  write("outline_pond", looks.outline_pond);
  write("patch_begin", looks.patch_begin);
  write("patch_face", looks.patch_face);
  write("patch_normal", looks.patch_normal);
  write("patch_corner_begin", looks.patch_corner_begin);
  write("patch_corner", looks.patch_corner);
  write("looked_at_stage", looks.looked_at_stage);
  write("groups_may_move", looks.groups_may_move);
}

void write_cover_arrays(File& file, const CoverArrays& covers) {
  write_lattice(file, covers.lattice);
  const std::string group = "/rockfold/covers/";
  file.write(group + "cover_node", covers.cover_node);
  if (!covers.middle.empty()) {
    file.write(group + "middle", covers.middle);
    file.write(group + "reach", std::vector<Real>{covers.reach});
  }
  file.write(group + "regular_cell", covers.regular_cell);
  file.write_wide(group + "regular_cover", covers.regular_cover, covers.nodes_per_cell());
  file.write(group + "regular_material", covers.regular_material);
  file.write(group + "regular_block", covers.regular_block);
  file.write(group + "element_cell", covers.element_cell);
  file.write(group + "element_part", covers.element_part);
  file.write_wide(group + "element_cover", covers.element_cover, covers.nodes_per_part());
  file.write(group + "element_material", covers.element_material);
  file.write(group + "piece_begin", covers.piece_begin);
  file.write(group + "piece_block", covers.piece_block);
  file.write(group + "triangle_begin", covers.triangle_begin);
  file.write_wide(group + "triangle_vertex", covers.triangle_vertex, 3);
  file.write(group + "vertex_begin", covers.vertex_begin);
  file.write_wide(group + "vertex_xyz", covers.vertex_xyz, 3);
  file.set_integers("/rockfold/covers", "order", {covers.order});
  file.set_integers("/rockfold/totals", "physical_covers", {covers.cover_count()});
  file.set_integers("/rockfold/totals", "elements", {covers.element_count()});
  file.set_integers(
      "/rockfold/totals", "pieces",
      {std::int64_t{covers.parts_per_cell()} * covers.regular_count() + covers.piece_count()});
}

void append_state(File& file, Index step, const StateArrays& state) {
  const std::string group = "/rockfold/states/";
  file.append(group + "step", std::span<const Index>(&step, 1));
  file.append_entry<Vec3>(group + "displacement", state.displacement);
  file.append_entry<Vec3>(group + "velocity", state.velocity);
  file.append(group + "time", std::span<const Real>(&state.time, 1));
}

void append_contacts(File& file, std::span<const ContactSample> contacts) {
  const auto count = static_cast<Index>(contacts.size());
  file.append("/rockfold/states/contact_count", std::span<const Index>(&count, 1));
  const auto append = [&](const char* name, const auto& value_of) {
    std::vector<std::decay_t<decltype(value_of(contacts[0]))>> values;
    values.reserve(contacts.size());
    for (const ContactSample& c : contacts) values.push_back(value_of(c));
    file.append(std::string("/rockfold/contacts/") + name,
                std::span<const typename decltype(values)::value_type>(values));
  };
  using C = const ContactSample&;
  append("place", [](C c) { return c.place; });
  append("normal", [](C c) { return c.normal; });
  append("shear_stress", [](C c) { return c.shear; });
  append("normal_stress", [](C c) { return c.normal_stress; });
  append("gap", [](C c) { return c.gap; });
  append("slip", [](C c) { return c.slip; });
  append("area", [](C c) { return c.area; });
  append("first_block", [](C c) { return c.block[0] + 1; });
  append("second_block", [](C c) { return c.block[1] + 1; });
  append("joint", [](C c) { return c.joint; });
  append("material", [](C c) { return c.material; });
  append("state", [](C c) { return static_cast<std::uint8_t>(c.state); });
}

void write_history(File& file, const std::string& group, const History& history) {
  file.write(group + "/time", history.time);
  for (const auto& column : history.columns) {
    const std::string path = group + "/" + column.name;
    if (column.width == 1)
      file.write(path, column.values);
    else
      file.write_wide(path, column.values, column.width);
    if (!column.unit.empty()) file.set_text(path, "unit", column.unit);
  }
  if (!history.name.empty()) file.set_text(group, "name", history.name);
  if (!history.joint.empty()) file.set_text(group, "joint", history.joint);
}

std::int64_t contact_bytes() {
  return 3 * sizeof(Vec3) + 4 * sizeof(Real) + 4 * sizeof(Index) + 1;
}

}  // namespace rockfold
