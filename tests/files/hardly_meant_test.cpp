// Coordinates that are allowed in files and hardly meant.
#include "host/files/hardly_meant.hpp"

#include "src/base/vector.hpp"
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

std::vector<Diagnostic> warnings_of(std::string_view bytes, MeshFormat format, MeshUse use) {
  std::vector<Diagnostic> warnings;
  read_mesh(bytes, format, use, sample_place, &warnings);
  return warnings;
}

/// Floats of a northing of 5.8e6 are 0.5 m apart, of an easting of 3.7e5 0.03 m.
PlainMesh box_in_utm(Real size) {
  const Vec3 low{371998.5, 5806917.25, 30};
  return box_mesh(low, low + Vec3{size, size, size});
}

std::string float_ply(const PlainMesh& mesh) {
  std::string bytes = as_binary_stl(mesh).substr(84),
              ply =
                  "ply\nformat binary_little_endian 1.0\nelement vertex 36\nproperty float x\n"
                  "property float y\nproperty float z\nelement face 12\n"
                  "property list uchar uchar vertex_indices\nend_header\n";
  for (std::size_t t = 0; t < 12; ++t) ply += bytes.substr(50 * t + 12, 36);
  for (char v = 0; v < 36; v += 3)
    ply += {3, v, static_cast<char>(v + 1), static_cast<char>(v + 2)};
  return ply;
}

}  // namespace

TEST(SinglePrecision, IsToldWhereItIsCoarseForTheMesh) {
  for (const auto& bytes : {as_binary_stl(box_in_utm(4)), float_ply(box_in_utm(4))}) {
    const auto format = bytes.starts_with("ply") ? MeshFormat::ply : MeshFormat::stl;
    const auto warnings = warnings_of(bytes, format, MeshUse::solid);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].place.file, "sample");
    // 96 m² of faces, each off by up to 0.25 m, on 64 m³.
    for (const char* words : {"0.5 m apart at y = 5806921:", "shortest edge is 4 m", "up to 38 %"})
      EXPECT_NE(warnings[0].message.find(words), std::string::npos) << warnings[0].message;
    const auto of_joints = warnings_of(bytes, format, MeshUse::joints);
    ASSERT_EQ(of_joints.size(), 1u);
    EXPECT_EQ(of_joints[0].message.find("volume"), std::string::npos);
  }
}

TEST(SinglePrecision, IsNotToldWhereItIsFineOrNotThere) {
  EXPECT_TRUE(warnings_of(as_binary_stl(box_in_utm(100)), MeshFormat::stl, MeshUse::solid).empty());
  EXPECT_TRUE(
      warnings_of(as_binary_stl(box_mesh({0, 0, 0}, {4, 4, 4})), MeshFormat::stl, MeshUse::solid)
          .empty());
  for (const auto& [bytes, format] :
       {std::pair{as_obj(box_in_utm(4)), MeshFormat::obj},
        std::pair{as_text_stl(box_in_utm(4)), MeshFormat::stl},
        std::pair{as_binary_ply(box_in_utm(4), false), MeshFormat::ply}})
    EXPECT_TRUE(warnings_of(bytes, format, MeshUse::solid).empty());
}

TEST(GeographicCoordinates, AreToldWithTheirZone) {
  const auto warning = [](const std::string& text, Real base) {
    const auto found = geographic_coordinates(read_xyz(text, sample_place), base, sample_place);
    return found ? found->message : "";
  };
  const std::string alps = "7.915 46.613 1700\n7.918 46.613 1710\n7.915 46.616 1777\n";
  EXPECT_NE(warning(alps, 1000).find("UTM zone 32N (as gdalwarp -t_srs EPSG:32632"),
            std::string::npos)
      << warning(alps, 1000);
  const std::string andes = "-70.4 -22.1 2900\n-70.3 -22.1 2910\n-70.4 -22.0 2899\n";
  EXPECT_NE(warning(andes, 2890).find("EPSG:32719"), std::string::npos) << warning(andes, 2890);
  EXPECT_EQ(warning("0 0 30\n20 0 35\n0 20 40\n", -100), "");  // a small slope, in metres
  EXPECT_EQ(warning("200.1 45 3000\n200.2 45 3000\n200.1 45.1 3000\n", 0), "");  // no longitude
}

}  // namespace rockfold
