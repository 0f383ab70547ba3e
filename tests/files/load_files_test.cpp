// From a model's file names to its geometry.
#include "host/files/load_files.hpp"

#include <algorithm>

#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

Solid solid_of(Shape shape, const std::string& key) {
  Solid solid;
  solid.shape = std::move(shape);
  solid.place = {"m.toml", 3, 1, key};
  return solid;
}

const std::string grid = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n";

}  // namespace

TEST(LoadFiles, FillsAllThatAModelNames) {
  const TemporaryFolder folder;
  const auto box = folder.write("box.stl", as_binary_stl(box_mesh({0, 0, 0}, {1, 2, 3})));
  Model model;
  model.joint_materials = named_materials({"clean", "clay"});
  model.solids.push_back(solid_of(MeshShape{box, nullptr}, "solid[1]"));
  model.solids.push_back(
      solid_of(TerrainShape{folder.write("hill.asc", grid), -5, nullptr}, "solid[2]"));
  model.excavations.resize(1);
  model.excavations[0].shape = MeshShape{box, nullptr};
  model.joint_meshes.resize(1);
  model.joint_meshes[0].file = folder.write("fault.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  model.joint_tables.resize(1);
  model.joint_tables[0].material = 1;
  model.joint_tables[0].file =
      folder.write("joints.csv", "dip,dip_direction,x,y,z,radius\n45,90,0,0,0,\n");
  load_files(model);
  const auto& solid = std::get<MeshShape>(model.solids[0].shape).surface;
  EXPECT_EQ(six_volumes(*solid), 36);
  EXPECT_EQ(std::get<MeshShape>(model.excavations[0].shape).surface, solid) << "read twice";
  EXPECT_EQ(std::get<TerrainShape>(model.solids[1].shape).ground->triangles.size(), 2u);
  EXPECT_EQ(model.joint_meshes[0].surface->triangles.size(), 1u);
  ASSERT_EQ(model.joint_tables[0].rows.size(), 1u);
  EXPECT_EQ(model.joint_tables[0].rows[0].material, 1);

  std::filesystem::remove(box);
  EXPECT_NO_THROW(load_files(model)) << "what is loaded is not read again";
}

TEST(LoadFiles, TellsAllWrongFilesAtOnce) {
  const TemporaryFolder folder;
  Model model;
  const auto add = [&](Shape shape) {
    model.solids.push_back(
        solid_of(std::move(shape), "solid[" + std::to_string(model.solids.size() + 1) + "]"));
  };
  add(MeshShape{folder.path("missing.obj"), nullptr});
  add(MeshShape{folder.path(""), nullptr});
  add(MeshShape{folder.write("empty.off", ""), nullptr});
  add(MeshShape{folder.write("mesh.dxf", "x"), nullptr});
  std::filesystem::create_directory(folder.path("folder.ply"));
  add(MeshShape{folder.path("folder.ply"), nullptr});
  std::filesystem::create_symlink("/dev/zero", folder.path("zero.stl"));
  add(MeshShape{folder.path("zero.stl"), nullptr});
  add(TerrainShape{folder.write("hill.asc", grid), 2.5, nullptr});
  add(TerrainShape{folder.write("hill.xyz", "0 0 0\n1 0\n"), 2.5, nullptr});
  const auto errors = errors_of_reading([&] { load_files(model); });
  const auto text = listed(errors);
  ASSERT_EQ(errors.size(), 8u) << text;
  const char* says[] = {"cannot be opened: No such file or directory",
                        "it is a folder",
                        "is empty",
                        ".obj, .off, .stl or .ply",
                        "it is a folder",
                        "it is no regular file",
                        "above base = 2.5 m everywhere: 2 posts do not",
                        "z is missing"};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NE(errors[i].message.find(says[i]), std::string::npos) << says[i] << " is not in\n"
                                                                  << text;
    EXPECT_EQ(errors[i].place.key, "solid[" + std::to_string(i + 1) + "].file");
  }
  EXPECT_EQ(errors[0].place.file, folder.path("missing.obj"));
}

TEST(LoadFiles, FailsAsIoOnlyWhereNoContentIsWrong) {
  const TemporaryFolder folder;
  const auto kind_of = [](Model model) {
    try {
      load_files(model);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::usage;
  };
  Model model;
  model.joint_meshes.resize(1);
  model.joint_meshes[0].file = folder.path("missing.obj");
  EXPECT_EQ(kind_of(model), ErrorKind::io);
  model.joint_tables.resize(1);
  model.joint_tables[0].file = folder.write("empty.csv", "");
  EXPECT_EQ(kind_of(model), ErrorKind::model);
}

}  // namespace rockfold
