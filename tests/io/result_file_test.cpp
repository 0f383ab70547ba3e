#include "src/io/result_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>
#include <unistd.h>

#include "host/flatten/face_polygons.hpp"
#include "src/io/hdf5/hdf5_file.hpp"
#include "tests/io/sample.hpp"

namespace rockfold::test {
namespace {

using hdf5::File;

const std::vector<Real> three_times{0, 0.25, 0.5};

/// A finished file of the sample; returns its path.
std::string write_sample_file(const TemporaryFolder& folder, const std::string& name,
                              const std::vector<Real>& times) {
  std::string path = folder / name;
  ResultWriter writer(path, sample_model(), sample_header());
  write_sample(writer, box_grid(3, 2, 2), lattice_with_cut(2), times);
  writer.finish();
  return path;
}

std::string write_blocks_alone(const TemporaryFolder& folder, const std::string& name,
                               const BlockArrays& blocks) {
  std::string path = folder / name;
  ResultWriter writer(path, sample_model(), {"cut", "0.1.0", ""});
  writer.write_blocks(blocks, face_polygons(blocks));
  writer.finish();
  return path;
}

TEST(ResultFile, TellsWhatItHolds) {
  const TemporaryFolder folder;
  const ResultInfo info = read_result_info(write_sample_file(folder, "a.vtkhdf", three_times));
  EXPECT_EQ(info.title, "Böschung");
  EXPECT_EQ(info.model_text, sample_model().text);
  EXPECT_EQ(info.command, "run");
  EXPECT_EQ(info.version, "0.1.0");
  EXPECT_EQ(info.commit, "0123abc");
  EXPECT_EQ(info.blocks, 12);
  EXPECT_EQ(info.faces, 72);
  EXPECT_EQ(info.vertices, 96);
  EXPECT_EQ(info.joint_faces, 20);
  EXPECT_DOUBLE_EQ(info.volume, 36);
  EXPECT_EQ(info.elements, 43);
  EXPECT_EQ(info.pieces, 44);
  EXPECT_EQ(info.covers, 27);
  EXPECT_TRUE(info.block_theory);
  EXPECT_EQ(info.time, three_times);
  EXPECT_EQ(info.step, (std::vector<Index>{0, 10, 20}));
  EXPECT_EQ(info.file_bytes,
            static_cast<std::int64_t>(std::filesystem::file_size(folder / "a.vtkhdf")));
  const auto volume = std::find_if(info.datasets.begin(), info.datasets.end(), [](const auto& d) {
    return d.path == "/rockfold/blocks/volume";
  });
  ASSERT_NE(volume, info.datasets.end());
  EXPECT_EQ(volume->type, "float64");
  EXPECT_EQ(volume->shape, std::vector<std::int64_t>{12});
  EXPECT_EQ(volume->bytes, 96);
}

TEST(ResultFile, OfACutHasNeitherStatesNorElements) {
  const TemporaryFolder folder;
  const ResultInfo info =
      read_result_info(write_blocks_alone(folder, "a.vtkhdf", box_grid(2, 1, 1)));
  EXPECT_EQ(info.command, "cut");
  EXPECT_EQ(info.commit, "");
  EXPECT_EQ(info.blocks, 2);
  EXPECT_EQ(info.joint_faces, 1);
  EXPECT_EQ(info.elements, 0);
  EXPECT_FALSE(info.block_theory);
  EXPECT_TRUE(info.time.empty());
}

TEST(ResultFile, HoldsTheStatesInFullPrecision) {
  const TemporaryFolder folder;
  const File file(write_sample_file(folder, "a.vtkhdf", three_times), File::Mode::read, "a");
  EXPECT_EQ(file.read_numbers("/rockfold/states/time"), three_times);
  ASSERT_EQ(file.shape("/rockfold/states/displacement"), (hdf5::Shape{3, 27, 3}));
  const auto stored = file.read_numbers("/rockfold/states/displacement");
  const StateArrays last = linear_state(lattice_with_cut(2), 0.5);
  for (std::size_t p = 0; p < 27; ++p)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(stored[(2 * 27 + p) * 3 + d], last.displacement[p][d]);
  EXPECT_EQ(file.shape("/rockfold/states/velocity"), (hdf5::Shape{3, 27, 3}));
  EXPECT_FALSE(file.exists("/rockfold/states/acceleration"));
}

/// The displacements drawn, at all points of all blocks and states, are those of the linear field.
TEST(ResultFile, DrawsTheMotion) {
  const TemporaryFolder folder;
  const File file(write_sample_file(folder, "a.vtkhdf", three_times), File::Mode::read, "a");
  for (const std::string grid : {"/VTKHDF/Blocks", "/VTKHDF/Joints", "/VTKHDF/Elements"}) {
    const auto points = file.read_numbers(grid + "/Points"),
               drawn = file.read_numbers(grid + "/PointData/displacement");
    ASSERT_EQ(drawn.size(), 3 * points.size());
    for (std::size_t s = 0; s < 3; ++s) {
      const auto state =
          file.read_numbers("/xdmf/" + grid.substr(8) + "/displacement/" + std::to_string(s));
      for (std::size_t k = 0; k < points.size(); k += 3) {
        const Vec3 expected =
            linear_motion(Vec3{points[k], points[k + 1], points[k + 2]}, three_times[s]);
        for (std::size_t d = 0; d < 3; ++d) {
          EXPECT_NEAR(drawn[s * points.size() + k + d], expected[d], 1e-6);
          EXPECT_EQ(state[k + d], drawn[s * points.size() + k + d]);
        }
      }
    }
  }
}

TEST(ResultFile, HasStressOnEachTetrahedron) {
  const TemporaryFolder folder;
  const File file(write_sample_file(folder, "a.vtkhdf", three_times), File::Mode::read, "a");
  const auto stress = file.read_numbers("/VTKHDF/Elements/CellData/stress");
  const auto element = file.read_numbers("/VTKHDF/Elements/CellData/element");
  ASSERT_EQ(stress.size(), 3 * 46 * 6u);
  for (std::size_t t = 0; t < 46; ++t)
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_EQ(stress[(46 + t) * 6 + i], static_cast<Real>(i + 1) * (element[t] - 1));
}

TEST(ResultFile, HasBlockTheoryOnTheFaces) {
  const TemporaryFolder folder;
  const File file(write_sample_file(folder, "a.vtkhdf", {0}), File::Mode::read, "a");
  const auto block = file.read_numbers("/VTKHDF/Blocks/CellData/block"),
             safety = file.read_numbers("/VTKHDF/Blocks/CellData/factor_of_safety");
  for (std::size_t f = 0; f < block.size(); ++f) {
    const std::size_t box = 1 + f / 6;
    EXPECT_EQ(block[f], static_cast<Real>(box));
    if (block[f] == 1)
      EXPECT_EQ(safety[f], 0.75);
    else
      EXPECT_TRUE(std::isnan(safety[f]));
  }
  EXPECT_EQ(file.read_numbers("/rockfold/block_theory/sliding_force")[0], 12345);
}

/// The corner arrays are the drawn ones under another name, but where faces had to be triangulated.
TEST(ResultFile, KeepsTheFacesOfATube) {
  const TemporaryFolder folder;
  const BlockArrays blocks = tube();
  const File file(write_blocks_alone(folder, "a.vtkhdf", blocks), File::Mode::read, "a");
  EXPECT_EQ(file.shape("/rockfold/blocks/corner_vertex"), hdf5::Shape{48});
  EXPECT_EQ(file.shape("/VTKHDF/Blocks/Polygons/Connectivity"), hdf5::Shape{16 * 3 + 8 * 4});
  EXPECT_EQ(file.shape("/rockfold/blocks/vertex"), (hdf5::Shape{16, 3}));
}

BlockArrays with_stages_and_dead_ends(BlockArrays blocks) {
  blocks.stage.assign(blocks.volume.size(), 0);
  blocks.stage[1] = 2;
  blocks.dead_end_area.assign(blocks.volume.size(), 0);
  blocks.dead_end_area[0] = 0.5;
  blocks.dead_end_block = {0, 0};
  blocks.dead_end_origin = {2, 1};
  blocks.dead_end_corner_begin = {0, 3, 7};
  for (int i = 0; i < 7; ++i) blocks.dead_end_vertex.push_back({10.1 + 0.1 * i, 20.3, -4.5});
  return blocks;
}

TEST(ResultFile, HoldsStagesFlagsAndDeadEnds) {
  const TemporaryFolder folder;
  const BlockArrays blocks = with_stages_and_dead_ends(box_grid(3, 1, 1));
  {
    ResultWriter writer(folder / "a.vtkhdf", sample_model(), {"cut", "0.1.0", ""});
    writer.write_blocks(blocks, face_polygons(blocks), {}, {1, 0, 3});
    writer.finish();
  }
  const File file(folder / "a.vtkhdf", File::Mode::read, "a");
  EXPECT_EQ(file.read_numbers("/rockfold/blocks/stage"), (std::vector<Real>{0, 2, 0}));
  EXPECT_EQ(file.read_numbers("/rockfold/blocks/flags"), (std::vector<Real>{1, 0, 3}));
  EXPECT_EQ(file.read_numbers("/rockfold/blocks/dead_end_area"), (std::vector<Real>{0.5, 0, 0}));
  EXPECT_EQ(file.shape("/rockfold/blocks/dead_end_vertex"), (hdf5::Shape{7, 3}));
  const auto stage = file.read_numbers("/VTKHDF/Blocks/CellData/stage"),
             flags = file.read_numbers("/VTKHDF/Blocks/CellData/flags");
  ASSERT_EQ(stage.size(), 18u);
  for (std::size_t f = 0; f < 18; ++f) {
    EXPECT_EQ(stage[f], f / 6 == 1 ? 2 : 0);
    EXPECT_EQ(flags[f], f / 6 == 0 ? 1 : f / 6 == 1 ? 0 : 3);
  }
  EXPECT_EQ(file.read_numbers("/VTKHDF/DeadEnds/CellData/joint"), (std::vector<Real>{3, 2}));
  EXPECT_EQ(file.read_numbers("/VTKHDF/DeadEnds/CellData/block"), (std::vector<Real>{1, 1}));
  EXPECT_EQ(file.read_numbers("/VTKHDF/DeadEnds/Polygons/Offsets"), (std::vector<Real>{0, 3, 7}));
}

TEST(ResultFile, WithoutStagesFlagsOrDeadEndsHasNoneOfTheFields) {
  const TemporaryFolder folder;
  const File file(write_blocks_alone(folder, "a.vtkhdf", box_grid(2, 1, 1)), File::Mode::read, "a");
  EXPECT_EQ(file.read_numbers("/rockfold/blocks/stage"), (std::vector<Real>{0, 0}));
  for (const std::string name : {"/rockfold/blocks/flags", "/rockfold/blocks/dead_end_block",
                                 "/VTKHDF/Blocks/CellData/stage", "/VTKHDF/DeadEnds"})
    EXPECT_FALSE(file.exists(name)) << name;
}

/// As VTK's readers see it; the script says what they insist on.
TEST(ResultFile, HasTheLayoutThatReadersExpect) {
  const TemporaryFolder folder;
  const std::string run = write_sample_file(folder, "run.vtkhdf", three_times);
  const std::string one = write_sample_file(folder, "one.vtkhdf", {0});
  const std::string cut = write_blocks_alone(folder, "cut.vtkhdf", box_grid(2, 2, 1));
  const std::string no_joints = write_blocks_alone(folder, "tube.vtkhdf", tube());
  const std::string dead = folder / "dead.vtkhdf";
  {
    ResultWriter writer(dead, sample_model(), sample_header());
    write_sample(writer, with_stages_and_dead_ends(box_grid(3, 2, 2)), lattice_with_cut(2),
                 three_times);
    writer.finish();
  }
  const std::string script =
      "/usr/bin/python3 -B " ROCKFOLD_SOURCE_DIR "/tests/io/check_layout.py ";
  for (const std::string& arguments :
       {run + " 3", dead + " 3", one + " 1", cut + " 0", no_joints + " 0"}) {
    const int status = std::system((script + arguments).c_str());
    if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "h5py is not installed";
    EXPECT_EQ(status, 0) << arguments;
  }
}

TEST(ResultFile, IsTheSameForTheSameInput) {
  const TemporaryFolder folder;
  const std::string first = file_bytes(write_sample_file(folder, "a.vtkhdf", three_times));
  std::filesystem::create_directory(folder / "elsewhere");
  sleep(1);  // a date in the file would show
  const std::string second =
      file_bytes(write_sample_file(folder, "elsewhere/b.vtkhdf", three_times));
  EXPECT_EQ(first.size(), second.size());
  EXPECT_TRUE(first == second);
  EXPECT_EQ(file_bytes(folder / "a.xdmf").size(), file_bytes(folder / "elsewhere/b.xdmf").size());
}

TEST(ResultFile, DescribesItselfToParaView511) {
  const TemporaryFolder folder;
  write_sample_file(folder, "a&b.vtkhdf", three_times);
  const std::string text = file_bytes(folder / "a&b.xdmf");
  EXPECT_NE(text.find("a&amp;b.vtkhdf:/xdmf/Elements/stress/2<"), std::string::npos);
  EXPECT_NE(text.find("<Time Value=\"0.25\"/>"), std::string::npos);
}

TEST(ResultWriter, RefusesWhatDoesNotFit) {
  const TemporaryFolder folder;
  const BlockArrays blocks = box_grid(2, 1, 1);
  const CoverArrays covers = lattice_with_cut(1);
  ResultWriter writer(folder / "a.vtkhdf", sample_model(), sample_header());
  const StateArrays state = linear_state(covers, 0);
  const std::vector<Vec3> motion(blocks.vertex.size());
  EXPECT_THROW(writer.add_state({0, state, motion, motion, {}}), std::invalid_argument);
  EXPECT_THROW(writer.write_blocks(blocks, {}, {}, {1}), std::invalid_argument);
  writer.write_blocks(blocks, face_polygons(blocks));
  EXPECT_THROW(writer.write_blocks(blocks, face_polygons(blocks)), std::invalid_argument);
  const ElementMesh mesh = make_element_mesh(covers);
  writer.write_elements(covers, mesh);
  writer.add_state({0, state, motion, motion, {}});
  EXPECT_THROW(writer.add_state({1, linear_state(covers, -1), motion, motion, {}}),
               std::invalid_argument);
  EXPECT_THROW(writer.add_state({1, state, std::span(motion).first(3), motion, {}}),
               std::invalid_argument);
  EXPECT_EQ(writer.state_count(), 1);
}

}  // namespace
}  // namespace rockfold::test
