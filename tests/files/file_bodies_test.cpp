// Many closed bodies in one file: what they are called and what holds them together.
#include "host/files/load_files.hpp"
#include "host/files/meshes/last_digit.hpp"
#include "src/model/read/read_model.hpp"
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

std::vector<FileBody> bodies_of(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  return file_bodies({folder.write(name, bytes), 0, 0, "solid[1].file"});
}

std::string names_of(const std::vector<FileBody>& bodies) {
  std::string names;
  for (const FileBody& body : bodies) names += "[" + body.name + "]";
  return names;
}

/// Boxes side by side, each behind the line `label` and its number. Vertices are counted through.
std::string row_of_boxes(int count, const std::string& label) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const PlainMesh box = box_mesh({1.0 * i, 0, 0}, {i + 1.0, 1, 1});
    text += label + std::to_string(i) + "\n";
    for (const Vec3& x : box.vertices)
      text += "v " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " +
              std::to_string(x[2]) + "\n";
    for (const auto& face : box.faces) {
      text += "f";
      for (const int corner : face) text += " " + std::to_string(8 * i + corner + 1);
      text += "\n";
    }
  }
  return text;
}

}  // namespace

TEST(FileBodies, AreCalledAsObjects) {
  const auto bodies = bodies_of("row.obj", row_of_boxes(3, "o stone "));
  EXPECT_EQ(names_of(bodies), "[stone 0][stone 1][stone 2]");
  for (const FileBody& body : bodies) EXPECT_EQ(six_volumes(*body.surface), 6);
}

TEST(FileBodies, AreCalledAsGroupsWhereAllAreOneObject) {
  EXPECT_EQ(names_of(bodies_of("row.obj", "o all\n" + row_of_boxes(2, "g b"))), "[b0][b1]");
}

TEST(FileBodies, OfPlyAndStlHaveNoNames) {
  const PlainMesh two = joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({1, 0, 0}, {2, 1, 1}));
  EXPECT_EQ(names_of(bodies_of("two.ply", as_text_ply(two))), "[][]");
  const PlainMesh apart = joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({2, 0, 0}, {3, 1, 1}));
  EXPECT_EQ(names_of(bodies_of("two.stl", as_binary_stl(apart))), "[][]");
}

TEST(FileBodies, KeepTheirCavities) {
  const PlainMesh hollow =
      joined(box_mesh({0, 0, 0}, {4, 4, 4}), inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  const auto bodies =
      bodies_of("h.ply", as_text_ply(joined(hollow, box_mesh({4, 0, 0}, {5, 1, 1}))));
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(six_volumes(*bodies[0].surface), 6 * 63);
}

TEST(FileBodies, ThatAreOpenAreToldWithTheirLine) {
  std::string text = row_of_boxes(2, "o b");
  text.resize(text.rfind("f "));
  const auto errors = errors_of_reading([&] { bodies_of("open.obj", text); });
  ASSERT_FALSE(errors.empty());
  EXPECT_NE(errors[0].message.find("closed"), std::string::npos) << errors[0].message;
  EXPECT_GT(errors[0].place.line, 0);
}

TEST(FileBodies, BecomeSolidsWithAllOfTheirEntry) {
  const TemporaryFolder folder;
  folder.write("row.obj", row_of_boxes(2, "o stone "));
  folder.write("row.ply", as_text_ply(box_mesh({0, 0, 2}, {1, 1, 3})));
  const std::string text =
      "[[material]]\nname = \"a\"\ndensity = 1\n[[material]]\nname = \"b\"\ndensity = 2\n"
      "[[joint_material]]\nname = \"m\"\nfriction_angle = 30\n"
      "[[solid]]\nname = \"first\"\nshape = \"mesh\"\nfile = \"row.obj\"\nbodies = \"separate\"\n"
      "material = \"b\"\ninterface = \"m\"\n"
      "[[solid]]\nname = \"second\"\nshape = \"mesh\"\nfile = \"row.ply\"\nbodies = \"separate\"\n"
      "[[solid]]\nname = \"third\"\nshape = \"mesh\"\nfile = \"row.obj\"\nbodies = \"separate\"\n"
      "[[traction]]\nwhere = {face = \"stone 1.0\"}\npressure = 1.0\n";
  const Model model = parse_model(text, folder.path("m.toml"), {}, Purpose::cut, file_bodies);
  std::string names;
  for (const Solid& solid : model.solids) names += "[" + solid.name + "]";
  EXPECT_EQ(names, "[stone 0][stone 1][second1][stone 0_2][stone 1_2]");
  EXPECT_EQ(model.solids[1].material, 1);
  EXPECT_EQ(model.solids[1].interface, 0);
  EXPECT_EQ(model.solids[2].interface, none);
  EXPECT_EQ(std::get<FaceRegion>(model.tractions[0].where).solid, 1);
  EXPECT_EQ(files_named_by(model).size(), 3u);
}

/// Two boxes, the second from `x` on, in the middle of the end of the first.
std::string pegged(Real x) {
  const TemporaryFolder folder;
  std::string text;
  int first = 1;
  for (const PlainMesh& box :
       {box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({x, 0.25, 0.25}, {2, 0.75, 0.75})}) {
    text += first == 1 ? "o base\n" : "o peg\n";
    for (const Vec3& v : box.vertices)
      text += "v " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " +
              std::to_string(v[2]) + "\n";
    for (const auto& face : box.faces) {
      text += "f";
      for (const int corner : face) text += " " + std::to_string(first + corner);
      text += "\n";
    }
    first += 8;
  }
  folder.write("two.obj", text);
  Model model = parse_model(
      "[[material]]\ndensity = 2600\n[[joint_material]]\nname = \"m\"\nfriction_angle = 30\n"
      "[[solid]]\nshape = \"mesh\"\nfile = \"two.obj\"\nbodies = \"separate\"\ninterface = "
      "\"m\"\n",
      folder.path("m.toml"), {}, Purpose::cut, file_bodies);
  load_files(model);
  std::string warnings;
  for (const Diagnostic& warning : model.warnings) warnings += warning.message + "\n";
  return warnings;
}

TEST(FileBodies, ThatLieInEachOtherAreTold) {
  EXPECT_EQ(pegged(1), "");
  const std::string told = pegged(0.9);
  EXPECT_NE(told.find("\"peg\" lies in \"base\" by 0.1 m"), std::string::npos) << told;
}

TEST(FileBodies, BelongToMeshes) {
  const auto errors = errors_of_reading([] {
    parse_model(
        "[[material]]\ndensity = 1\n"
        "[[solid]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\nbodies = \"separate\"\n",
        "m.toml", {}, Purpose::cut, file_bodies);
  });
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].place.key, "solid[1].bodies");
  EXPECT_EQ(errors[0].place.line, 7);
}

TEST(LastDigit, IsThatOfTheLongestCoordinate) {
  EXPECT_EQ(last_digit({{1, 2, 3}}, false), 1);
  EXPECT_NEAR(last_digit({{1, 0.5, 3.25}, {-1e3, 0, 7e-5}}, false), 1e-5, 1e-20);
  EXPECT_NEAR(last_digit({{static_cast<float>(0.1), 1, 1}}, true), 0.1, 1e-15);
  EXPECT_EQ(last_digit({}, false), 0);
}

}  // namespace rockfold
