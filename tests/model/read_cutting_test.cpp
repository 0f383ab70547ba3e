// Shapes, finite and random joints, merges, excavations: every key reaches the field that it means.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "src/base/seeds.hpp"
#include "src/check/needs.hpp"
#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();
using Kind = Distribution::Kind;

class CompleteCutting : public testing::Test {
 protected:
  template <class S>
  const S& shape(Index solid) const {
    return std::get<S>(model.solids[solid].shape);
  }

  Model model = parse_model(complete_model, "m.toml", {}, Purpose::check);
};

TEST_F(CompleteCutting, HasItsBasedShapes) {
  const auto& roof = model.solids[3];
  EXPECT_EQ(shape<PyramidShape>(3).base[2], (Vec3{5, 5, 31}));
  EXPECT_EQ(shape<PyramidShape>(3).apex, (Vec3{5, 5, 33}));
  EXPECT_EQ(roof.interface, 1);
  EXPECT_EQ(roof.continues, (std::vector<bool>{false, false, true, false, true}));
  EXPECT_EQ(model.solids[0].interface, none);
  EXPECT_EQ(shape<FrustumShape>(4).base[1], (Vec3{4, 0, -2}));
  EXPECT_EQ(shape<FrustumShape>(4).top[3], (Vec3{1, 3, 0}));
  EXPECT_EQ(model.solids[4].continues,
            (std::vector<bool>{false, false, false, false, false, true}));
}

TEST_F(CompleteCutting, HasItsRoundShapes) {
  const auto& shaft = shape<CylinderShape>(5);
  EXPECT_FALSE(model.solids[5].add);
  EXPECT_EQ(shaft.axis[1], (Vec3{5, 5, 20}));
  EXPECT_EQ(shaft.radius, 1.5);
  EXPECT_EQ(shaft.sides, 12);
  EXPECT_EQ(model.solids[5].continues.size(), 14u);
  EXPECT_TRUE(model.solids[5].continues[12]);
  const auto& cavern = shape<SphereShape>(6);
  EXPECT_EQ(cavern.center, (Vec3{5, 15, 10}));
  EXPECT_EQ(cavern.radius, 2);
  EXPECT_EQ(cavern.subdivisions, 3);
  EXPECT_EQ(model.solids[6].continues, std::vector<bool>{true});
}

TEST_F(CompleteCutting, HasItsTunnels) {
  const auto& gallery = shape<TunnelShape>(7);
  EXPECT_EQ(gallery.path.size(), 3u);
  ASSERT_EQ(gallery.section.size(), 11u);  // floor, two springing points, 7 within the roof
  EXPECT_EQ(gallery.section[1], (std::array<Real, 2>{1.5, 1}));
  EXPECT_EQ(gallery.section[5], (std::array<Real, 2>{0, 2.5}));
  const std::vector<std::array<Real, 2>> counter_clockwise{{2, 0}, {2, 2}, {0, 2}, {0, 0}};
  EXPECT_EQ(shape<TunnelShape>(8).section, counter_clockwise);
}

TEST_F(CompleteCutting, HasItsShapesFromFiles) {
  EXPECT_EQ(shape<MeshShape>(9).file, ROCKFOLD_SOURCE_DIR "/LICENSE");
  EXPECT_EQ(model.solids[9].continues, std::vector<bool>{true});
  EXPECT_EQ(shape<TerrainShape>(10).file, ROCKFOLD_SOURCE_DIR "/tests/../LICENSE");
  EXPECT_EQ(shape<TerrainShape>(10).base, -50);
  EXPECT_EQ(shape<TerrainShape>(10).columns,
            (std::vector<std::string>{"code", "northing", "easting", "elevation"}));
  EXPECT_TRUE(model.solids[10].continues[5]);
}

TEST_F(CompleteCutting, HasItsDiscs) {
  const auto& set = model.joint_sets[0];
  EXPECT_EQ(set.radius, 3.5);
  EXPECT_EQ(set.sides, 20);
  EXPECT_EQ(set.within, 2);
  EXPECT_FALSE(set.random);
  const auto& disc = model.joints[2];
  EXPECT_EQ(disc.radius, 2.5);
  EXPECT_EQ(disc.sides, 24);
  EXPECT_EQ(disc.within, 0);
  EXPECT_FALSE(model.joints[0].radius);
  EXPECT_EQ(model.joints[0].sides, default_disc_sides);
  EXPECT_EQ(model.joints[0].within, none);
}

TEST_F(CompleteCutting, HasItsPolygons) {
  const auto& patch = model.joints[3];
  EXPECT_EQ(patch.plane.point, (Vec3{0, 0, 7}));
  EXPECT_EQ(std::get<DipOrientation>(patch.plane.orientation).dip, 0);
  ASSERT_EQ(patch.polygon.size(), 4u);
  EXPECT_EQ(patch.polygon[1], (Vec3{5, 1, 8}));  // as given: projected when it is placed
  const auto& wall = model.joints[4];
  EXPECT_EQ(wall.plane.point, (Vec3{1, 1, 1}));
  EXPECT_EQ(std::get<Vec3>(wall.plane.orientation), (Vec3{12, 0, 0}));
}

TEST_F(CompleteCutting, HasItsRandomSets) {
  const auto& baecher = *model.joint_sets[1].random;
  EXPECT_EQ(baecher.seed, 9223372036854775807u);
  EXPECT_EQ(baecher.fisher_kappa, 40);
  EXPECT_EQ(baecher.radius->kind, Kind::power_law);
  EXPECT_EQ(baecher.radius->exponent, 2.5);
  EXPECT_EQ(baecher.radius->min, 0.5);
  EXPECT_EQ(baecher.radius->max, 8);
  EXPECT_EQ(baecher.p32, 0.75);
  EXPECT_FALSE(baecher.spacing || baecher.p10 || baecher.count);
  const auto& bedding = *model.joint_sets[2].random;
  EXPECT_EQ(bedding.seed, 3u);  // its number: sets without a seed differ
  EXPECT_EQ(bedding.fisher_kappa, infinity);
  EXPECT_FALSE(bedding.radius);
  EXPECT_EQ(bedding.spacing->kind, Kind::log_normal);
  EXPECT_EQ(bedding.spacing->mean, 2);
  EXPECT_EQ(bedding.spacing->standard_deviation, 0.5);
  EXPECT_EQ(bedding.spacing->min, 0.25);
  EXPECT_EQ(bedding.spacing->max, 9);
  EXPECT_EQ(model.joint_sets[2].spacing, 0);
  const auto& along = *model.joint_sets[3].random;
  EXPECT_EQ(along.radius->kind, Kind::constant);
  EXPECT_EQ(along.radius->mean, 2.5);
  EXPECT_EQ(along.p10, 0.2);
  EXPECT_EQ(along.scanline[1], (Vec3{10, 10, 10}));
  const auto& few = *model.joint_sets[4].random;
  EXPECT_EQ(few.radius->kind, Kind::exponential);
  EXPECT_EQ(few.radius->max, 20);
  EXPECT_EQ(few.count, 12);
}

TEST_F(CompleteCutting, HasItsJointsFromFiles) {
  ASSERT_EQ(model.joint_meshes.size(), 1u);
  EXPECT_EQ(model.joint_meshes[0].name, "faults");
  EXPECT_EQ(model.joint_meshes[0].file, ROCKFOLD_SOURCE_DIR "/LICENSE");
  EXPECT_EQ(model.joint_meshes[0].material, 1);
  EXPECT_EQ(model.joint_meshes[0].within, 0);
  EXPECT_EQ(model.joint_meshes[0].flatness, 7.5);
  ASSERT_EQ(model.joint_tables.size(), 1u);
  EXPECT_EQ(model.joint_tables[0].name, "mapped");
  EXPECT_EQ(model.joint_tables[0].file, ROCKFOLD_SOURCE_DIR "/LICENSE");
  EXPECT_EQ(model.joint_tables[0].material, 1);
  EXPECT_EQ(model.joint_tables[0].extent, JointTable::Extent::through_going);
  EXPECT_EQ(model.joint_tables[0].sides, 6);
  EXPECT_EQ(model.joint_tables[0].within, 2);
}

TEST_F(CompleteCutting, HasItsMergesAndExcavations) {
  ASSERT_EQ(model.merges.size(), 3u);
  EXPECT_EQ(std::get<Merge::Box>(model.merges[0].region).max, (Vec3{5, 5, 5}));
  EXPECT_EQ(std::get<Merge::InSolid>(model.merges[1].region).solid, 2);
  EXPECT_EQ(std::get<Merge::Blocks>(model.merges[2].region).points[1], (Vec3{9, 9, 9}));
  ASSERT_EQ(model.excavations.size(), 2u);
  EXPECT_EQ(model.excavations[0].name, "pit");
  EXPECT_EQ(model.excavations[0].stage, 2);
  EXPECT_EQ(std::get<HalfspacesShape>(model.excavations[0].shape).planes.size(), 1u);
  EXPECT_EQ(model.excavations[1].name, "excavation2");
  EXPECT_EQ(model.excavations[1].stage, 1);
  EXPECT_EQ(std::get<TunnelShape>(model.excavations[1].shape).section.size(), 16u);
}

TEST_F(CompleteCutting, HasItsLimitsAndScanlines) {
  EXPECT_EQ(model.cut.max_cells, 1'000'000);
  EXPECT_EQ(model.cut.place_of_max_cells.key, "cut.max_cells");
  EXPECT_GT(model.cut.place_of_max_cells.line, 0);
  EXPECT_EQ(model.cut.min_volume, 1e-3);
  EXPECT_EQ(model.cut.specks, Specks::merge);
  EXPECT_EQ(model.cut.max_aspect_ratio, 12.5);
  ASSERT_EQ(model.scanlines.size(), 1u);
  EXPECT_EQ(model.scanlines[0].name, "bore");
  EXPECT_EQ(model.scanlines[0].from, (Vec3{5, 5, 0}));
  EXPECT_EQ(model.scanlines[0].to, (Vec3{5, 6, 30}));
}

TEST(SmallCutting, HasDefaults) {
  const auto model = parse_model(
      ROCK
      "[[solid]]\nshape = 'cylinder'\naxis = [[0, 0, 0], [0, 0, 1]]\nradius = 1\n"
      "[[solid]]\nshape = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\n"
      "[[solid]]\nshape = 'tunnel'\npath = [[0, 0, 0], [9, 0, 0]]\nsection = 'circle'\nradius = 1\n"
      "[[joint_set]]\ndip = 0\ndip_direction = 0\n[joint_set.random]\nspacing = 2\n",
      "m.toml");
  EXPECT_EQ(std::get<CylinderShape>(model.solids[1].shape).sides, 32);
  EXPECT_EQ(std::get<SphereShape>(model.solids[2].shape).subdivisions, 2);
  EXPECT_EQ(std::get<TunnelShape>(model.solids[3].shape).section.size(), 24u);
  EXPECT_EQ(model.joint_sets[0].random->seed, 1u);
  EXPECT_EQ(model.joint_sets[0].random->spacing->max, infinity);
  EXPECT_EQ(model.cut.max_cells, 20'000'000);
  EXPECT_TRUE(model.cut.place_of_max_cells.file.empty());
  EXPECT_FALSE(model.cut.min_volume || model.cut.max_aspect_ratio);
  EXPECT_EQ(model.cut.specks, Specks::keep);
}

/// The opening of an arched tunnel given by its radius: half the width, and the height of a circle.
TEST(RandomSpacing, MayBeLimitedByTheSetsCount) {
  const auto model = parse_model(
      ROCK
      "[[joint_set]]\ndip = 0\ndip_direction = 0\ncount = 3\n[joint_set.random]\nspacing = 2\n",
      "m.toml");
  EXPECT_EQ(model.joint_sets[0].count, 3);
  EXPECT_FALSE(model.joint_sets[0].random->count);
}

TEST(Tunnel, MayBeGivenByItsRadius) {
  for (const char* kind : {"d_shape", "horseshoe"}) {
    const auto section_of = [&](const std::string& size) {
      const auto model = parse_model(ROCK "[[solid]]\nshape = 'tunnel'\n"
                                          "path = [[0, 0, 0], [9, 0, 0]]\nsection = '" +
                                         std::string(kind) + "'\n" + size,
                                     "m.toml");
      return std::get<TunnelShape>(model.solids[1].shape).section;
    };
    EXPECT_EQ(section_of("radius = 1.5"), section_of("width = 3\nheight = 3"));
    EXPECT_EQ(section_of("radius = 1.5\nheight = 2"), section_of("width = 3\nheight = 2"));
  }
}

class ModelWithFiles : public testing::Test {
 protected:
  ModelWithFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder =
        std::filesystem::path(testing::TempDir()) / ("rockfold_files_" + std::string(test->name()));
    std::filesystem::create_directories(folder / "data");
  }
  ~ModelWithFiles() override { std::filesystem::remove_all(folder); }

  std::string write(const std::string& name, const std::string& text) const {
    auto path = (folder / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  std::filesystem::path folder;
};

TEST_F(ModelWithFiles, FindsThemFromItsOwnFolder) {
  const auto mesh = write("data/fault plane.stl", "");
  const auto path = write(
      "m.toml", ROCK "[[joint_mesh]]\nfile = 'data/fault plane.stl'\n[[joint_table]]\nfile = '" +
                    mesh + "'\n");
  const auto model = read_model(path);
  EXPECT_TRUE(std::filesystem::equivalent(model.joint_meshes[0].file, mesh));
  EXPECT_EQ(model.joint_meshes[0].name, "joint_mesh1");
  EXPECT_EQ(model.joint_meshes[0].flatness, 5);
  EXPECT_EQ(model.joint_tables[0].file, mesh);
}

TEST_F(ModelWithFiles, NamesThoseThatAreMissing) {
  const auto path = write("m.toml", ROCK
                          "[[joint_mesh]]\nfile = 'no.stl'\n[[solid]]\n"
                          "shape = 'mesh'\nfile = 'data'\n[[solid]]\n"
                          "shape = 'terrain'\nfile = ''\nbase = 0\n");
  try {
    read_model(path);
    FAIL();
  } catch (const Error& error) {
    ASSERT_EQ(error.diagnostics().size(), 3u) << listed(error.diagnostics());
    EXPECT_EQ(error.diagnostics()[0].place.line, 7);
    EXPECT_EQ(error.diagnostics()[0].place.column, 8);
    EXPECT_EQ(error.diagnostics()[0].place.key, "joint_mesh[1].file");
    EXPECT_NE(error.diagnostics()[0].message.find((folder / "no.stl").string().substr(0, 40)),
              std::string::npos)
        << listed(error.diagnostics());
    EXPECT_NE(error.diagnostics()[1].message.find("is a folder"), std::string::npos);
    EXPECT_NE(error.diagnostics()[2].message.find("found \"\""), std::string::npos);
  }
}

TEST_F(ModelWithFiles, IsRightItselfWhereNothingButFilesIsMissing) {
  const auto kind_of = [&](const std::string& text) {
    try {
      read_model(write("m.toml", text));
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::analysis;
  };
  const std::string missing =
      ROCK "[[joint_mesh]]\nfile = 'no.stl'\n[[joint_table]]\nfile = 'data'\n";
  EXPECT_EQ(kind_of(missing), ErrorKind::io);
  EXPECT_EQ(kind_of(missing + "sides = 2\n"), ErrorKind::model);
}

TEST_F(ModelWithFiles, TakesItsSeedsFromTheCommandLine) {
  const std::string random = "[[joint_set]]\ndip = 5\ndip_direction = 0\n[joint_set.random]\n";
  const std::string plain = "[[joint_set]]\ndip = 5\ndip_direction = 0\nspacing = 1\n";
  Options options;
  options.command = Command::check;
  options.input =
      write("m.toml", ROCK + random + "spacing = 1\nseed = 5\n" + plain + random + "spacing = 2\n");
  Terminal terminal(stderr, TerminalSettings{});
  EXPECT_EQ(load_model(options, terminal).joint_sets[0].random->seed, 5u);
  options.seed = 70;
  const auto model = load_model(options, terminal);
  EXPECT_EQ(model.joint_sets[0].random->seed, seed_of_set(70, 1));
  EXPECT_EQ(model.joint_sets[2].random->seed, seed_of_set(70, 3));
  EXPECT_NE(model.text.find("# Random joint sets drawn with --seed 70"), std::string::npos);
  EXPECT_EQ(parse_model(model.text, "").joint_sets.size(), 3u);
}

}  // namespace
}  // namespace rockfold
