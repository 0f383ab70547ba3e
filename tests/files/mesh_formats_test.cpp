// Every format says the same, and what is right is read right.
#include <cmath>

#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

/// Off the origin and irregular; coordinates that a float holds.
const Vec3 low{1.5, -2.25, 3}, high{2.75, 4.5, 3.125};

TriangleSurface solid_of(std::string_view bytes, MeshFormat format) {
  return read_mesh(bytes, format, MeshUse::solid, sample_place);
}

struct Format {
  const char* name;
  MeshFormat format;
  std::string (*write)(const PlainMesh&);
};

const Format all_formats[] = {
    {"obj", MeshFormat::obj, as_obj},
    {"off", MeshFormat::off, as_off},
    {"text stl", MeshFormat::stl, as_text_stl},
    {"binary stl", MeshFormat::stl, as_binary_stl},
    {"text ply", MeshFormat::ply, as_text_ply},
    {"little-endian ply", MeshFormat::ply,
     [](const PlainMesh& mesh) { return as_binary_ply(mesh, false); }},
    {"big-endian ply", MeshFormat::ply,
     [](const PlainMesh& mesh) { return as_binary_ply(mesh, true); }},
};

std::string with_crlf(const std::string& text) {
  std::string result = "\xEF\xBB\xBF";
  for (const char c : text) result += c == '\n' ? "\r\n" : std::string(1, c);
  return result;
}

}  // namespace

TEST(MeshFormats, AllGiveTheSameSurface) {
  const PlainMesh box = box_mesh(low, high);
  for (const auto& [name, format, write] : all_formats) {
    const auto surface = solid_of(write(box), format);
    EXPECT_EQ(surface.vertices, box.vertices) << name;
    ASSERT_EQ(surface.triangles.size(), 12u) << name;
    for (std::size_t t = 0; t < 12; ++t)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(surface.triangles[t][i], box.faces[t][i]) << name << ", triangle " << t;
    EXPECT_EQ(six_volumes(surface), 6 * 1.25 * 6.75 * 0.125) << name;
  }
}

TEST(MeshFormats, ObjLinesMayGoOn) {
  const std::string whole =
      "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n# C:\\\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const std::string parted =
      "v 0 \\\n0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n# C:\\\nf 1 3 2\nf 1 \\\r\n  2\\\n4\nf 2 3 4\nf 3 1 "
      "4\n";
  const auto expected = solid_of(whole, MeshFormat::obj), found = solid_of(parted, MeshFormat::obj);
  EXPECT_EQ(found.vertices, expected.vertices);
  EXPECT_EQ(found.triangles, expected.triangles);
  const auto errors =
      errors_of_reading([&] { solid_of(parted + "f 1 2 \\\n3\nf 9 1 2\n", MeshFormat::obj); });
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors[0].place.line, 15) << listed(errors);
}

TEST(MeshFormats, MayHaveAByteOrderMarkAndLinesOfOtherSystems) {
  const PlainMesh box = box_mesh(low, high);
  for (const auto& [name, format, write] :
       {all_formats[0], all_formats[1], all_formats[2], all_formats[4]})
    EXPECT_EQ(solid_of(with_crlf(write(box)), format).triangles.size(), 12u) << name;
}

TEST(MeshFormats, ObjMayNameNormalsAndCountBack) {
  const auto surface = read_mesh(
      "mtllib a.mtl\nv 0 0 0 1\nv 1 0 0\nv 0 1 0 .5 .5 .5\nvn 0 0 1\nvt 0 0\nusemtl rock\ns off\n"
      "f 1/1/1 2//1 3/1\nv 0 0 5\nf -1 -4 -3",
      MeshFormat::obj, MeshUse::joints, sample_place);
  ASSERT_EQ(surface.triangles.size(), 2u);
  EXPECT_EQ(surface.triangles[1], (std::array<Index, 3>{3, 0, 1}));
}

TEST(MeshFormats, OffMayHaveColoursAndComments) {
  const auto surface = read_mesh(
      "# made by hand\nCOFF 3 1 0\n\n0 0 0 255 0 0 # red\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2 0.5 1 "
      "1",
      MeshFormat::off, MeshUse::joints, sample_place);
  EXPECT_EQ(surface.triangles.size(), 1u);
}

TEST(MeshFormats, StlMayHoldSeveralSolids) {
  const PlainMesh one = box_mesh({0, 0, 0}, {1, 1, 1}), two = box_mesh({2, 0, 0}, {3, 1, 1});
  EXPECT_EQ(six_volumes(solid_of(as_text_stl(one) + as_text_stl(two), MeshFormat::stl)), 12);
}

TEST(MeshFormats, PlyElementsThatAreNotKnownArePassedOver) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement camera 1\nproperty float focus\nproperty list uchar float "
      "lens\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty uchar flags\nproperty list uint8 uint32 vertex_index\n"
      "element edge 1\nproperty int a\nproperty int b\nend_header\n"
      "1.5 2 7 7\n0 0 0\n1 0 0\n0 1 0\n9 3 2 1 0\n0 1\n";
  const auto surface = read_mesh(text, MeshFormat::ply, MeshUse::joints, sample_place);
  EXPECT_EQ(surface.vertices[0], (Vec3{0, 1, 0}));
}

TEST(MeshFormats, AreToldByTheEndOfTheName) {
  EXPECT_EQ(mesh_format("a.b/Rock.STL"), MeshFormat::stl);
  EXPECT_EQ(mesh_format("rock.Ply"), MeshFormat::ply);
  EXPECT_EQ(mesh_format("rock.obj.txt"), std::nullopt);
}

TEST(MeshPolygons, AreSplitIntoTriangles) {
  // A concave prism: an L of 3 × 3 without its upper right 2 × 2, four high; its ends are hexagons.
  const std::string text =
      "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"
      "v 0 0 4\nv 3 0 4\nv 3 1 4\nv 1 1 4\nv 1 3 4\nv 0 3 4\n"
      "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n"
      "f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";
  const auto surface = solid_of(text, MeshFormat::obj);
  EXPECT_EQ(surface.triangles.size(), 2 * 4 + 6 * 2u);
  EXPECT_EQ(six_volumes(surface), 6 * 5 * 4);
}

TEST(MeshPolygons, MayBeConcaveQuadrilaterals) {
  const auto surface = read_mesh("v 0 0 0\nv 4 0 0\nv 1 0 1\nv 0 0 4\nf 1 2 3 4\n", MeshFormat::obj,
                                 MeshUse::joints, sample_place);
  ASSERT_EQ(surface.triangles.size(), 2u);
  for (const auto& triangle : surface.triangles)  // both hold the inner corner and the outer one
    EXPECT_EQ(std::count(triangle.begin(), triangle.end(), 0) +
                  std::count(triangle.begin(), triangle.end(), 2),
              2);
}

TEST(MeshSolids, MayHaveCavitiesAndPartsWithinThem) {
  auto mesh = joined(box_mesh({0, 0, 0}, {9, 9, 9}), inverted(box_mesh({1, 1, 1}, {8, 8, 8})));
  mesh = joined(mesh, box_mesh({3, 3, 3}, {5, 5, 5}));
  EXPECT_EQ(six_volumes(solid_of(as_off(mesh), MeshFormat::off)), 6 * (729 - 343 + 8));
}

TEST(MeshSolids, AreStitchedWhereTheirVerticesAreTheSame) {
  PlainMesh mesh = box_mesh(low, high), separate;
  for (const auto& face : mesh.faces) {
    for (const int v : face)
      separate.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    const int n = static_cast<int>(separate.vertices.size());
    separate.faces.push_back({n - 3, n - 2, n - 1});
  }
  separate.vertices[4][0] = separate.vertices[4][0];
  const auto surface = solid_of(as_obj(separate), MeshFormat::obj);
  EXPECT_EQ(surface.vertices, mesh.vertices);
}

TEST(MeshSolids, LeaveOutTrianglesOfTwoEqualCorners) {
  PlainMesh mesh = box_mesh(low, high);
  mesh.faces.push_back({0, 1, 1});
  EXPECT_EQ(solid_of(as_obj(mesh), MeshFormat::obj).triangles.size(), 12u);
}

TEST(MeshSolids, AtMapCoordinatesAreCheckedExactly) {
  // 1e-9 m thick at 5e6 m: one step of the doubles there.
  const Vec3 corner{5e6, 4e6, 1000};
  PlainMesh plate = box_mesh(corner, {5e6 + 1, 4e6 + 1, std::nextafter(1000, 2000)});
  EXPECT_EQ(solid_of(as_off(plate), MeshFormat::off).triangles.size(), 12u);
  EXPECT_NE(listed(errors_of_reading([&] {
              solid_of(as_off(inverted(plate)), MeshFormat::off);
            })).find("inside out"),
            std::string::npos);
}

}  // namespace rockfold
