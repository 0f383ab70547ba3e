// Exported files, read back: closed surfaces of the blocks' volumes, whatever holes their faces have.
#include "src/io/exports/export.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/flatten/face_polygons.hpp"
#include "host/measure/parts.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/io/viewers/block_mesh.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/io/sample.hpp"

namespace rockfold::test {
namespace {

/// A surface read back: polygons over points, each of a block.
struct Surface {
  std::vector<Vec3> point;
  std::vector<std::vector<Index>> polygon;
  std::vector<Index> block;  ///< from 0
};

std::vector<Real> volumes(const Surface& s, std::size_t blocks) {
  std::vector<Real> volume(blocks, 0);
  for (std::size_t p = 0; p < s.polygon.size(); ++p) {
    const auto& corner = s.polygon[p];
    for (std::size_t c = 1; c + 1 < corner.size(); ++c)
      volume[s.block[p]] +=
          dot(s.point[corner[0]], cross(s.point[corner[c]], s.point[corner[c + 1]])) / 6;
  }
  return volume;
}

/// Directed edges that do not stand once, or whose opposite does not stand once, in their block.
int open_edges(const Surface& s) {
  std::map<std::array<Index, 3>, int> count;
  for (std::size_t p = 0; p < s.polygon.size(); ++p)
    for (std::size_t c = 0; c < s.polygon[p].size(); ++c)
      ++count[{s.block[p], s.polygon[p][c], s.polygon[p][(c + 1) % s.polygon[p].size()]}];
  int open = 0;
  for (const auto& [edge, n] : count) {
    const auto back = count.find({edge[0], edge[2], edge[1]});
    open += n != 1 || back == count.end() || back->second != 1;
  }
  return open;
}

/// Directed edges that do not stand as often as their opposite in their block.
int unbalanced_edges(const Surface& s) {
  std::map<std::array<Index, 3>, int> count;
  for (std::size_t p = 0; p < s.polygon.size(); ++p)
    for (std::size_t c = 0; c < s.polygon[p].size(); ++c) {
      const Index u = s.polygon[p][c], v = s.polygon[p][(c + 1) % s.polygon[p].size()];
      ++count[{s.block[p], u, v}];
      --count[{s.block[p], v, u}];
    }
  return static_cast<int>(
      std::count_if(count.begin(), count.end(), [](const auto& e) { return e.second != 0; }));
}

/// What .stl has, with points by number.
Surface triangles_of(const BlockArrays& blocks) {
  Surface s;
  const PolygonMesh triangles = face_triangles(blocks);
  const std::vector<Index> block = block_of_face(blocks);
  for (Index t = 0; t < triangles.size(); ++t) {
    s.polygon.emplace_back(triangles.polygon(t).begin(), triangles.polygon(t).end());
    s.block.push_back(block[triangles.polygon_face[t]]);
  }
  return s;
}

/// Blocks with faces that have holes, a through-hole, a cavity with a block in it, oblique joints.
struct Sample {
  Model model;
  Blocks blocks;
  PartArrays parts;

  explicit Sample(bool joints) : model(box_model({0, 0, 0}, {6, 5, 4})) {
    model.title = "Blöcke";
    model.solids.push_back(box_solid("shaft", {1, 1, -1}, {2, 2.5, 5}, false));
    model.solids.push_back(box_solid("niche", {3, 1, 3}, {4, 2, 5}, false));
    model.solids.push_back(box_solid("cavity", {3, 3, 1}, {5, 4, 2}, false));
    model.solids.push_back(box_solid("core", {3.5, 3.2, 1.2}, {4.5, 3.7, 1.7}));
    if (joints) {
      add_joint(model, Vec3{0.1, 0.2, 1}, {2, 2, 2.3});
      add_joint(model, Vec3{1, 0.3, -0.2}, {2.7, 2, 2});
    }
    blocks = cut(model);
    parts = convex_parts(blocks.cutting, blocks.arrays);
  }

  std::string write(const TemporaryFolder& folder, const std::string& name) const {
    export_blocks({blocks.arrays, face_polygons(blocks.arrays), face_triangles(blocks.arrays),
                   parts, model.title},
                  folder / name);
    return file_bytes(folder / name);
  }
};

void expect_blocks(const Surface& surface, const BlockArrays& blocks) {
  const auto volume = volumes(surface, blocks.volume.size());
  for (std::size_t b = 0; b < volume.size(); ++b)
    EXPECT_NEAR(volume[b], blocks.volume[b], 1e-11) << "block " << b + 1;
  EXPECT_EQ(open_edges(surface), 0);
}

/// The numbers between the tags of a DataArray.
std::vector<Real> vtp_array(const std::string& text, const std::string& name) {
  const auto start = text.find('>', text.find("Name=\"" + name + "\"")) + 1;
  std::istringstream in(text.substr(start, text.find('<', start) - start));
  std::vector<Real> values;
  for (std::string word; in >> word;) values.push_back(std::stod(word));
  return values;
}

Surface read_vtp(const std::string& text) {
  Surface s;
  const auto x = vtp_array(text, "Points"), corner = vtp_array(text, "connectivity"),
             end = vtp_array(text, "offsets"), block = vtp_array(text, "block");
  for (std::size_t k = 0; k < x.size(); k += 3) s.point.push_back({x[k], x[k + 1], x[k + 2]});
  for (std::size_t p = 0; p < end.size(); ++p) {
    const auto begin = corner.begin() + static_cast<std::ptrdiff_t>(p > 0 ? end[p - 1] : 0);
    s.polygon.emplace_back(begin, corner.begin() + static_cast<std::ptrdiff_t>(end[p]));
    s.block.push_back(static_cast<Index>(block[p]) - 1);
  }
  return s;
}

class Exports : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(WithAndWithoutJoints, Exports, testing::Bool());

TEST_P(Exports, AsVtpAreTheBlocks) {
  const TemporaryFolder folder;
  const Sample sample(GetParam());
  const BlockArrays& blocks = sample.blocks.arrays;
  const std::string text = sample.write(folder, "a.vtp");
  const Surface surface = read_vtp(text);
  expect_blocks(surface, blocks);
  const auto face = vtp_array(text, "face"), origin = vtp_array(text, "origin"),
             volume = vtp_array(text, "volume");
  std::vector<int> polygons(blocks.face_area.size(), 0);
  for (std::size_t p = 0; p < face.size(); ++p) {
    const auto f = static_cast<Index>(face[p]) - 1;
    ++polygons[f];
    EXPECT_EQ(origin[p], blocks.face_origin[f] + 1);
    EXPECT_EQ(volume[p], blocks.volume[surface.block[p]]);
  }
  EXPECT_EQ(std::count(polygons.begin(), polygons.end(), 0), 0);  // each face is there
  for (const auto& corners : surface.polygon) EXPECT_EQ(corners.size(), 3u);
  EXPECT_EQ(text.find("batch"), std::string::npos);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.vtp"}));
}

/// Colours of block theory, with the block on each of its triangles; NaN where there is no factor.
TEST(Exports, AsVtpHaveBatchAndFactorOfSafety) {
  const TemporaryFolder folder;
  const BlockArrays blocks = box_grid(2, 1, 1);
  BlockFields theory;
  theory.block_class = {2, 3};
  theory.batch = {0, 4};
  theory.factor_of_safety = {std::numeric_limits<Real>::quiet_NaN(), 0.75};
  export_blocks({blocks, {}, face_triangles(blocks), {}, "", &theory}, folder / "a.vtp");
  const std::string text = file_bytes(folder / "a.vtp");
  const auto block = vtp_array(text, "block"), batch = vtp_array(text, "batch"),
             factor = vtp_array(text, "factor_of_safety"), kind = vtp_array(text, "class");
  ASSERT_EQ(block.size(), 24u);
  ASSERT_EQ(factor.size(), block.size());
  for (std::size_t p = 0; p < block.size(); ++p) {
    EXPECT_EQ(batch[p], block[p] == 2 ? 4 : 0);
    EXPECT_EQ(kind[p], block[p] == 2 ? 3 : 2);
    EXPECT_EQ(std::isnan(factor[p]), block[p] == 1);
    if (block[p] == 2) {
      EXPECT_EQ(factor[p], 0.75);
    }
  }
}

/// The last face of the last block has no loop and no area.
TEST(Exports, PassOverAFaceWithoutLoops) {
  const TemporaryFolder folder;
  BlockArrays blocks = box_grid(2, 1, 1);
  ++blocks.face_begin.back();
  blocks.loop_begin.push_back(blocks.loop_begin.back());
  blocks.face_normal.push_back({0, 0, 1});
  blocks.face_area.push_back(1e-28);
  blocks.face_origin.push_back(0);
  blocks.face_up.push_back(1);
  blocks.face_plane.push_back(0);
  export_blocks({blocks, {}, face_triangles(blocks), {}, ""}, folder / "a.vtp");
  const Surface surface = read_vtp(file_bytes(folder / "a.vtp"));
  EXPECT_EQ(surface.polygon.size(), 24u);
  expect_blocks(surface, blocks);
}

/// Boxes added and removed on a lattice and joints through lattice points: collinear corners, holes that touch each other
/// and the boundary, blocks that meet themselves along an edge (there an edge stands twice, each way).
TEST(Exports, OfRandomRockAreClosed) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> at(0, 4), size(1, 2), way(-1, 1);
  const TemporaryFolder folder;
  std::size_t with_holes = 0;
  for (int n = 0; n < 60; ++n) {
    Model model = box_model({0, 0, 0}, {5, 5, 5});
    for (int k = 0; k < 7; ++k) {
      Vec3 low{}, high{};
      for (int d = 0; d < 3; ++d) low[d] = at(random), high[d] = low[d] + size(random);
      model.solids.push_back(box_solid("b" + std::to_string(k), low, high, k % 4 == 3));
    }
    for (int k = 0; k < n % 4; ++k)
      add_joint(model, Vec3{1.0 * way(random), 1.0 * way(random), 2},
                {1.0 * at(random), 1.0 * at(random), 1.0 * at(random)});
    const Blocks blocks = cut(model);
    const BlockArrays& arrays = blocks.arrays;
    export_blocks({arrays, {}, face_triangles(arrays), {}, ""}, folder / "a.vtp");
    const Surface surface = read_vtp(file_bytes(folder / "a.vtp"));
    with_holes += surface.polygon.size() > arrays.face_area.size();
    const auto volume = volumes(surface, arrays.volume.size());
    for (std::size_t b = 0; b < volume.size(); ++b)
      EXPECT_NEAR(volume[b], arrays.volume[b], 1e-11) << "model " << n << ", block " << b + 1;
    EXPECT_EQ(unbalanced_edges(surface), 0) << "model " << n;
    EXPECT_EQ(unbalanced_edges(triangles_of(arrays)), 0) << "model " << n;
  }
  EXPECT_GT(with_holes, 20u);
}

TEST_P(Exports, AsObjAreTheBlocks) {
  const TemporaryFolder folder;
  const Sample sample(GetParam());
  std::istringstream in(sample.write(folder, "a.OBJ"));
  Surface s;
  Index block = none;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      Vec3 x;
      words >> x[0] >> x[1] >> x[2];
      s.point.push_back(x);
    } else if (key == "g") {
      words >> key;
      block = std::stoi(key.substr(6)) - 1;
    } else if (key == "f") {
      s.polygon.emplace_back();
      for (Index v = 0; words >> v;) s.polygon.back().push_back(v - 1);
      s.block.push_back(block);
    }
  }
  expect_blocks(s, sample.blocks.arrays);
}

TEST_P(Exports, AsStlAreTheBlocks) {
  const TemporaryFolder folder;
  const Sample sample(GetParam());
  std::istringstream in(sample.write(folder, "a.stl"));
  Surface s;
  Vec3 normal{};
  std::map<std::pair<Index, Vec3>, Index> known;
  Index block = none;
  for (std::string word; in >> word;) {
    if (word == "solid") {
      in >> word;
      block = std::stoi(word.substr(6)) - 1;
    } else if (word == "normal") {
      in >> normal[0] >> normal[1] >> normal[2];
      s.polygon.emplace_back();
      s.block.push_back(block);
    } else if (word == "vertex") {
      Vec3 x;
      in >> x[0] >> x[1] >> x[2];
      const auto [at, fresh] = known.try_emplace({block, x}, static_cast<Index>(s.point.size()));
      if (fresh) s.point.push_back(x);
      s.polygon.back().push_back(at->second);
    } else if (word == "endfacet") {
      const auto& t = s.polygon.back();
      ASSERT_EQ(t.size(), 3u);
      const Vec3 turned = cross(s.point[t[1]] - s.point[t[0]], s.point[t[2]] - s.point[t[0]]);
      EXPECT_GT(dot(normal, turned), 0);
    }
  }
  expect_blocks(s, sample.blocks.arrays);
}

/// Faces run clockwise there, each part is closed by itself, and the parts of a block are joined.
TEST_P(Exports, As3decCommandsAreTheBlocks) {
  const TemporaryFolder folder;
  const Sample sample(GetParam());
  const BlockArrays& blocks = sample.blocks.arrays;
  std::istringstream in(sample.write(folder, "a.3ddat"));
  std::vector<Real> volume(blocks.volume.size(), 0);
  std::vector<int> parts(blocks.volume.size(), 0), joined(blocks.volume.size(), 0);
  Real part = 0;
  bool continued = false;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == ';') continue;
    const bool goes_on = line.size() > 3 && line.substr(line.size() - 3) == "...";
    if (line.rfind("block create polyhedron", 0) == 0) {
      EXPECT_FALSE(continued);
      part = 0;
    } else if (line.rfind("  face", 0) == 0) {
      EXPECT_TRUE(continued);
      std::replace_if(
          line.begin(), line.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
      std::istringstream words(line.substr(6));
      std::vector<Vec3> corner;
      for (Vec3 x; words >> x[0] >> x[1] >> x[2];) corner.push_back(x);
      ASSERT_GE(corner.size(), 3u);
      for (std::size_t c = 1; c + 1 < corner.size(); ++c)
        part -= dot(corner[0], cross(corner[c], corner[c + 1])) / 6;
    } else {
      const auto group = line.find("'block_");
      ASSERT_NE(group, std::string::npos) << line;
      const auto b = static_cast<std::size_t>(std::stoi(line.substr(group + 7)) - 1);
      if (line.rfind("block join", 0) == 0) {
        ++joined[b];
      } else {
        EXPECT_TRUE(continued);
        EXPECT_GT(part, 0);
        volume[b] += part;
        ++parts[b];
      }
    }
    continued = goes_on;
  }
  for (std::size_t b = 0; b < volume.size(); ++b) {
    EXPECT_NEAR(volume[b], blocks.volume[b], 1e-11);
    EXPECT_EQ(joined[b], parts[b] > 1 ? 1 : 0);
    if (blocks.convex[b]) {
      EXPECT_EQ(parts[b], 1);
    }
  }
}

TEST_P(Exports, AsJsonHaveTheFacesWithTheirHoles) {
  const TemporaryFolder folder;
  Sample sample(GetParam());
  BlockArrays& blocks = sample.blocks.arrays;
  blocks.stage.assign(blocks.volume.size(), 0);
  blocks.stage[0] = 3;
  blocks.dead_end_block = {0};
  blocks.dead_end_origin = {none};
  blocks.dead_end_corner_begin = {0, 3};
  blocks.dead_end_vertex = {{0, 0, 0}, {1, 0, 0.1}, {0, 1, 0}};
  const auto document = nlohmann::json::parse(sample.write(folder, "a.json"));
  EXPECT_EQ(document["title"], "Blöcke");
  ASSERT_EQ(document["blocks"].size(), blocks.volume.size());
  std::size_t holes = 0;
  for (const auto& block : document["blocks"]) {
    const Index b = block["id"].get<Index>() - 1;
    Real volume = 0;
    std::map<std::array<Index, 2>, int> edges;
    for (const auto& face : block["faces"])
      for (std::size_t l = 0; l < face["loops"].size(); ++l) {
        holes += l > 0;
        std::vector<Vec3> corner;
        const auto ids = face["loops"][l].get<std::vector<Index>>();
        for (const Index v : ids) corner.push_back(block["vertices"].at(v).get<Vec3>());
        for (std::size_t c = 1; c + 1 < corner.size(); ++c)
          volume += dot(corner[0], cross(corner[c], corner[c + 1])) / 6;
        for (std::size_t c = 0; c < ids.size(); ++c) ++edges[{ids[c], ids[(c + 1) % ids.size()]}];
      }
    EXPECT_NEAR(volume, blocks.volume[b], 1e-11);
    for (const auto& [edge, n] : edges) EXPECT_EQ(edges.count({edge[1], edge[0]}), 1u);
    EXPECT_EQ(block["stage"], b == 0 ? 3 : 0);
    EXPECT_EQ(block["dead_ends"].size(), b == 0 ? 1u : 0u);
  }
  EXPECT_GT(holes, 0u);
  EXPECT_EQ(document["blocks"][0]["dead_ends"][0]["points"][1][2], 0.1);
}

TEST(Exports, AreOfAKnownFormat) {
  EXPECT_EQ(export_format("x/a.3DDAT"), ExportFormat::three_dec);
  for (const std::string name : {"a", "a.dxf", ".vtp", "vtp", "a.vtp/b"}) {
    try {
      export_format(name);
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find(".3ddat"), std::string::npos);
    }
  }
}

TEST(Exports, LeaveNothingBehindWhereTheyCannotBeWritten) {
  const TemporaryFolder folder;
  const BlockArrays blocks = tube();
  std::filesystem::create_directory(folder / "is_there.vtp");
  for (const std::string name : {"no/such/folder.vtp", "is_there.vtp"}) {
    try {
      export_blocks({blocks, face_polygons(blocks), {}, {}, ""}, folder / name);
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      EXPECT_EQ(error.diagnostics()[0].place.file, folder / name);
    }
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"is_there.vtp"}));
}

}  // namespace
}  // namespace rockfold::test
