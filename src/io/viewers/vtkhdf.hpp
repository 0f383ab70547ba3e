// The part of a result file that ParaView reads: VTKHDF 2.1, a MultiBlockDataSet of PolyData and
// UnstructuredGrid whose mesh stands once and whose fields are appended state by state. Beside it
// virtual data sets for XDMF.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html#vtkhdf-file-format
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "src/io/hdf5/hdf5_file.hpp"
#include "src/io/viewers/element_mesh.hpp"

namespace rockfold::vtkhdf {

/// A field of a grid as the XDMF text names it.
struct Field {
  std::string name;
  hdf5::Type type = hdf5::Type::float32;
  int width = 1;
  bool at_points = false;
  bool of_states = false;  ///< a value for each state, else one for all
};

/// One block of the MultiBlockDataSet: what was written of it.
struct Grid {
  std::string name;      ///< "Blocks", "Joints", "Elements"
  bool polygons = true;  ///< or lines, else tetrahedra
  std::int64_t points = 0, cells = 0;
  std::int64_t mixed_length = 0;  ///< of XDMF's own connectivity of polygons
  std::vector<Field> fields;

  std::string path() const { return "/VTKHDF/" + name; }
};

/// The group /VTKHDF with an empty assembly.
void write_root(hdf5::File& file);

/// Polygons with N+1 offsets into `connectivity`; `index` counts the blocks from 0.
Grid write_polygons(hdf5::File& file, const std::string& name, int index,
                    const std::vector<Vec3>& points, const std::vector<Index>& offsets,
                    const std::vector<Index>& connectivity);
/// Lines between two points each.
Grid write_lines(hdf5::File& file, const std::string& name, int index,
                 const std::vector<Vec3>& points, const std::vector<std::array<Index, 2>>& lines);
Grid write_tetrahedra(hdf5::File& file, const std::string& name, int index,
                      const ElementMesh& mesh);

/// A value for each cell that all states share.
template <typename T>
void write_cell_field(hdf5::File& file, Grid& grid, const std::string& name,
                      const std::vector<T>& values) {
  file.write(grid.path() + "/CellData/" + name, values);
  grid.fields.push_back({name, hdf5::Row<T>::type, hdf5::Row<T>::width, false, false});
}

/// The values of state number `state` (from 0) at the points, or in the cells; T is float, or 3 or 6 of them.
template <typename T>
void append_point_field(hdf5::File& file, Grid& grid, const std::string& name, std::int64_t state,
                        const std::vector<T>& values);
template <typename T>
void append_cell_field(hdf5::File& file, Grid& grid, const std::string& name, std::int64_t state,
                       const std::vector<T>& values);

/// After the fields of a state were appended to all grids and its time to `times`: makes the state
/// known to readers.
void append_step(hdf5::File& file, std::span<const Grid> grids, const std::string& times,
                 std::int64_t state);

/// What appending a field of `width` numbers a row writes for a state, in bytes.
std::int64_t state_bytes(std::size_t rows, int width);

/// Where the values of a field stand: of one state, or of all.
std::string field_path(const Grid& grid, const Field& field, std::int64_t state);
/// Where XDMF's connectivity of polygons stands.
std::string mixed_path(const Grid& grid);

}  // namespace rockfold::vtkhdf
