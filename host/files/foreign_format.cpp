#include "host/files/foreign_format.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "host/files/text.hpp"
#include "src/model/text/file_kind.hpp"

namespace rockfold {

namespace {

enum class Kind { raster, cloud, surface, mesh, grid, features };
constexpr std::size_t use_count = 3;

/// What to do about a file of each kind as ground, as mesh and as table; "" = it is read.
constexpr std::array<std::array<std::string_view, use_count>, 6> advice = {{
    {"convert it to an ESRI ASCII grid, as gdal_translate -of AAIGrid does",
     "convert it to an ESRI ASCII grid, as gdal_translate -of AAIGrid does, for shape = "
     "\"terrain\"",
     "a table of joints is CSV with a heading"},
    {"convert it to XYZ: text, x, y and z of a post of the ground a line",
     "make triangles of it, OBJ, OFF, STL or PLY", "a table of joints is CSV with a heading"},
    {"convert it to XYZ or an ESRI ASCII grid; a closed surface to OBJ, OFF, STL or PLY for shape "
     "= "
     "\"mesh\"",
     "convert its triangles to OBJ, OFF, STL or PLY",
     "convert its triangles to OBJ, OFF, STL or PLY for [[joint_mesh]]"},
    {"shape = \"mesh\" reads it where it is closed; a ground is an ESRI ASCII grid or XYZ", "",
     "[[joint_mesh]] reads it"},
    {"", "shape = \"terrain\" reads it", "a table of joints is CSV with a heading"},
    {"convert it to XYZ or an ESRI ASCII grid", "convert it to OBJ, OFF, STL or PLY",
     "convert it to CSV with a heading"},
}};

struct Format {
  std::string_view begin;  ///< lower case where the format is text
  bool text;
  Kind kind;
  std::string_view name;
};

using namespace std::string_view_literals;

constexpr Format formats[] = {
    {"II*\0"sv, false, Kind::raster, "a TIFF picture (GeoTIFF)"},
    {"MM\0*"sv, false, Kind::raster, "a TIFF picture (GeoTIFF)"},
    {"II+\0"sv, false, Kind::raster, "a BigTIFF picture (GeoTIFF)"},
    {"DSAA"sv, false, Kind::raster, "a Surfer grid"},
    {"DSBB"sv, false, Kind::raster, "a binary Surfer grid"},
    {"DSRB"sv, false, Kind::raster, "a binary Surfer grid"},
    {"CDF\1"sv, false, Kind::raster, "a NetCDF file"},
    {"CDF\2"sv, false, Kind::raster, "a NetCDF file"},
    {"LASF"sv, false, Kind::cloud, "a LAS or LAZ point cloud"},
    {"ASTM-E57"sv, false, Kind::cloud, "an E57 point cloud"},
    {"# .pcd"sv, true, Kind::cloud, "a PCD point cloud"},
    {"# vtk datafile"sv, true, Kind::surface, "a VTK file"},
    {"<vtkfile"sv, true, Kind::surface, "a VTK XML file"},
    {"<?xml"sv, true, Kind::surface, "an XML file (VTK, LandXML)"},
    {"autocad binary dxf"sv, true, Kind::surface, "a binary DXF drawing"},
    {"AC10"sv, false, Kind::surface, "a DWG drawing"},
    {"iso-10303-21"sv, true, Kind::surface, "a STEP or IFC file"},
    {"gocad "sv, true, Kind::surface, "a GOCAD file"},
    {"glTF"sv, false, Kind::surface, "a glTF scene"},
    {"Kaydara FBX"sv, false, Kind::surface, "an FBX scene"},
    {"\0\0\x27\x0a"sv, false, Kind::features, "a shapefile"},
    {"ply\n"sv, true, Kind::mesh, "a PLY mesh"},
    {"ply\r"sv, true, Kind::mesh, "a PLY mesh"},
    {"off\n"sv, true, Kind::mesh, "an OFF mesh"},
    {"off\r"sv, true, Kind::mesh, "an OFF mesh"},
    {"solid "sv, true, Kind::mesh, "an STL mesh"},
    {"ncols"sv, true, Kind::grid, "an ESRI ASCII grid"},
};

/// The next line with anything in it, without blanks around; none at the end.
std::optional<std::string_view> next_line(Lines& lines) {
  while (lines.next())
    if (const auto line = trimmed(lines.line()); !line.empty()) return line;
  return {};
}

std::size_t count_numbers(std::string_view line) {
  Words words(line);
  std::size_t count = 0;
  for (auto word = words.next(); parse_number(word); word = words.next()) ++count;
  return count;
}

/// Group codes and values by turns; the first ones open a section, or are comments.
bool is_dxf(std::string_view bytes) {
  Lines lines(bytes);
  auto code = next_line(lines);
  while (code == "999"sv && next_line(lines)) code = next_line(lines);
  return code == "0"sv && next_line(lines) == "SECTION"sv;
}

/// A count, then the points.
bool is_pts(std::string_view bytes) {
  Lines lines(bytes);
  const auto first = next_line(lines), second = next_line(lines);
  return first && second && parse_integer(*first) && count_numbers(*second) >= 3;
}

std::string told(std::string_view name, Kind kind, FileUse use) {
  const auto what = advice[static_cast<std::size_t>(kind)][static_cast<std::size_t>(use)];
  return what.empty() ? "" : fmt::format("is {}: {}", name, what);
}

}  // namespace

std::string foreign_format(std::string_view bytes, FileUse use) {
  constexpr std::size_t looked_at = 64;
  const std::string lower = lower_case(bytes.substr(0, looked_at));
  for (const auto& [begin, text, kind, name] : formats)
    if (text ? lower.starts_with(begin) : bytes.starts_with(begin)) return told(name, kind, use);
  if (is_dxf(bytes)) return told("a DXF drawing", Kind::surface, use);
  if (use == FileUse::ground && is_pts(bytes))
    return "is a PTS point cloud: without its first line, the count of its points, it is XYZ";
  const auto kind = known_kind(bytes);
  return kind.empty() ? "" : "is " + kind;
}

}  // namespace rockfold
