#include "tests/cut/oracles/voxel_oracle.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace rockfold::test {

namespace {

using Cell = std::array<int, 3>;

class Parts {
 public:
  explicit Parts(std::size_t n) : up_(n) { std::iota(up_.begin(), up_.end(), 0); }
  int find(int i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  void join(int a, int b) { up_[find(a)] = find(b); }

 private:
  std::vector<int> up_;
};

// A unit square of a block's surface: the side of `cube` towards +axis or −axis.
struct Square {
  Cell cube;
  int axis;
  bool up;
  int origin;
};

class Grid {
 public:
  explicit Grid(const GridModel& model) : m_(model), part_(cube_count()) {
    solid_.assign(cube_count(), -1);
    for (std::size_t s = 0; s < m_.solids.size(); ++s)
      each_cube([&](const Cell& c) {
        if (in(m_.solids[s], c)) solid_[id(c)] = m_.solids[s].add ? static_cast<int>(s) : -1;
      });
    each_inner_square([&](const Cell& below, const Cell& above, int axis) {
      if (joint_between(below, axis) < 0) part_.join(id(below), id(above));
    });
    std::map<int, int> number;
    block_.assign(cube_count(), -1);
    each_cube([&](const Cell& c) {
      if (rock(c))
        block_[id(c)] =
            number.emplace(part_.find(id(c)), static_cast<int>(number.size())).first->second;
    });
    block_count_ = static_cast<int>(number.size());
  }

  int block_count() const { return block_count_; }
  int block(const Cell& c) const { return inside(c) ? block_[id(c)] : -1; }

  template <class F>
  void each_cube(const F& f) const {
    for (int z = 0; z < m_.size[2]; ++z)
      for (int y = 0; y < m_.size[1]; ++y)
        for (int x = 0; x < m_.size[0]; ++x) f(Cell{x, y, z});
  }

  /// Squares with rock on both sides.
  template <class F>
  void each_inner_square(const F& f) const {
    each_cube([&](const Cell& c) {
      for (int d = 0; d < 3; ++d) {
        const Cell next = step(c, d, 1);
        if (rock(c) && rock(next)) f(c, next, d);
      }
    });
  }

  /// The first listed joint on the upper side of cube c across `axis`, or −1.
  int joint_between(const Cell& c, int axis) const {
    const int u = c[axis == 0 ? 1 : 0], v = c[axis == 2 ? 1 : 2];
    for (std::size_t j = 0; j < m_.joints.size(); ++j) {
      const GridJoint& r = m_.joints[j];
      if (r.axis == axis && r.at == c[axis] + 1 && r.u[0] <= u && u < r.u[1] && r.v[0] <= v &&
          v < r.v[1])
        return static_cast<int>(j);
    }
    return -1;
  }

  /// Between two blocks a joint; else the face of the solid that was added or dug last there.
  int origin(const Cell& c, int axis, bool up) const {
    const Cell next = step(c, axis, up ? 1 : -1);
    const Cell& lower = up ? c : next;
    if (rock(next)) return joint_between(lower, axis);
    int last = -1;
    for (std::size_t s = 0; s < m_.solids.size(); ++s)
      if (in(m_.solids[s], c) != in(m_.solids[s], next)) last = static_cast<int>(s);
    return static_cast<int>(m_.joints.size()) + last;
  }

  static Cell step(Cell c, int axis, int by) {
    c[axis] += by;
    return c;
  }

 private:
  std::size_t cube_count() const {
    return static_cast<std::size_t>(m_.size[0]) * m_.size[1] * m_.size[2];
  }
  int id(const Cell& c) const { return (c[2] * m_.size[1] + c[1]) * m_.size[0] + c[0]; }
  bool inside(const Cell& c) const {
    for (int d = 0; d < 3; ++d)
      if (c[d] < 0 || c[d] >= m_.size[d]) return false;
    return true;
  }
  bool rock(const Cell& c) const { return inside(c) && solid_[id(c)] >= 0; }
  static bool in(const GridBox& b, const Cell& c) {
    for (int d = 0; d < 3; ++d)
      if (c[d] < b.min[d] || c[d] >= b.max[d]) return false;
    return true;
  }

  const GridModel& m_;
  std::vector<int> solid_, block_;
  Parts part_;
  int block_count_ = 0;
};

// The surface of one block as a complex of unit squares, with merged faces counted on it.
class Surface {
 public:
  Surface(const Grid& grid, int block, std::vector<Square> squares)
      : grid_(grid), block_(block), squares_(std::move(squares)), faces_(squares_.size()) {
    for (std::size_t i = 0; i < squares_.size(); ++i)
      number_[key(squares_[i].cube, squares_[i].axis, squares_[i].up)] = static_cast<int>(i);
  }

  void count(GridBlock& out) {
    pair_edges();
    const int corners = 4 * static_cast<int>(squares_.size());
    Parts vertices(corners), shells(squares_.size());
    for (const Pair& p : pairs_) {
      for (int end = 0; end < 2; ++end)
        vertices.join(corner(p.square[0], p.end[end]), corner(p.square[1], p.end[end]));
      shells.join(p.square[0], p.square[1]);
      if (p.inner) faces_.join(p.square[0], p.square[1]);
    }
    std::set<int> vertex_set, shell_set, face_set;
    for (int c = 0; c < corners; ++c) vertex_set.insert(vertices.find(c));
    for (std::size_t s = 0; s < squares_.size(); ++s) {
      shell_set.insert(shells.find(static_cast<int>(s)));
      face_set.insert(faces_.find(static_cast<int>(s)));
    }
    const int euler = static_cast<int>(vertex_set.size()) - static_cast<int>(pairs_.size()) +
                      static_cast<int>(squares_.size());
    out.shells = static_cast<Index>(shell_set.size());
    out.genus = out.shells - euler / 2;
    out.counts.faces = static_cast<Index>(face_set.size());

    // Unit edges that bound faces, at each vertex of the surface: two in one line are the middle of an edge.
    std::map<int, std::vector<int>> axes_at;
    Index edges = 0;
    for (const Pair& p : pairs_) {
      if (p.inner) continue;
      ++edges;
      for (int end = 0; end < 2; ++end)
        axes_at[vertices.find(corner(p.square[0], p.end[end]))].push_back(p.axis);
    }
    out.counts.edges = edges;
    for (const auto& [v, axes] : axes_at) {
      if (axes.size() == 2 && axes[0] == axes[1])
        --out.counts.edges;
      else
        ++out.counts.vertices;
    }
    out.holes =
        out.counts.vertices - out.counts.edges + out.counts.faces - 2 * (out.shells - out.genus);
  }

  int face_of(const Cell& cube, int axis, bool up) {
    return faces_.find(number_.at(key(cube, axis, up)));
  }

 private:
  // Two squares that meet along a unit edge with the block's rock between them.
  struct Pair {
    int square[2];
    std::array<Cell, 2> end;
    int axis;
    bool inner;  // of one face
  };

  static std::tuple<Cell, int, bool> key(const Cell& c, int axis, bool up) { return {c, axis, up}; }

  // Number of the corner of a square at a grid point.
  int corner(int square, const Cell& at) const {
    const Square& s = squares_[square];
    const int u = s.axis == 0 ? 1 : 0, v = s.axis == 2 ? 1 : 2;
    return 4 * square + (at[u] - s.cube[u]) + 2 * (at[v] - s.cube[v]);
  }

  // Round each unit edge go four cubes; a run of cubes of the block is bounded by two squares.
  void pair_edges() {
    std::set<std::pair<Cell, int>> seen;
    for (const Square& s : squares_) {
      const Cell base = s.up ? Grid::step(s.cube, s.axis, 1) : s.cube;
      for (int d = 0; d < 3; ++d) {
        if (d == s.axis) continue;
        const int across = 3 - d - s.axis;
        for (int side = 0; side < 2; ++side) {
          const Cell from = Grid::step(base, across, side);
          if (seen.emplace(from, d).second) pair_edge(from, d);
        }
      }
    }
  }

  void pair_edge(const Cell& from, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    // Counter-clockwise: (+u, +v), (−u, +v), (−u, −v), (+u, −v). Cube k is left across `through[k]` to cube k + 1.
    const std::array<Cell, 4> cube{from, Grid::step(from, u, -1),
                                   Grid::step(Grid::step(from, u, -1), v, -1),
                                   Grid::step(from, v, -1)};
    const std::array<std::pair<int, bool>, 4> through{
        {{u, false}, {v, false}, {u, true}, {v, true}}};
    for (int k = 0; k < 4; ++k) {
      const int before = (k + 3) % 4;
      if (!mine(cube[k]) || mine(cube[before])) continue;
      int last = k;
      while (mine(cube[(last + 1) % 4])) last = (last + 1) % 4;
      // Cube k is entered across the square that cube `before` is left through, from the other side.
      const auto& [in_axis, in_up] = through[before];
      const auto& [out_axis, out_up] = through[last];
      Pair p;
      p.square[0] = number_.at(key(cube[k], in_axis, !in_up));
      p.square[1] = number_.at(key(cube[last], out_axis, out_up));
      p.end = {from, Grid::step(from, axis, 1)};
      p.axis = axis;
      const Square &a = squares_[p.square[0]], &b = squares_[p.square[1]];
      p.inner = a.axis == b.axis && a.up == b.up && a.origin == b.origin;
      pairs_.push_back(p);
    }
  }

  bool mine(const Cell& c) const { return grid_.block(c) == block_; }

  const Grid& grid_;
  const int block_;
  std::vector<Square> squares_;
  std::map<std::tuple<Cell, int, bool>, int> number_;
  std::vector<Pair> pairs_;
  Parts faces_;
};

// Cubes − squares + edges − points of each block that no dead-end joint and no surface touches (its dual complex).
void count_open_euler(const Grid& grid, const GridModel& m, std::vector<GridBlock>& out) {
  const auto whole = [&](const Cell& from, const std::array<int, 3>& reach, int& block) {
    // All cubes about the cell of the dual complex, and all squares between these, belong to one block.
    block = -1;
    for (int z = -reach[2]; z <= 0; ++z)
      for (int y = -reach[1]; y <= 0; ++y)
        for (int x = -reach[0]; x <= 0; ++x) {
          const Cell c{from[0] + x, from[1] + y, from[2] + z};
          const int b = grid.block(c);
          if (b < 0 || (block >= 0 && b != block)) return false;
          block = b;
          const std::array<int, 3> at{x, y, z};
          for (int d = 0; d < 3; ++d)
            if (at[d] < 0 && grid.joint_between(c, d) >= 0) return false;
        }
    return true;
  };
  for (int z = 0; z <= m.size[2]; ++z)
    for (int y = 0; y <= m.size[1]; ++y)
      for (int x = 0; x <= m.size[0]; ++x)
        for (int bits = 0; bits < 8; ++bits) {
          const std::array<int, 3> reach{bits & 1, bits >> 1 & 1, bits >> 2};
          int block = -1;
          if (whole({x, y, z}, reach, block))
            out[block].open_euler += (reach[0] + reach[1] + reach[2]) % 2 == 0 ? 1 : -1;
        }
}

}  // namespace

GridBlocks blocks_of(const GridModel& model) {
  const Grid grid(model);
  GridBlocks out;
  out.blocks.resize(grid.block_count());
  std::vector<std::vector<Square>> squares(grid.block_count());
  grid.each_cube([&](const Cell& c) {
    const int b = grid.block(c);
    if (b < 0) return;
    ++out.blocks[b].volume;
    for (int d = 0; d < 3; ++d) {
      out.blocks[b].centroid[d] += c[d] + 0.5;
      for (const bool up : {false, true})
        if (grid.block(Grid::step(c, d, up ? 1 : -1)) != b)
          squares[b].push_back({c, d, up, grid.origin(c, d, up)});
    }
  });
  std::vector<Surface> surfaces;
  for (int b = 0; b < grid.block_count(); ++b) {
    for (Real& x : out.blocks[b].centroid) x /= out.blocks[b].volume;
    surfaces.emplace_back(grid, b, squares[b]);
    surfaces.back().count(out.blocks[b]);
  }
  std::set<std::array<int, 4>> pairs;
  grid.each_inner_square([&](const Cell& below, const Cell& above, int axis) {
    if (grid.joint_between(below, axis) < 0) return;
    const int a = grid.block(below), b = grid.block(above);
    if (a == b) {
      ++out.dead_ends[axis];
      ++out.blocks[a].dead_ends[axis];
      return;
    }
    ++out.separating[axis];
    std::array<int, 4> pair{a, surfaces[a].face_of(below, axis, true), b,
                            surfaces[b].face_of(above, axis, false)};
    if (a > b) pair = {pair[2], pair[3], pair[0], pair[1]};
    pairs.insert(pair);
  });
  out.interfaces = static_cast<Index>(pairs.size());
  count_open_euler(grid, model, out.blocks);
  return out;
}

}  // namespace rockfold::test
