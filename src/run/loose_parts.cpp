#include "src/run/loose_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

using Mat6 = std::array<std::array<Real, 6>, 6>;

/// Union-find over covers; the root of a part is its smallest cover.
class Parts {
 public:
  explicit Parts(Index covers) : parent_(covers) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index root(Index p) {
    while (parent_[p] != p) p = parent_[p] = parent_[parent_[p]];
    return p;
  }
  void join(Index a, Index b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

Parts join_through_elements(const CoverArrays& covers) {
  Parts parts(covers.cover_count());
  const std::size_t per_cell = covers.nodes_per_cell(), per_part = covers.nodes_per_part();
  for (std::size_t i = 0; i < covers.regular_cover.size(); ++i)
    parts.join(covers.regular_cover[i], covers.regular_cover[i / per_cell * per_cell]);
  for (std::size_t i = 0; i < covers.element_cover.size(); ++i)
    parts.join(covers.element_cover[i], covers.element_cover[i / per_part * per_part]);
  return parts;
}

/// What a rigid motion (t, ω) does to the row of a fixed point: shift · t + ω × arm.
struct RigidRow {
  Real shift = 0;
  Vec3 arm{};                        ///< m, about the part's origin
  std::array<std::uint8_t, 3> held;  ///< components
};

/// In the covers' functions a rigid motion is that of their origins and, with functions ξ, its slope (shape_functions.hpp).
RigidRow rigid_row(const CoverArrays& covers, const FixedPoints& fixed, std::size_t n,
                   const Vec3& origin) {
  const MaterialPoints& points = fixed.points;
  RigidRow row;
  row.held = fixed.component[n];
  for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
    const Index function = points.unknown[i] / covers.cover_count();
    const Index cover = points.unknown[i] % covers.cover_count();
    const Real weight = points.weight[i];
    if (function == 0) {
      row.shift += weight;
      row.arm += weight * (function_origin(covers, cover) - origin);
    } else if (function < 4) {
      row.arm += (weight * covers.reach) * covers.lattice.edge[function - 1];
    }
  }
  return row;
}

/// The fixed points of a part, and what its rigid motions are measured in: turns about the middle of the points, of such a size that
/// they move the points as far as translations do, however small the part is beside the lattice.
struct Holding {
  std::vector<RigidRow> rows;
  Vec3 origin{};  ///< m, a node of the part

  /// Σ over fixed components of the outer product of what the six motions do to that component.
  Mat6 gram(Real lattice_size) const {
    Vec3 middle{};
    Real shifts = 0, arms = 0;
    for (const RigidRow& row : rows) middle += row.shift * row.arm, shifts += row.shift * row.shift;
    if (shifts > 0) middle = (1 / shifts) * middle;
    for (const RigidRow& row : rows) {
      const Vec3 arm = row.arm - row.shift * middle;
      arms += dot(arm, arm);
    }
    // What is left of the arms of one point is rounding.
    const Real spread = shifts > 0 ? std::sqrt(arms / shifts) : 0;
    const Real size = spread > 1e-11 * lattice_size ? spread : lattice_size;
    Mat6 sum{};
    for (const RigidRow& row : rows)
      for (int d = 0; d < 3; ++d) {
        if (!row.held[d]) continue;
        Vec3 axis{};
        axis[d] = 1;
        const Vec3 arm = (1 / size) * (row.arm - row.shift * middle);
        const Vec3 turn = cross(arm, axis);  // axis · (ω × arm) = ω · (arm × axis)
        const Vec3 shift = row.shift * axis;
        const std::array<Real, 6> motion{shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]};
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j) sum[i][j] += motion[i] * motion[j];
      }
    return sum;
  }
  bool any() const {
    return std::any_of(rows.begin(), rows.end(), [](const RigidRow& row) {
      return row.held != std::array<std::uint8_t, 3>{};
    });
  }
};

void rotate(Mat6& a, Mat6& v, int p, int q) {
  const Real theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const Real t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const Real c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (int k = 0; k < 6; ++k)
    std::tie(a[k][p], a[k][q]) = std::pair{c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]};
  for (int k = 0; k < 6; ++k)
    std::tie(a[p][k], a[q][k]) = std::pair{c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]};
  for (int k = 0; k < 6; ++k)
    std::tie(v[k][p], v[k][q]) = std::pair{c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]};
}

/// Eigenvectors (columns of v) of a symmetric matrix, which becomes its eigenvalues (Jacobi's method).
Mat6 diagonalise(Mat6& a) {
  Mat6 v{};
  for (int i = 0; i < 6; ++i) v[i][i] = 1;
  for (int sweep = 0; sweep < 30; ++sweep)
    for (int p = 0; p < 6; ++p)
      for (int q = p + 1; q < 6; ++q)
        if (std::abs(a[p][q]) > 1e-17 * (std::abs(a[p][p]) + std::abs(a[q][q]))) rotate(a, v, p, q);
  return v;
}

std::string direction(Vec3 v) {
  v = normalized(v);
  std::string text = "(";
  for (int d = 0; d < 3; ++d) {
    const Real rounded = std::round(1000 * v[d]) / 1000;
    std::string number = std::to_string(rounded == 0 ? 0.0 : rounded);
    number.resize(number.size() - 3);
    text += (d > 0 ? ", " : "") + number;
  }
  return text + ")";
}

std::string describe_motion(const Vec3& shift, const Vec3& turn) {
  const bool moves = norm(shift) > 1e-6, turns = norm(turn) > 1e-6;
  if (!turns) return "translation along " + direction(shift);
  return "rotation about " + direction(turn) +
         (moves ? " with translation along " + direction(shift) : "");
}

/// Free motions: eigenvectors whose eigenvalue is nothing but rounding (the trace counts fixed components).
std::vector<std::string> free_motions(Mat6 gram) {
  Real trace = 0;
  for (int i = 0; i < 6; ++i) trace += gram[i][i];
  const Mat6 vectors = diagonalise(gram);
  std::vector<std::string> motions;
  for (int k = 0; k < 6; ++k)
    if (gram[k][k] <= 1e-12 * trace)
      motions.push_back(describe_motion({vectors[0][k], vectors[1][k], vectors[2][k]},
                                        {vectors[3][k], vectors[4][k], vectors[5][k]}));
  return motions;
}

std::map<Index, std::set<Index>> blocks_of_parts(const CoverArrays& covers, Parts& parts) {
  std::map<Index, std::set<Index>> blocks;
  for (Index r = 0; r < covers.regular_count(); ++r)
    blocks[parts.root(covers.regular_cover[covers.nodes_per_cell() * r])].insert(
        covers.regular_block[r]);
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      blocks[parts.root(covers.element_cover[covers.nodes_per_part() * e])].insert(
          covers.piece_block[q]);
  return blocks;
}

}  // namespace

std::vector<LoosePart> find_loose_parts(const CoverArrays& covers, const FixedPoints& fixed) {
  Parts parts = join_through_elements(covers);
  const auto blocks = blocks_of_parts(covers, parts);
  std::map<Index, Holding> holdings;
  for (std::size_t n = 0; n < fixed.points.size(); ++n) {
    const Index part = parts.root(element_nodes(covers, fixed.points.element[n]).cover[0]);
    Holding& holding = holdings[part];
    holding.origin = covers.lattice.node_position(covers.cover_node[part]);
    holding.rows.push_back(rigid_row(covers, fixed, n, holding.origin));
  }

  const Real size = norm(covers.lattice.edge[0] + covers.lattice.edge[1] + covers.lattice.edge[2]);
  const bool cannot_turn = covers.lattice.kind == LatticeKind::block && covers.order == 0;
  std::map<Index, int> parts_of_block;
  for (const auto& [part, ids] : blocks)
    for (const Index b : ids) ++parts_of_block[b];
  std::vector<LoosePart> loose;
  for (const auto& [part, ids] : blocks) {
    LoosePart found{{ids.begin(), ids.end()}, {}};
    for (const Index b : ids) found.cut_off = found.cut_off || parts_of_block[b] > 1;
    const Holding& holding = holdings[part];
    if (holding.any()) {
      Mat6 gram = holding.gram(size);
      // Blocks that have no function but a translation cannot turn.
      for (int i = 3; cannot_turn && i < 6; ++i) gram[i][i] += 1;
      found.motions = free_motions(gram);
    }
    if (!holding.any() || !found.motions.empty()) loose.push_back(found);
  }
  std::sort(loose.begin(), loose.end(),
            [](const LoosePart& a, const LoosePart& b) { return a.blocks < b.blocks; });
  return loose;
}

void require_no_loose_parts(const CoverArrays& covers, const FixedPoints& fixed) {
  const std::vector<LoosePart> loose = find_loose_parts(covers, fixed);
  if (loose.empty()) return;
  constexpr std::size_t most = 5;  // blocks and parts named
  std::string message = "static analysis: " + std::to_string(loose.size()) +
                        (loose.size() == 1 ? " part is" : " parts are") +
                        " free to move as a rigid body:";
  for (std::size_t i = 0; i < std::min(most, loose.size()); ++i) {
    const auto& blocks = loose[i].blocks;
    message += i == 0 ? " " : "; ";
    if (loose[i].cut_off) message += "what is cut off from the rest of ";
    message += blocks.size() == 1 ? "block " : "blocks ";
    for (std::size_t b = 0; b < std::min(most, blocks.size()); ++b)
      message += (b > 0 ? ", " : "") + std::to_string(blocks[b] + 1);
    if (blocks.size() > most) message += ", …";
    if (loose[i].motions.empty()) message += " (nothing holds it)";
    for (std::size_t m = 0; m < loose[i].motions.size(); ++m)
      message += (m == 0 ? " (" : ", ") + loose[i].motions[m] +
                 (m + 1 == loose[i].motions.size() ? ")" : "");
  }
  if (loose.size() > most) message += "; …";
  message +=
      ". Fix points of it, or let blocks hold each other by contact: type = \"quasi_static\", as a "
      "[[step]] before others too";
  if (std::any_of(loose.begin(), loose.end(), [](const LoosePart& part) { return part.cut_off; }))
    message += "; cover.joint_tips = \"keep\" prolongs no joint through a block";
  throw Error(ErrorKind::analysis, message);
}

}  // namespace rockfold
