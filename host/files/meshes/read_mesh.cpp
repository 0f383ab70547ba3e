#include "host/files/meshes/read_mesh.hpp"

#include <array>
#include <memory>
#include <utility>

#include "host/files/hardly_meant.hpp"
#include "host/files/meshes/last_digit.hpp"
#include "host/files/meshes/mesh_surface.hpp"
#include "host/files/meshes/polygon_soup.hpp"
#include "host/files/meshes/separate_bodies.hpp"
#include "host/files/text.hpp"

namespace rockfold {

namespace {

PolygonSoup read_soup(std::string_view bytes, MeshFormat format, Faults& faults) {
  switch (format) {
    case MeshFormat::obj:
      return read_obj(bytes, faults);
    case MeshFormat::off:
      return read_off(bytes, faults);
    case MeshFormat::stl:
      return read_stl(bytes, faults);
    case MeshFormat::ply:
      break;
  }
  return read_ply(bytes, faults);
}

}  // namespace

std::optional<MeshFormat> mesh_format(const std::string& file) {
  constexpr std::array<std::pair<std::string_view, MeshFormat>, 4> formats = {
      std::pair{".obj", MeshFormat::obj},
      {".off", MeshFormat::off},
      {".stl", MeshFormat::stl},
      {".ply", MeshFormat::ply}};
  const std::string name = lower_case(file);
  for (const auto& [ending, format] : formats)
    if (name.ends_with(ending)) return format;
  return {};
}

TriangleSurface read_mesh(std::string_view bytes, MeshFormat format, MeshUse use,
                          const Place& place, std::vector<Diagnostic>* warnings) {
  Faults faults(place);
  const bool is_solid = use == MeshUse::solid;
  const PolygonSoup soup = read_soup(bytes, format, faults);
  const Real digit = last_digit(soup.vertices, soup.single_precision);
  MeshTriangles mesh = make_triangles(soup, is_solid, faults, is_solid ? digit : 0);
  if (is_solid) check_solid(mesh, faults, MeshHint::may_be_bodies);
  mesh.surface.last_digit = digit;
  if (warnings && soup.single_precision)
    if (auto found = coarse_coordinates(mesh.surface, is_solid, place))
      warnings->push_back(std::move(*found));
  return std::move(mesh.surface);
}

std::vector<FileBody> read_bodies(std::string_view bytes, MeshFormat format, const Place& place) {
  Faults faults(place);
  const PolygonSoup whole = read_soup(bytes, format, faults);
  const Real digit = last_digit(whole.vertices, whole.single_precision);
  std::vector<FileBody> bodies;
  for (const SoupBody& body : separate_bodies(whole, format == MeshFormat::stl)) {
    MeshTriangles mesh = make_triangles(body.soup, true, faults, digit);
    check_solid(mesh, faults, MeshHint::bodies_share_corners);
    mesh.surface.last_digit = digit;
    bodies.push_back({body.name, std::make_shared<TriangleSurface>(std::move(mesh.surface))});
  }
  if (bodies.empty()) faults.fail("has no faces, so no body");
  return bodies;
}

}  // namespace rockfold
