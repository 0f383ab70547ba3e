#include "tests/files/sample_files.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

template <typename Number>
void append(std::string& bytes, Number number, bool big_endian = false) {
  std::array<char, sizeof(Number)> buffer{};
  std::memcpy(buffer.data(), &number, sizeof(Number));
  if (big_endian) std::reverse(buffer.begin(), buffer.end());
  bytes.append(buffer.data(), buffer.size());
}

std::ostringstream precise() {
  std::ostringstream text;
  text.precision(17);
  return text;
}

std::string numbers(const Vec3& p) {
  auto text = precise();
  text << p[0] << ' ' << p[1] << ' ' << p[2];
  return text.str();
}

}  // namespace

PlainMesh box_mesh(const Vec3& min, const Vec3& max) {
  PlainMesh mesh;
  // In the order in which the faces use them.
  for (const auto& [x, y, z] : std::array<std::array<int, 3>, 8>{{{0, 0, 0},
                                                                  {0, 1, 0},
                                                                  {1, 1, 0},
                                                                  {1, 0, 0},
                                                                  {0, 0, 1},
                                                                  {1, 0, 1},
                                                                  {1, 1, 1},
                                                                  {0, 1, 1}}})
    mesh.vertices.push_back({x ? max[0] : min[0], y ? max[1] : min[1], z ? max[2] : min[2]});
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {0, 3, 5}, {0, 5, 4},
                {1, 7, 6}, {1, 6, 2}, {0, 4, 7}, {0, 7, 1}, {3, 2, 6}, {3, 6, 5}};
  return mesh;
}

PlainMesh inverted(PlainMesh mesh) {
  for (auto& face : mesh.faces) std::reverse(face.begin(), face.end());
  return mesh;
}

PlainMesh joined(PlainMesh first, const PlainMesh& second) {
  const int offset = static_cast<int>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (auto face : second.faces) {
    for (int& v : face) v += offset;
    first.faces.push_back(face);
  }
  return first;
}

std::string as_obj(const PlainMesh& mesh) {
  auto text = precise();
  text << "# a cube\no cube\n";
  for (const auto& p : mesh.vertices) text << "v " << numbers(p) << '\n';
  for (const auto& face : mesh.faces) {
    text << 'f';
    for (const int v : face) text << ' ' << v + 1;
    text << '\n';
  }
  return text.str();
}

std::string as_off(const PlainMesh& mesh) {
  auto text = precise();
  text << "OFF\n" << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
  for (const auto& p : mesh.vertices) text << numbers(p) << '\n';
  for (const auto& face : mesh.faces) {
    text << face.size();
    for (const int v : face) text << ' ' << v;
    text << '\n';
  }
  return text.str();
}

std::string as_text_stl(const PlainMesh& mesh) {
  auto text = precise();
  text << "solid cube\n";
  for (const auto& face : mesh.faces) {
    text << " facet normal 0 0 0\n  outer loop\n";
    for (const int v : face)
      text << "   vertex " << numbers(mesh.vertices[static_cast<std::size_t>(v)]) << '\n';
    text << "  endloop\n endfacet\n";
  }
  text << "endsolid cube\n";
  return text.str();
}

std::string as_binary_stl(const PlainMesh& mesh) {
  std::string bytes = "solid in name only";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.faces.size()));
  for (const auto& face : mesh.faces) {
    bytes.append(12, '\0');
    for (const int v : face)
      for (const Real x : mesh.vertices[static_cast<std::size_t>(v)])
        append(bytes, static_cast<float>(x));
    bytes.append(2, '\0');
  }
  return bytes;
}

namespace {

std::string ply_header(const PlainMesh& mesh, const std::string& format) {
  return "ply\nformat " + format + " 1.0\ncomment a cube\nelement vertex " +
         std::to_string(mesh.vertices.size()) +
         "\nproperty double x\nproperty double y\nproperty uchar red\nproperty double z\n"
         "element face " +
         std::to_string(mesh.faces.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

}  // namespace

std::string as_text_ply(const PlainMesh& mesh) {
  auto text = precise();
  text << ply_header(mesh, "ascii");
  for (const auto& p : mesh.vertices) text << p[0] << ' ' << p[1] << " 255 " << p[2] << '\n';
  for (const auto& face : mesh.faces) {
    text << face.size();
    for (const int v : face) text << ' ' << v;
    text << '\n';
  }
  return text.str();
}

std::string as_binary_ply(const PlainMesh& mesh, bool big_endian) {
  std::string bytes = ply_header(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& p : mesh.vertices) {
    append(bytes, p[0], big_endian);
    append(bytes, p[1], big_endian);
    append(bytes, std::uint8_t{255});
    append(bytes, p[2], big_endian);
  }
  for (const auto& face : mesh.faces) {
    append(bytes, static_cast<std::uint8_t>(face.size()));
    for (const int v : face) append(bytes, static_cast<std::int32_t>(v), big_endian);
  }
  return bytes;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "rockfold-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
  folder_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, std::string_view bytes) const {
  std::ofstream(folder_ / name, std::ios::binary) << bytes;
  return path(name);
}

std::string listed(const std::vector<Diagnostic>& errors) {
  std::string text;
  for (const auto& [place, message] : errors)
    text += std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + message + "\n";
  return text;
}

Real six_volumes(const TriangleSurface& surface) {
  Real sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += dot(surface.vertices[static_cast<std::size_t>(a)],
               cross(surface.vertices[static_cast<std::size_t>(b)],
                     surface.vertices[static_cast<std::size_t>(c)]));
  return sum;
}

Real double_plan_area(const TriangleSurface& ground) {
  Real sum = 0;
  for (const auto& [a, b, c] : ground.triangles) {
    const Vec3& origin = ground.vertices[static_cast<std::size_t>(a)];
    sum += cross(ground.vertices[static_cast<std::size_t>(b)] - origin,
                 ground.vertices[static_cast<std::size_t>(c)] - origin)[2];
  }
  return sum;
}

}  // namespace rockfold
