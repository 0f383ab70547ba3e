// Wrong mesh files, one a line: what the message must say, and where.
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

struct BrokenMesh {
  std::string bytes;
  MeshFormat format;
  MeshUse use;
  int line, column;     ///< of the first error
  const char* says[3];  ///< parts of the messages
};

constexpr auto obj = MeshFormat::obj;
constexpr auto off = MeshFormat::off;
constexpr auto stl = MeshFormat::stl;
constexpr auto ply = MeshFormat::ply;
constexpr auto solid = MeshUse::solid;
constexpr auto joints = MeshUse::joints;

void expect_refused(const BrokenMesh& wrong) {
  const auto errors =
      errors_of_reading([&] { read_mesh(wrong.bytes, wrong.format, wrong.use, sample_place); });
  const auto text = listed(errors);
  ASSERT_FALSE(errors.empty()) << wrong.says[0] << ": read without an error";
  EXPECT_EQ(errors[0].place.line, wrong.line) << text;
  EXPECT_EQ(errors[0].place.column, wrong.column) << text;
  EXPECT_EQ(errors[0].place.file, "sample");
  EXPECT_EQ(errors[0].place.key, "solid[1].file");
  for (const char* part : wrong.says)
    EXPECT_TRUE(!part || text.find(part) != std::string::npos) << part << " is not in\n" << text;
}

std::string without_last_face(PlainMesh mesh) {
  mesh.faces.pop_back();
  return as_off(mesh);
}

std::string with_flipped_face(PlainMesh mesh) {
  std::swap(mesh.faces[3][0], mesh.faces[3][1]);
  return as_off(mesh);
}

const PlainMesh unit = box_mesh({0, 0, 0}, {1, 1, 1});

std::string cut_short(const std::string& bytes, std::size_t by) {
  return bytes.substr(0, bytes.size() - by);
}

const std::string obj3 = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string ply_start = "ply\nformat ascii 1.0\n";
const std::string ply_vertices =
    ply_start + "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string ply3 =
    ply_vertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

}  // namespace

TEST(BrokenMeshes, OfObj) {
  const BrokenMesh cases[] = {
      {"\n \n", obj, joints, 0, 0, {"no triangles"}},
      {"solid a\n", obj, joints, 1, 1, {"unknown OBJ keyword 'solid'"}},
      {"v 0 0 0\nv 1 x 0\n", obj, joints, 2, 5, {"y must be a number, is 'x'"}},
      {"v 0 0\n", obj, joints, 1, 6, {"z is missing"}},
      {"v 0 nan 0\n", obj, joints, 1, 5, {"y is nan", "finite"}},
      {"v 0 0 -inf\n", obj, joints, 1, 7, {"z is -inf", "finite"}},
      {"v 0 0 1e400\n", obj, joints, 1, 7, {"z is inf", "finite"}},
      {"v 2e9 0 0\n", obj, joints, 1, 3, {"x is 2e+09", "at most 1e9 in size"}},
      {"v 0 0 0 red\n", obj, joints, 1, 9, {"numbers only", "'red'"}},
      {obj3 + "f 1 2 4\n", obj, joints, 4, 7, {"vertex 4", "the file has 3"}},
      {obj3 + "f 1 2 0\n", obj, joints, 4, 7, {"from 1", "'0'"}},
      {obj3 + "f 1 2 -4\n", obj, joints, 4, 7, {"'-4'"}},
      {obj3 + "f 1 2 99999999999999999999\n", obj, joints, 4, 7, {"number of a vertex"}},
      {obj3 + "f 1 2 3x\n", obj, joints, 4, 7, {"'3x'"}},
      {obj3 + "f 1 2\n", obj, joints, 4, 0, {"3 corners or more, has 2"}},
      {obj3 + "f 1 2 2\n", obj, joints, 4, 0, {"without area", "(0, 0, 0)"}},
      {"v 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3\n",
       obj,
       solid,
       4,
       0,
       {"1 triangle without area", "(1, 1, 1)"}},
      {obj3 + "v 1 1 0.1\nf 1 2 4 3\n", obj, joints, 5, 0, {"planar", "off the plane", "split"}},
      {obj3 + "v 2 2 0\nf 1 2 3 4\n", obj, joints, 5, 0, {"crosses or touches itself"}},
      {obj3 + "v 2 2 0\nv 1 3 0\nf 1 2 4 1 3\n", obj, joints, 6, 0, {"touches itself"}},
      {"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n", obj, joints, 5, 0, {"has no area"}},
  };
  for (const auto& wrong : cases) expect_refused(wrong);
}

TEST(BrokenMeshes, OfOff) {
  const BrokenMesh cases[] = {
      {"\n", off, joints, 0, 0, {"no OFF header"}},
      {"ply\n", off, joints, 1, 1, {"must begin with OFF", "'ply'"}},
      {"4OFF\n", off, joints, 1, 1, {"three dimensions"}},
      {"OFF BINARY\n", off, joints, 1, 5, {"binary OFF"}},
      {"OFF\n", off, joints, 1, 0, {"ends before the counts"}},
      {"OFF\n3 -1 0\n", off, joints, 2, 3, {"integers >= 0", "'-1'"}},
      {"OFF\n3.5 1 0\n", off, joints, 2, 1, {"'3.5'"}},
      {"OFF\n4000000000 1 0\n0 0 0\n", off, joints, 3, 0, {"ends after 1 of 4000000000 vertices"}},
      {"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", off, joints, 6, 0, {"1 of 2 faces"}},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", off, joints, 6, 7, {"0 to 2, is '3'"}},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", off, joints, 6, 6, {"names only 2"}},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9999999999 0 1 2\n", off, joints, 6, 17, {"names only 3"}},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n7\n", off, joints, 7, 1, {"goes on after"}},
  };
  for (const auto& wrong : cases) expect_refused(wrong);
}

TEST(BrokenMeshes, OfStl) {
  const std::string text = as_text_stl(unit), binary = as_binary_stl(unit);
  std::string with_nan = binary;
  with_nan.replace(84 + 12 + 4, 4, "\xff\xff\xff\xff");
  std::string huge_count = binary;
  huge_count.replace(80, 4, "\xff\xff\xff\xff");
  const BrokenMesh cases[] = {
      {"hello", stl, solid, 1, 1, {"'solid' must follow, not 'hello'"}},
      {text.substr(0, text.rfind("endsolid")), stl, solid, 85, 0, {"'facet' or 'endsolid'"}},
      {text.substr(0, text.rfind("endloop")), stl, solid, 84, 0, {"'endloop' must follow"}},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e10\n",
       stl,
       solid,
       4,
       12,
       {"z is 1e+10"}},
      {"solid\nfacet abnormal", stl, solid, 2, 7, {"'normal' must follow, not 'abnormal'"}},
      {"solid a\nendsolid a\n", stl, solid, 0, 0, {"no triangles"}},
      {cut_short(binary, 1), stl, solid, 0, 0, {"683 bytes", "12 triangles must have 684"}},
      {binary + "x", stl, solid, 0, 0, {"685 bytes", "684"}},
      {huge_count, stl, solid, 0, 0, {"4294967295 triangles must have 214748364834"}},
      {with_nan, stl, solid, 0, 0, {"corner 1 of triangle 1: y is", "finite"}},
      {std::string("\0\0", 2), stl, solid, 0, 0, {"too short"}},
  };
  for (const auto& wrong : cases) expect_refused(wrong);
}

TEST(BrokenMeshes, OfPly) {
  const std::string binary = as_binary_ply(unit, false);
  const auto body = binary.find("end_header\n") + 11;
  std::string bad_index = binary, negative_index = binary;
  bad_index[body + 8 * 25 + 1] = 8;
  negative_index.replace(body + 8 * 25 + 1, 4, "\xff\xff\xff\xff");
  const BrokenMesh cases[] = {
      {"OFF\n", ply, joints, 1, 1, {"must begin with a line 'ply'"}},
      {"ply\nformat ascii 1.0\n", ply, joints, 2, 0, {"no 'end_header'"}},
      {"ply\nformat utf8 1.0\n", ply, joints, 2, 8, {"'utf8'"}},
      {"ply\nend_header\n", ply, joints, 0, 0, {"no line 'format'"}},
      {ply_start + "element vertex many\n", ply, joints, 3, 16, {"'many'"}},
      {ply_start + "property float x\n", ply, joints, 3, 1, {"'property' has no place here"}},
      {ply_start + "element vertex 3\nproperty real x\n",
       ply,
       joints,
       4,
       10,
       {"a type, is 'real'"}},
      {ply_start + "element vertex 1\nproperty list float int x\n",
       ply,
       joints,
       4,
       15,
       {"integer type"}},
      {ply_start + "element a 4000000000\nelement vertex 0\nend_header\n",
       ply,
       joints,
       0,
       0,
       {"element 'a' has no properties"}},
      {ply_start + "end_header\n", ply, joints, 0, 0, {"no element 'vertex'"}},
      {ply_start + "element vertex 1\nproperty float x\nend_header\n1\n",
       ply,
       joints,
       0,
       0,
       {"no property y"}},
      {ply_vertices + "end_header\n0 0 0\n1 0 0\n0 1 0\n",
       ply,
       joints,
       0,
       0,
       {"no element 'face'"}},
      {ply_vertices + "element face 1\nproperty list uchar float vertex_indices\nend_header\n0 0 "
                      "0\n1 0 0\n0 1 0\n",
       ply,
       joints,
       0,
       0,
       {"integers vertex_indices"}},
      {ply_vertices + "element vertex 7\nproperty int x\nend_header\n",
       ply,
       joints,
       0,
       0,
       {"two elements"}},
      {ply3 + "0 0 0\n1 0 0\n", ply, joints, 11, 0, {"ends within vertex 3 of 3"}},
      {ply3 + "0 0 0\n1 0\n", ply, joints, 11, 4, {"too few numbers"}},
      {ply3 + "0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n", ply, joints, 11, 7, {"line must end, with '0'"}},
      {ply3 + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", ply, joints, 11, 3, {"vertex 1: y is nan"}},
      {ply3 + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ply, joints, 13, 0, {"vertex 3", "0 to 2"}},
      {ply3 + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", ply, joints, 13, 7, {"an integer, is '1.5'"}},
      {ply3 + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", ply, joints, 13, 1, {"length of a list"}},
      {ply3 + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n7\n", ply, joints, 14, 0, {"goes on"}},
      {cut_short(binary, 1), ply, joints, 0, 0, {"ends within face 12 of 12"}},
      {binary.substr(0, body + 8), ply, joints, 0, 0, {"ends within vertex 1 of 8"}},
      {binary + "xx", ply, joints, 0, 0, {"goes on"}},
      {bad_index, ply, joints, 0, 0, {"face 0 names vertex 8"}},
      {negative_index, ply, joints, 0, 0, {"face 0 names vertex -1"}},
  };
  for (const auto& wrong : cases) expect_refused(wrong);
}

TEST(BrokenMeshes, ThatBoundNoSolid) {
  // Two boxes that overlap, share an edge, share a corner; a tetrahedron in the wrong sense.
  const PlainMesh overlapping = joined(unit, box_mesh({0.5, 0.5, 0.5}, {2, 2, 2}));
  const PlainMesh at_edge = joined(unit, box_mesh({1, 1, 0}, {2, 2, 1}));
  const PlainMesh at_corner = joined(unit, box_mesh({1, 1, 1}, {2, 2, 2}));
  const PlainMesh outward_cavity = joined(unit, box_mesh({.25, .25, .25}, {.5, .5, .5}));
  const BrokenMesh cases[] = {
      {without_last_face(unit),
       off,
       solid,
       15,
       0,
       {"closed", "3 open edges", "from (1, 0, 0) to (1, 0, 1)"}},
      {with_flipped_face(unit), off, solid, 13, 0, {"oriented alike", "3 edges"}},
      {as_off(at_edge),
       off,
       solid,
       26,
       0,
       {"two triangles", "1 edge,", "(1, 1, 0) to (1, 1, 1) (4 triangles)"}},
      {as_off(at_corner), off, solid, 31, 0, {"touch itself", "1 point", "(1, 1, 1)"}},
      {as_off(overlapping), off, solid, 21, 0, {"intersect itself", "pairs", "(0.5, 0.5, 0.5)"}},
      {as_off(inverted(unit)), off, solid, 11, 0, {"seen from outside", "1 part of 1 inside out"}},
      {as_off(outward_cavity), off, solid, 31, 0, {"cavity", "1 part of 2", "(0.25, 0.25, 0.25)"}},
      {as_binary_stl(inverted(unit)), stl, solid, 0, 0, {"inside out"}},
  };
  for (const auto& wrong : cases) expect_refused(wrong);
}

TEST(BrokenMeshes, TellTheFirstTwentyFaultsAndTheNumberOfTheOthers) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "v 0 0 nan\n";
  const auto errors = errors_of_reading([&] { read_mesh(text, obj, joints, sample_place); });
  ASSERT_EQ(errors.size(), 21u);
  EXPECT_EQ(errors[19].place.line, 20);
  EXPECT_EQ(errors[20].message, "30 more errors");
}

TEST(BrokenMeshes, OfThousandsOfIntersectionsAreRefusedAtOnce) {
  PlainMesh mesh;  // 300 boxes through each other
  for (int i = 0; i < 300; ++i)
    mesh =
        joined(mesh, box_mesh({i * 1e-3, i * 1e-3, i * 1e-3}, {1 + i * 1e-3, 1.5 + i * 2e-3, 1}));
  const auto errors = errors_of_reading([&] { read_mesh(as_off(mesh), off, solid, sample_place); });
  EXPECT_NE(listed(errors).find("1000 pairs or more"), std::string::npos) << listed(errors);
}

}  // namespace rockfold
