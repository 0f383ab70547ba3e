#include "tests/io/sample.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <stdexcept>

#include "host/flatten/face_polygons.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {
namespace {

/// Adds faces to the last block, and blocks.
class BlockBuilder {
 public:
  explicit BlockBuilder(BlockArrays& out) : out_(out) {
    out_.face_begin = out_.vertex_begin = out_.loop_begin = out_.corner_begin = {0};
  }

  void face(const std::vector<std::vector<Index>>& loops, const Vec3& normal, Real area,
            Index origin) {
    for (const auto& loop : loops) {
      for (const Index v : loop) out_.corner_vertex.push_back(out_.vertex_begin.back() + v);
      out_.corner_begin.push_back(static_cast<Index>(out_.corner_vertex.size()));
    }
    out_.loop_begin.push_back(static_cast<Index>(out_.corner_begin.size()) - 1);
    out_.face_normal.push_back(normal);
    out_.face_area.push_back(area);
    out_.face_origin.push_back(origin);
    out_.face_up.push_back(normal[0] + normal[1] + normal[2] > 0);
    out_.face_plane.push_back(origin);
  }

  void block(Real volume, const Vec3& centroid, Index edges, Index genus, bool convex) {
    out_.face_begin.push_back(static_cast<Index>(out_.face_area.size()));
    out_.vertex_begin.push_back(static_cast<Index>(out_.vertex.size()));
    out_.volume.push_back(volume);
    out_.centroid.push_back(centroid);
    out_.edge_count.push_back(edges);
    out_.shell_count.push_back(1);
    out_.genus.push_back(genus);
    out_.convex.push_back(convex);
    out_.finite.push_back(1);
    out_.material.push_back(0);
  }

 private:
  BlockArrays& out_;
};

FaceOrigin joint(const std::string& name) {
  return {FaceOrigin::Kind::joint, name, 0, none, none, false};
}
FaceOrigin solid_face(const std::string& name, Index face) {
  return {FaceOrigin::Kind::solid_face, name, none, 0, face, false};
}

constexpr Vec3 box_size{2, 1.5, 1};
constexpr Vec3 box_origin{10, 20, -5};
/// Corners of a box (x + 2y + 4z) around the faces −x, +x, −y, +y, −z, +z, seen from outside.
constexpr Index box_face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

void add_box(BlockArrays& out, BlockBuilder& builder, const std::array<Index, 3>& at,
             const std::array<Index, 3>& counts) {
  Vec3 low, centre;
  for (int d = 0; d < 3; ++d) low[d] = box_origin[d] + at[d] * box_size[d];
  for (int d = 0; d < 3; ++d) centre[d] = low[d] + box_size[d] / 2;
  for (int c = 0; c < 8; ++c)
    out.vertex.push_back({low[0] + (c & 1) * box_size[0], low[1] + (c >> 1 & 1) * box_size[1],
                          low[2] + (c >> 2) * box_size[2]});
  for (int f = 0; f < 6; ++f) {
    const int d = f / 2;
    const bool far = f % 2 == 1, outside = far ? at[d] + 1 == counts[d] : at[d] == 0;
    Vec3 normal{};
    normal[d] = far ? 1 : -1;
    builder.face({{box_face[f], box_face[f] + 4}}, normal,
                 box_size[(d + 1) % 3] * box_size[(d + 2) % 3], outside ? 3 + f : d);
  }
  builder.block(box_size[0] * box_size[1] * box_size[2], centre, 12, 0, true);
}

}  // namespace

BlockArrays box_grid(Index nx, Index ny, Index nz) {
  BlockArrays out;
  out.origins = {joint("J1"), joint("J2"), joint("J3")};
  const char* names[] = {"rock.xmin", "rock.xmax", "rock.ymin",
                         "rock.ymax", "rock.zmin", "rock.zmax"};
  for (int f = 0; f < 6; ++f) out.origins.push_back(solid_face(names[f], f));
  const std::array<Index, 3> counts{nx, ny, nz}, stride{1, nx, nx * ny};
  BlockBuilder builder(out);
  std::array<Index, 3> at;
  for (at[2] = 0; at[2] < nz; ++at[2])
    for (at[1] = 0; at[1] < ny; ++at[1])
      for (at[0] = 0; at[0] < nx; ++at[0]) {
        const Index b = out.block_count();
        add_box(out, builder, at, counts);
        for (int d = 0; d < 3; ++d) {
          if (at[d] + 1 == counts[d]) continue;
          const Index other = b + stride[d];
          out.interfaces.push_back({{b, other},
                                    {6 * b + 2 * d + 1, 6 * other + 2 * d},
                                    out.face_area[6 * b + 2 * d + 1]});
        }
      }
  return out;
}

BlockArrays tube() {
  BlockArrays out;
  out.origins = {solid_face("rock.zmin", 4), solid_face("rock.zmax", 5), solid_face("hole.side", 0),
                 solid_face("rock.side", 1)};
  const Vec3 centre{1, 2, 3};
  for (const Real half : {2.0, 1.0})
    for (const Real z : {-1.5, 1.5})
      for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        out.vertex.push_back(centre + Vec3{half * x, half * y, z});
  BlockBuilder builder(out);
  builder.face({{0, 3, 2, 1}, {8, 9, 10, 11}}, {0, 0, -1}, 12, 0);
  builder.face({{4, 5, 6, 7}, {12, 15, 14, 13}}, {0, 0, 1}, 12, 1);
  const Vec3 outward[4] = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  for (Index i = 0; i < 4; ++i) {
    const Index j = (i + 1) % 4;
    builder.face({{i, j, j + 4, i + 4}}, outward[i], 12, 3);
    builder.face({{8 + j, 8 + i, 12 + i, 12 + j}}, -outward[i], 6, 2);
  }
  builder.block(36, centre, 24, 1, false);
  return out;
}

CoverArrays lattice_with_cut(Index n) {
  CoverArrays out;
  Lattice& lattice = out.lattice;
  lattice.origin = {3, -2, 7};
  lattice.edge = {Vec3{1, 0.1, 0}, Vec3{-0.2, 1.5, 0.1}, Vec3{0, 0.3, 0.8}};
  lattice.cells = {n, n, n};
  const Index nodes = (n + 1) * (n + 1) * (n + 1);
  for (Index node = 0; node < nodes; ++node) out.cover_node.push_back(node);
  const auto corner_cover = [&](Index cell, int c) {
    const auto at = lattice.cell_ijk(cell);
    return lattice.node_index(at[0] + (c & 1), at[1] + (c >> 1 & 1), at[2] + (c >> 2));
  };
  const Index last = n * n * n - 1;
  for (Index cell = 0; cell < last; ++cell) {
    out.regular_cell.push_back(cell);
    out.regular_material.push_back(0);
    out.regular_block.push_back(0);
    for (int c = 0; c < 8; ++c) out.regular_cover.push_back(corner_cover(cell, c));
  }
  constexpr int tet = 4;
  const CellPart& part = cell_split(LatticeKind::tet6).part[tet];
  out.element_cell = {last};
  out.element_part = {tet};
  out.element_material = {0};
  Vec3 corner[4];
  for (int a = 0; a < 4; ++a) {
    const int c = static_cast<unsigned char>(part.node[a]);
    out.element_cover.push_back(corner_cover(last, c));
    corner[a] = ((c & 1) - 0.5) * lattice.edge[0] + ((c >> 1 & 1) - 0.5) * lattice.edge[1] +
                ((c >> 2) - 0.5) * lattice.edge[2];
  }
  const auto add_piece = [&](const std::vector<Vec3>& vertices,
                             const std::vector<std::array<Index, 3>>& triangles, Index block) {
    const Index first = static_cast<Index>(out.vertex_xyz.size() / 3);
    for (const Vec3& x : vertices) out.vertex_xyz.insert(out.vertex_xyz.end(), x.begin(), x.end());
    for (const auto& t : triangles)
      for (const Index v : t) out.triangle_vertex.push_back(first + v);
    out.vertex_begin.push_back(static_cast<Index>(out.vertex_xyz.size() / 3));
    out.triangle_begin.push_back(static_cast<Index>(out.triangle_vertex.size() / 3));
    out.piece_block.push_back(block);
  };
  out.vertex_begin = out.triangle_begin = {0};
  const auto middle = [&](int a) { return 0.5 * (corner[0] + corner[a]); };
  const Vec3 m1 = middle(1), m2 = middle(2), m3 = middle(3);
  add_piece({corner[0], m1, m2, m3}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, 0);
  // The rest: its face towards the first piece is {0,2,1}; quadrilaterals are fanned from vertices
  // 1 and 4, so that some triangles of faces at vertex 0 do not hold it.
  add_piece(
      {m1, m2, m3, corner[1], corner[2], corner[3]},
      {{0, 2, 1}, {3, 4, 5}, {1, 4, 3}, {1, 3, 0}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}, 1);
  out.piece_begin = {0, 2};
  return out;
}

Real cell_volume(const Lattice& lattice) {
  return dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2]));
}

Vec3 linear_motion(const Vec3& x, Real time) {
  return {0.01 * x[0] - 0.02 * x[1] + 0.5 * time, 0.03 * x[2] - time,
          0.01 * x[1] + 0.02 * x[0] - 4 * time};
}

std::vector<Vec3> linear_motion(const std::vector<Vec3>& points, Real time) {
  std::vector<Vec3> out;
  for (const Vec3& x : points) out.push_back(linear_motion(x, time));
  return out;
}

StateArrays linear_state(const CoverArrays& covers, Real time) {
  StateArrays state;
  state.time = time;
  for (const Index node : covers.cover_node)
    state.displacement.push_back(
        linear_motion(covers.lattice.node_position(covers.lattice.node_ijk(node)), time));
  state.velocity.assign(covers.cover_node.size(), {0.5, -1, -4});
  state.acceleration.assign(covers.cover_node.size(), {0, 0, -9.81});
  return state;
}

Model sample_model() {
  Model model;
  model.title = "Böschung";
  model.text = "title = \"Böschung\"\n\n[[material]]\nname = \"granite\"\n";
  model.materials = {{"granite", 2700, 30e9, 0.25}};
  model.joint_materials = {{"clean", 35, 0, 0, {}, {}}};
  return model;
}

ResultHeader sample_header() {
  return {"run", "0.1.0", "0123abc"};
}

BlockFields sample_theory(const BlockArrays& blocks) {
  const auto n = blocks.volume.size();
  BlockFields fields;
  fields.block_class.assign(n, 2);
  fields.block_class[0] = 3;
  fields.batch.assign(n, 0);
  fields.batch[0] = 1;
  fields.mode.assign(n, 0);
  fields.mode[0] = 2;
  fields.factor_of_safety.assign(n, std::numeric_limits<Real>::quiet_NaN());
  fields.factor_of_safety[0] = 0.75;
  fields.sliding_force.assign(n, 0);
  fields.sliding_force[0] = 12345;
  fields.support_force.assign(n, 0);
  fields.direction.assign(n, {});
  return fields;
}

void write_sample(ResultWriter& writer, const BlockArrays& blocks, const CoverArrays& covers,
                  const std::vector<Real>& times) {
  writer.write_blocks(blocks, face_polygons(blocks), sample_theory(blocks));
  const ElementMesh mesh = make_element_mesh(covers);
  writer.write_elements(covers, mesh);
  std::vector<std::array<Real, 6>> stress(covers.element_count());
  for (std::size_t e = 0; e < stress.size(); ++e)
    for (int i = 0; i < 6; ++i) stress[e][i] = (i + 1) * static_cast<Real>(e);
  std::vector<std::array<Real, 6>> nodal(mesh.point_count());
  for (std::size_t k = 0; k < nodal.size(); ++k) nodal[k].fill(static_cast<Real>(k));
  const std::vector<Vec3> velocity(blocks.vertex.size(), {0.5, -1, -4});
  for (std::size_t s = 0; s < times.size(); ++s) {
    const StateArrays state = linear_state(covers, times[s]);
    const std::vector<Vec3> displacement = linear_motion(blocks.vertex, times[s]);
    writer.add_state(
        {static_cast<Index>(10 * s), state, displacement, velocity, stress, {}, nodal});
  }
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "rockfold-io-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
  path = pattern;
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}
std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace rockfold::test
