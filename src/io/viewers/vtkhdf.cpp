#include "src/io/viewers/vtkhdf.hpp"

#include <algorithm>

namespace rockfold::vtkhdf {
namespace {

using hdf5::File;

constexpr std::uint8_t vtk_tetra = 10;
constexpr Index xdmf_polyline = 2, xdmf_polygon = 3;

void write_header(File& file, const std::string& path, const std::string& type) {
  file.make_group(path);
  file.set_integers(path, "Version", {2, 1});
  file.set_text(path, "Type", type);
}

/// A data set of its own for each block, and a link to it in the assembly, which the readers
/// follow.
void write_block_header(File& file, const Grid& grid, const std::string& type, int index) {
  write_header(file, grid.path(), type);
  file.set_integers(grid.path(), "Index", {index});
  file.soft_link(grid.path(), "/VTKHDF/Assembly/" + grid.name);
  for (const char* group : {"/PointData", "/CellData"}) file.make_group(grid.path() + group);
}

void write_count(File& file, const std::string& path, std::int64_t count) {
  file.write(path, std::vector<std::int64_t>{count});
}

/// One of the four cell arrays of PolyData.
void write_cell_array(File& file, const std::string& path, const std::vector<Index>& offsets,
                      const std::vector<Index>& connectivity) {
  write_count(file, path + "/NumberOfCells", static_cast<std::int64_t>(offsets.size()) - 1);
  write_count(file, path + "/NumberOfConnectivityIds",
              static_cast<std::int64_t>(connectivity.size()));
  file.write(path + "/Offsets", offsets);
  file.write(path + "/Connectivity", connectivity);
}

/// XDMF's mixed connectivity: for each cell its type, its number of corners, its corners.
std::vector<Index> mixed_connectivity(Index type, const std::vector<Index>& offsets,
                                      const std::vector<Index>& connectivity) {
  std::vector<Index> mixed;
  mixed.reserve(connectivity.size() + 2 * offsets.size());
  for (std::size_t p = 0; p + 1 < offsets.size(); ++p) {
    mixed.push_back(type);
    mixed.push_back(offsets[p + 1] - offsets[p]);
    mixed.insert(mixed.end(), connectivity.begin() + offsets[p],
                 connectivity.begin() + offsets[p + 1]);
  }
  return mixed;
}

template <typename T>
void append_one(File& file, const std::string& path, const T& value) {
  file.append(path, std::span<const T>(&value, 1));
}

template <class T>
void append_field(File& file, Grid& grid, Field field, std::int64_t state,
                  std::span<const T> values) {
  const std::string data =
      grid.path() + (field.at_points ? "/PointData/" : "/CellData/") + field.name;
  const std::string offsets =
      grid.path() + (field.at_points ? "/Steps/PointDataOffsets/" : "/Steps/CellDataOffsets/");
  const auto rows = static_cast<std::int64_t>(values.size());
  file.append(data, values, !field.at_points);  // the cells of an element have one value
  append_one<std::int64_t>(file, offsets + field.name, state * rows);
  file.write_virtual_rows(field_path(grid, field, state), data, state * rows, rows);
  if (state == 0) grid.fields.push_back(std::move(field));
}

/// Offsets of the mesh, which is the same in all states, stand once and are linked into every
/// block.
void append_mesh_offsets(File& file, const std::string& steps) {
  append_one<std::int64_t>(file, steps + "/PartOffsets", 0);
  append_one<std::int64_t>(file, steps + "/NumberOfParts", 1);
  append_one<std::array<std::int64_t, 4>>(file, steps + "/CellOffsets", {});
}

void link_mesh_offsets(File& file, const Grid& grid, const std::string& shared) {
  const std::string steps = grid.path() + "/Steps";
  const auto link = [&](const char* existing, const char* name) {
    if (!file.exists(steps + name)) file.hard_link(shared + existing, steps + name);
  };
  link("/PartOffsets", "/PartOffsets");
  link("/NumberOfParts", "/NumberOfParts");
  link("/PartOffsets", "/PointOffsets");
  for (const char* name : {"/CellOffsets", "/ConnectivityIdOffsets"})
    link(grid.polygons ? "/CellOffsets" : "/PartOffsets", name);
}

}  // namespace

void write_root(File& file) {
  write_header(file, "/VTKHDF", "MultiBlockDataSet");
  file.make_group("/VTKHDF/Assembly");
}

namespace {

/// Cells of one kind: "/Lines" or "/Polygons".
Grid write_poly_data(File& file, const std::string& name, int index,
                     const std::vector<Vec3>& points, const std::string& kind, Index type,
                     const std::vector<Index>& offsets, const std::vector<Index>& connectivity) {
  Grid grid{name,
            true,
            static_cast<std::int64_t>(points.size()),
            static_cast<std::int64_t>(offsets.size()) - 1,
            0,
            {}};
  write_block_header(file, grid, "PolyData", index);
  write_count(file, grid.path() + "/NumberOfPoints", grid.points);
  file.write(grid.path() + "/Points", points);
  for (const std::string cells : {"/Vertices", "/Lines", "/Strips", "/Polygons"})
    if (cells != kind) write_cell_array(file, grid.path() + cells, {0}, {});
  write_cell_array(file, grid.path() + kind, offsets, connectivity);
  const std::vector<Index> mixed = mixed_connectivity(type, offsets, connectivity);
  grid.mixed_length = static_cast<std::int64_t>(mixed.size());
  file.write(mixed_path(grid), mixed);
  return grid;
}

}  // namespace

Grid write_polygons(File& file, const std::string& name, int index, const std::vector<Vec3>& points,
                    const std::vector<Index>& offsets, const std::vector<Index>& connectivity) {
  return write_poly_data(file, name, index, points, "/Polygons", xdmf_polygon, offsets,
                         connectivity);
}

Grid write_lines(File& file, const std::string& name, int index, const std::vector<Vec3>& points,
                 const std::vector<std::array<Index, 2>>& lines) {
  std::vector<Index> offsets{0}, connectivity;
  for (const auto& [from, to] : lines) {
    connectivity.push_back(from);
    connectivity.push_back(to);
    offsets.push_back(static_cast<Index>(connectivity.size()));
  }
  return write_poly_data(file, name, index, points, "/Lines", xdmf_polyline, offsets, connectivity);
}

Grid write_tetrahedra(File& file, const std::string& name, int index, const ElementMesh& mesh) {
  Grid grid{name,
            false,
            static_cast<std::int64_t>(mesh.point.size()),
            static_cast<std::int64_t>(mesh.tetrahedron.size()),
            0,
            {}};
  write_block_header(file, grid, "UnstructuredGrid", index);
  std::vector<Index> offsets(mesh.tetrahedron.size() + 1), connectivity;
  for (std::size_t t = 0; t < offsets.size(); ++t) offsets[t] = static_cast<Index>(4 * t);
  connectivity.reserve(4 * mesh.tetrahedron.size());
  for (const auto& corners : mesh.tetrahedron)
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
  write_count(file, grid.path() + "/NumberOfPoints", grid.points);
  file.write(grid.path() + "/Points", mesh.point);
  write_cell_array(file, grid.path(), offsets, connectivity);
  file.write(grid.path() + "/Types", std::vector<std::uint8_t>(mesh.tetrahedron.size(), vtk_tetra));
  return grid;
}

template <typename T>
void append_point_field(File& file, Grid& grid, const std::string& name, std::int64_t state,
                        const std::vector<T>& values) {
  append_field<T>(file, grid, {name, hdf5::Row<T>::type, hdf5::Row<T>::width, true, true}, state,
                  values);
}
template <typename T>
void append_cell_field(File& file, Grid& grid, const std::string& name, std::int64_t state,
                       const std::vector<T>& values) {
  append_field<T>(file, grid, {name, hdf5::Row<T>::type, hdf5::Row<T>::width, false, true}, state,
                  values);
}

using Three = std::array<float, 3>;
using Six = std::array<float, 6>;
template void append_point_field(File&, Grid&, const std::string&, std::int64_t,
                                 const std::vector<float>&);
template void append_point_field(File&, Grid&, const std::string&, std::int64_t,
                                 const std::vector<Three>&);
template void append_point_field(File&, Grid&, const std::string&, std::int64_t,
                                 const std::vector<Six>&);
template void append_cell_field(File&, Grid&, const std::string&, std::int64_t,
                                const std::vector<std::uint8_t>&);
template void append_cell_field(File&, Grid&, const std::string&, std::int64_t,
                                const std::vector<float>&);
template void append_cell_field(File&, Grid&, const std::string&, std::int64_t,
                                const std::vector<Three>&);
template void append_cell_field(File&, Grid&, const std::string&, std::int64_t,
                                const std::vector<Six>&);

void append_step(File& file, std::span<const Grid> grids, const std::string& times,
                 std::int64_t state) {
  const std::string shared = grids.front().path() + "/Steps";
  append_mesh_offsets(file, shared);
  for (const Grid& grid : grids) {
    const std::string steps = grid.path() + "/Steps";
    if (state == 0) {
      for (const char* offsets : {"/PointDataOffsets", "/CellDataOffsets"})
        file.make_group(steps + offsets);
      link_mesh_offsets(file, grid, shared);
      file.hard_link(times, steps + "/Values");
    }
    file.set_integers(steps, "NSteps", {state + 1});
  }
}

std::int64_t state_bytes(std::size_t rows, int width) {
  return static_cast<std::int64_t>(rows * sizeof(float)) * width;
}

std::string field_path(const Grid& grid, const Field& field, std::int64_t state) {
  if (field.of_states) return "/xdmf/" + grid.name + "/" + field.name + "/" + std::to_string(state);
  return grid.path() + (field.at_points ? "/PointData/" : "/CellData/") + field.name;
}

std::string mixed_path(const Grid& grid) {
  return "/xdmf/connectivity/" + grid.name;
}

}  // namespace rockfold::vtkhdf
