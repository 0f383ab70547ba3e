#include "src/arrays/lattice.hpp"

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr std::int8_t step(int corner, int axis) {
  return static_cast<std::int8_t>(2 * (corner >> axis & 1));
}

std::vector<HalfSteps> corners() {
  std::vector<HalfSteps> node;
  for (int c = 0; c < 8; ++c) node.push_back({step(c, 0), step(c, 1), step(c, 2)});
  return node;
}

Vec3 local_place(const HalfSteps& node) {
  return {0.5 * node[0] - 0.5, 0.5 * node[1] - 0.5, 0.5 * node[2] - 0.5};
}

/// Linear weights of a tetrahedron, after turning its corners to positive volume.
CellPart tetrahedron(const std::vector<HalfSteps>& nodes, std::array<int, 4> corner) {
  const auto at = [&](int a) { return local_place(nodes[corner[a % 4]]); };
  if (dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0))) < 0) std::swap(corner[2], corner[3]);
  CellPart part;
  for (int a = 0; a < 4; ++a) {
    part.node[a] = static_cast<std::int8_t>(corner[a]);
    // 1 at corner a, 0 on the opposite face
    const Vec3 o = at(a + 1), normal = cross(at(a + 2) - o, at(a + 3) - o);
    const Vec3 slope = (1 / dot(normal, at(a) - o)) * normal;
    part.weight[a][0] = -dot(slope, o);
    for (int d = 0; d < 3; ++d) part.weight[a][1 << d] = slope[d];
  }
  return part;
}

CellSplit tetrahedra(std::vector<HalfSteps> nodes, const std::vector<std::array<int, 4>>& corner) {
  CellSplit split;
  split.node = std::move(nodes);
  for (const auto& four : corner) split.part.push_back(tetrahedron(split.node, four));
  return split;
}

/// One tetrahedron between four corners no two of which share an edge, and one cut off at each of the others. The even form
/// keeps corners 000, 011, 101, 110 in the midst.
std::vector<std::array<int, 4>> five(bool odd) {
  std::vector<std::array<int, 4>> result{odd ? std::array<int, 4>{1, 2, 4, 7}
                                             : std::array<int, 4>{0, 3, 5, 6}};
  for (int c = 0; c < 8; ++c) {
    const bool inner = ((c ^ c >> 1 ^ c >> 2) & 1) == (odd ? 1 : 0);
    if (!inner) result.push_back({c, c ^ 1, c ^ 2, c ^ 4});
  }
  return result;
}

std::vector<std::array<int, 4>> both_fives() {
  auto result = five(false);
  const auto odd = five(true);
  result.insert(result.end(), odd.begin(), odd.end());
  return result;
}

/// The thesis' split: {000,010,011,110} {001,100,101,111} {000,001,100,111} {000,001,011,111} {000,100,110,111}
/// {000,011,110,111}, node "abc" = corner a + 2b + 4c.
std::vector<std::array<int, 4>> thesis_six() {
  return {{0, 2, 6, 3}, {4, 1, 7, 5}, {0, 4, 1, 7}, {0, 4, 7, 6}, {0, 1, 3, 7}, {0, 6, 7, 3}};
}

std::vector<std::array<int, 4>> kuhn_six() {
  return {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
}

/// Each edge of each face with the centres of the face and the cell.
CellSplit twenty_four() {
  std::vector<HalfSteps> nodes = corners();
  std::vector<std::array<int, 4>> corner;
  const int centre = 14;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      HalfSteps middle{1, 1, 1};
      middle[axis] = static_cast<std::int8_t>(2 * side);
      const int face = static_cast<int>(nodes.size());
      nodes.push_back(middle);
      const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, o = side << axis;
      for (const auto& [a, b] : {std::array{o, o + u}, std::array{o + u, o + u + v},
                                 std::array{o + u + v, o + v}, std::array{o + v, o}})
        corner.push_back({a, b, face, centre});
    }
  nodes.push_back({1, 1, 1});
  return tetrahedra(std::move(nodes), corner);
}

/// N_c = Π_d (1/2 ± η_d).
CellSplit hexahedron() {
  CellSplit split;
  split.node = corners();
  CellPart part;
  part.nodes = 8;
  for (int c = 0; c < 8; ++c) {
    part.node[c] = static_cast<std::int8_t>(c);
    for (int m = 0; m < 8; ++m) {
      Real product = 1;
      for (int d = 0; d < 3; ++d)
        product *= (m >> d & 1) == 0 ? 0.5 : (c >> d & 1) != 0 ? 1.0 : -1.0;
      part.weight[c][m] = product;
    }
  }
  split.part = {part};
  return split;
}

CellSplit one_block() {
  CellSplit split;
  split.node = {{1, 1, 1}};
  CellPart part;
  part.nodes = 1;
  part.weight[0][0] = 1;
  split.part = {part};
  return split;
}

CellSplit overlaid() {
  CellSplit split = tetrahedra(corners(), both_fives());
  split.share = 0.5;
  return split;
}

}  // namespace

const char* lattice_name(LatticeKind kind) {
  constexpr const char* names[] = {"tet5",  "tet5 mixed", "tet6", "tet6_kuhn",
                                   "tet24", "hex8",       "block"};
  return names[static_cast<int>(kind)];
}

const CellSplit& cell_split(LatticeKind kind, bool odd) {
  static const CellSplit five_even = tetrahedra(corners(), five(false));
  static const CellSplit five_odd = tetrahedra(corners(), five(true));
  static const CellSplit mixed = overlaid();
  static const CellSplit thesis = tetrahedra(corners(), thesis_six());
  static const CellSplit kuhn = tetrahedra(corners(), kuhn_six());
  static const CellSplit fine = twenty_four();
  static const CellSplit hex = hexahedron();
  static const CellSplit block = one_block();
  switch (kind) {
    case LatticeKind::tet5:
      return odd ? five_odd : five_even;
    case LatticeKind::tet5_mixed:
      return mixed;
    case LatticeKind::tet6:
      return thesis;
    case LatticeKind::tet6_kuhn:
      return kuhn;
    case LatticeKind::tet24:
      return fine;
    case LatticeKind::hex8:
      return hex;
    case LatticeKind::block:
      break;
  }
  return block;
}

const CellSplit& Lattice::split(Index cell) const {
  if (kind != LatticeKind::tet5) return cell_split(kind);
  const auto c = cell_ijk(cell);
  return cell_split(kind, (((c[0] + c[1] + c[2]) & 1) != 0) != odd_origin);
}

Index Lattice::cell_node(Index cell, int node) const {
  if (kind == LatticeKind::block) return cell;
  const HalfSteps& at = cell_split(kind).node[node];
  const auto c = cell_ijk(cell);
  const Index lower = node_index(c[0] + at[0] / 2, c[1] + at[1] / 2, c[2] + at[2] / 2);
  const int odd = (at[0] & 1) + (at[1] & 1) + (at[2] & 1);
  if (odd == 0) return lower;
  if (odd == 3) return 4 * grid() + lower;
  const int axis = (at[0] & 1) == 0 ? 0 : (at[1] & 1) == 0 ? 1 : 2;  // across the face
  return (1 + axis) * grid() + lower;
}

Vec3 Lattice::node_position(Index node) const {
  if (kind == LatticeKind::block) return block_origin[node];
  const Index sort = node / grid();
  const auto n = node_ijk(node % grid());
  Vec3 at{Real(n[0]), Real(n[1]), Real(n[2])};
  if (sort > 0)
    for (int d = 0; d < 3; ++d)
      if (d != sort - 1) at[d] += 0.5;
  return position(at);
}

Vec3 Lattice::cell_centre(Index cell) const {
  if (kind == LatticeKind::block) return block_origin[cell];
  const auto c = cell_ijk(cell);
  return position({c[0] + 0.5, c[1] + 0.5, c[2] + 0.5});
}

Mat3 Lattice::reciprocal() const {
  const Real volume = dot(edge[0], cross(edge[1], edge[2]));
  return {(1 / volume) * cross(edge[1], edge[2]), (1 / volume) * cross(edge[2], edge[0]),
          (1 / volume) * cross(edge[0], edge[1])};
}

Vec3 Lattice::to_local(const Vec3& x) const {
  const Mat3 r = reciprocal();
  return {dot(r[0], x), dot(r[1], x), dot(r[2], x)};
}

}  // namespace rockfold
