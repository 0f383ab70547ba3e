#include "host/files/foreign_format.hpp"

#include "host/files/load_files.hpp"
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

using namespace std::string_view_literals;

}  // namespace

TEST(ForeignFormats, AreNamedWithWhatToConvertThemTo) {
  struct Sample {
    std::string_view bytes;
    const char *kind, *ground, *mesh;
  };
  const Sample samples[] = {
      {"II*\0\x08\0\0\0"sv, "is a TIFF picture (GeoTIFF): ", "gdal_translate -of AAIGrid",
       "for shape = \"terrain\""},
      {"LASF\0\0"sv, "is a LAS or LAZ point cloud: ", "XYZ", "OBJ, OFF, STL or PLY"},
      {"DSAA\n4 3\n0 3\n"sv, "is a Surfer grid: ", "AAIGrid", "AAIGrid"},
      {"DSBB\4\0\3\0"sv, "is a binary Surfer grid: ", "AAIGrid", "AAIGrid"},
      {"# vtk DataFile Version 3.0\nground\nASCII\n"sv, "is a VTK file: ", "XYZ",
       "its triangles to OBJ"},
      {"<VTKFile type=\"PolyData\">"sv, "is a VTK XML file: ", "XYZ", "its triangles to OBJ"},
      {"  0\r\nSECTION\r\n  2\r\nENTITIES\r\n"sv, "is a DXF drawing: ", "XYZ",
       "its triangles to OBJ"},
      {"999\nmade by hand\n0\nSECTION\n"sv, "is a DXF drawing: ", "XYZ", "its triangles to OBJ"},
      {"\xFF\xFE"
       "1\0 \0"sv,
       "is text in UTF-16", "UTF-8", "UTF-8"},
  };
  for (const auto& [bytes, kind, ground, mesh] : samples) {
    const auto as_ground = foreign_format(bytes, FileUse::ground),
               as_mesh = foreign_format(bytes, FileUse::mesh);
    EXPECT_TRUE(as_ground.starts_with(kind)) << as_ground;
    EXPECT_TRUE(as_mesh.starts_with(kind)) << as_mesh;
    EXPECT_NE(as_ground.find(ground), std::string::npos) << as_ground;
    EXPECT_NE(as_mesh.find(mesh), std::string::npos) << as_mesh;
    EXPECT_TRUE(foreign_format(bytes, FileUse::table).starts_with(kind));
  }
}

TEST(ForeignFormats, OfGroundsAndMeshesAreEachOthers) {
  const std::string ply = as_text_ply(box_mesh({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(foreign_format(ply, FileUse::mesh), "");
  EXPECT_NE(foreign_format(ply, FileUse::ground).find("shape = \"mesh\" reads it"),
            std::string::npos);
  const std::string_view grid = "NCOLS 2\nnrows 2\n";
  EXPECT_EQ(foreign_format(grid, FileUse::ground), "");
  EXPECT_NE(foreign_format(grid, FileUse::mesh).find("shape = \"terrain\" reads it"),
            std::string::npos);
  const std::string_view pts = "3\n0 0 10 -1200 10 20 30\n1 0 10 -1200 10 20 30\n";
  EXPECT_NE(foreign_format(pts, FileUse::ground).find("without its first line"), std::string::npos);
}

TEST(ForeignFormats, AreNotSeenInWhatIsRead) {
  for (const char* ground : {"0 0 1\n1 0 1\n0 1 2\n", "x;y;z\n0;0;1\n", "# posts\n0 0 1\n", "0\n"})
    EXPECT_EQ(foreign_format(ground, FileUse::ground), "") << ground;
  const PlainMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  for (const auto& mesh : {as_obj(box), as_off(box), as_text_stl(box), as_binary_stl(box),
                           as_binary_ply(box, true), std::string("# 1\n0\n")})
    EXPECT_EQ(foreign_format(mesh, FileUse::mesh), "");
  EXPECT_EQ(foreign_format("dip,dip_direction,x,y,z\n", FileUse::table), "");
}

TEST(ForeignFormats, GiveOneErrorAFile) {
  const TemporaryFolder folder;
  Model model;
  model.solids.resize(2);
  model.solids[0].shape = TerrainShape{folder.write("dem.tif", "MM\0*\n1 2\n3\n"sv), 0, nullptr};
  model.solids[1].shape = MeshShape{folder.write("body.dxf", "0\nSECTION\n2\n"), nullptr};
  const auto errors = errors_of_reading([&] { load_files(model); });
  ASSERT_EQ(errors.size(), 2u) << listed(errors);
  EXPECT_NE(errors[1].message.find("DXF"), std::string::npos);
}

}  // namespace rockfold
