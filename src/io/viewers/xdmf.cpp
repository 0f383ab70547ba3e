#include "src/io/viewers/xdmf.hpp"

#include <iterator>

#include <fmt/format.h>

namespace rockfold {
namespace {

using vtkhdf::Field;
using vtkhdf::Grid;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// NumberType and Precision of a DataItem.
const char* number_type(hdf5::Type type) {
  switch (type) {
    case hdf5::Type::uint8:
      return R"(NumberType="UChar" Precision="1")";
    case hdf5::Type::int32:
      return R"(NumberType="Int" Precision="4")";
    case hdf5::Type::int64:
      return R"(NumberType="Int" Precision="8")";
    case hdf5::Type::float32:
      return R"(NumberType="Float" Precision="4")";
    case hdf5::Type::float64:
      return R"(NumberType="Float" Precision="8")";
  }
  return "";
}

class XdmfWriter {
 public:
  explicit XdmfWriter(const std::string& file_name) : file_(escaped(file_name)) {}

  void line(int depth, const std::string& text) {
    text_ += std::string(2 * static_cast<std::size_t>(depth), ' ') + text + "\n";
  }

  std::string data_item(const std::string& dimensions, hdf5::Type type,
                        const std::string& path) const {
    return fmt::format(R"(<DataItem Format="HDF" Dimensions="{}" {}>{}:{}</DataItem>)", dimensions,
                       number_type(type), file_, path);
  }

  void mesh(int depth, const Grid& grid) {
    if (grid.polygons) {
      line(depth,
           fmt::format(
               R"(<Topology TopologyType="Mixed" NumberOfElements="{}">{}</Topology>)", grid.cells,
               data_item(std::to_string(grid.mixed_length), hdf5::Type::int32, mixed_path(grid))));
    } else {
      line(depth, fmt::format(
                      R"(<Topology TopologyType="Tetrahedron" NumberOfElements="{}">{}</Topology>)",
                      grid.cells,
                      data_item(fmt::format("{} 4", grid.cells), hdf5::Type::int32,
                                grid.path() + "/Connectivity")));
    }
    line(depth, fmt::format(R"(<Geometry GeometryType="XYZ">{}</Geometry>)",
                            data_item(fmt::format("{} 3", grid.points), hdf5::Type::float64,
                                      grid.path() + "/Points")));
  }

  void field(int depth, const Grid& grid, const Field& field, std::int64_t state) {
    const std::int64_t rows = field.at_points ? grid.points : grid.cells;
    // Six components are a Matrix: Tensor6 means another order of them.
    const char* kind = field.width == 1 ? "Scalar" : field.width == 3 ? "Vector" : "Matrix";
    const std::string dimensions =
        field.width == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, field.width);
    line(depth,
         fmt::format(R"(<Attribute Name="{}" Center="{}" AttributeType="{}">{}</Attribute>)",
                     field.name, field.at_points ? "Node" : "Cell", kind,
                     data_item(dimensions, field.type, vtkhdf::field_path(grid, field, state))));
  }

  /// All grids at one time; `time` is a line of its own, or empty.
  void state(int depth, std::span<const Grid> grids, std::int64_t number, const std::string& time) {
    line(depth, R"(<Grid Name="rockfold" GridType="Collection" CollectionType="Spatial">)");
    if (!time.empty()) line(depth + 1, time);
    for (const Grid& grid : grids) {
      line(depth + 1, fmt::format(R"(<Grid Name="{}" GridType="Uniform">)", grid.name));
      mesh(depth + 2, grid);
      for (const Field& one : grid.fields) field(depth + 2, grid, one, number);
      line(depth + 1, "</Grid>");
    }
    line(depth, "</Grid>");
  }

  std::string take() { return std::move(text_); }

 private:
  std::string file_, text_;
};

}  // namespace

std::string xdmf_text(const std::string& file_name, std::span<const Grid> grids,
                      const std::vector<Real>& times) {
  XdmfWriter xdmf(file_name);
  xdmf.line(0, R"(<?xml version="1.0"?>)");
  xdmf.line(0, R"(<Xdmf Version="2.0">)");
  xdmf.line(1, "<Domain>");
  if (times.empty()) {
    xdmf.state(2, grids, 0, "");
  } else {
    xdmf.line(2, R"(<Grid Name="states" GridType="Collection" CollectionType="Temporal">)");
    for (std::size_t s = 0; s < times.size(); ++s)
      xdmf.state(3, grids, static_cast<std::int64_t>(s),
                 fmt::format(R"(<Time Value="{}"/>)", times[s]));
    xdmf.line(2, "</Grid>");
  }
  xdmf.line(1, "</Domain>");
  xdmf.line(0, "</Xdmf>");
  return xdmf.take();
}

}  // namespace rockfold
