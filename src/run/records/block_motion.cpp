#include "src/run/records/block_motion.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/operator/elements/part_functions.hpp"
#include "src/base/vector.hpp"
#include "src/space/element_points.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

Real determinant(const Mat3& a) {
  return dot(a[0], cross(a[1], a[2]));
}

/// The rotation of a's polar decomposition: a ← (a + a⁻ᵀ)/2 until it stays (Higham 1986). det a > 0.
Mat3 nearest_rotation(Mat3 a) {
  for (int step = 0; step < 50; ++step) {
    const Real det = determinant(a);
    Real change = 0;
    Mat3 next;
    for (int i = 0; i < 3; ++i) {
      // Row i of the inverse's transpose.
      const Vec3 cofactor = (1 / det) * cross(a[(i + 1) % 3], a[(i + 2) % 3]);
      next[i] = 0.5 * (a[i] + cofactor);
      change = std::max(change, norm(next[i] - a[i]));
    }
    a = next;
    if (change < 1e-14) break;
  }
  return a;
}

/// Axis times angle, up to π.
Vec3 rotation_vector(const Mat3& r) {
  const Vec3 twice_sine{r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
  const Real sine = 0.5 * norm(twice_sine), cosine = 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1);
  const Real angle = std::atan2(sine, cosine);
  if (sine > 1e-7) return (0.5 * angle / sine) * twice_sine;
  if (cosine > 0) return 0.5 * twice_sine;
  // Half a turn: R + I = 2 n nᵀ.
  int most = 0;
  for (int i = 1; i < 3; ++i)
    if (r[i][i] > r[most][most]) most = i;
  Vec3 axis = r[most];
  axis[most] += 1;
  return angle * normalized(axis);
}

/// Sums over the parts of a block: displacement and its gradient times volume until they are divided by it.
class Averages {
 public:
  Averages(const CoverArrays& covers, const std::vector<Vec3>& displacement, Index blocks,
           bool large)
      : covers_(covers),
        functions_(lattice_functions(covers)),
        d_(displacement),
        sums_(blocks),
        gradient_(blocks, Mat3{}),
        before_(blocks, 0),
        large_(large) {}

  const LatticeFunctions& functions() const { return functions_; }

  /// A body of a part (counted through all forms) with covers `cover`, its moments in m³ times `share`.
  void add(Index block, int part, const Index* cover, const Real* moments, Real share) {
    BlockMotion& sum = sums_[block];
    const Real volume = share * moments[0];
    before_[block] += volume;
    Mat3 gradient{};  // ∫ ∂u/∂x dV
    const PartFunctions& of = functions_.part[part];
    const int n = functions_.functions;
    const auto integral = [&](const Real* coefficients, int terms) {
      Real total = 0;
      for (int m = 0; m < terms; ++m) total += coefficients[m] * moments[m];
      return share * total;
    };
    for (int f = 0; f < functions_.nodes * n; ++f) {
      const Vec3& d = d_[f % n * covers_.cover_count() + cover[f / n]];
      sum.displacement += integral(&of.value[f * functions_.terms()], functions_.terms()) * d;
      Vec3 slope{};
      for (int i = 0; i < 3; ++i)
        slope[i] =
            integral(&of.slope[(3 * f + i) * functions_.slope_terms()], functions_.slope_terms());
      // Functions 0 by differences to the first node's, so that a translation has no gradient.
      const Vec3 by = f % n == 0 ? d - d_[cover[0]] : d;
      for (int i = 0; i < 3; ++i) gradient[i] += by[i] * slope;
    }
    add_gradient(block, volume, gradient);
  }

  /// An element or a piece of it at its points, where functions are known at points alone.
  void add(Index block, const ElementNodes& nodes, const std::vector<RockPoint>& points,
           const ElementFunctions& functions) {
    const int n = covers_.functions();
    std::vector<FunctionValue> value(functions.width());
    Real volume = 0;
    Mat3 gradient{};
    for (const RockPoint& p : points) {
      volume += p.weight;
      functions.at(nodes, p.eta, value.data());
      for (int f = 0; f < functions.width(); ++f) {
        const Vec3& d = d_[f % n * covers_.cover_count() + nodes.cover[f / n]];
        sums_[block].displacement += (p.weight * value[f].value) * d;
        const Vec3 by = f % n == 0 ? d - d_[nodes.cover[0]] : d;
        for (int i = 0; i < 3; ++i) gradient[i] += (p.weight * by[i]) * value[f].gradient;
      }
    }
    before_[block] += volume;
    add_gradient(block, volume, gradient);
  }

  std::vector<BlockMotion> take() {
    for (std::size_t b = 0; b < sums_.size(); ++b) {
      if (!(before_[b] > 0)) continue;
      BlockMotion& block = sums_[b];
      block.displacement = (1 / before_[b]) * block.displacement;
      Mat3 mean = gradient_[b];
      for (Vec3& row : mean) row = (1 / before_[b]) * row;
      block.rotation =
          0.5 * Vec3{mean[2][1] - mean[1][2], mean[0][2] - mean[2][0], mean[1][0] - mean[0][1]};
      for (int i = 0; i < 3; ++i) mean[i][i] += 1;
      if (large_ && determinant(mean) > 0) block.rotation = rotation_vector(nearest_rotation(mean));
    }
    return std::move(sums_);
  }

 private:
  /// `gradient`: ∫ ∂u/∂x dV over a body.
  void add_gradient(Index block, Real volume, const Mat3& gradient) {
    Mat3 deformed = gradient;
    for (int i = 0; i < 3; ++i) {
      gradient_[block][i] += gradient[i];
      deformed[i] = (volume > 0 ? 1 / volume : 0) * deformed[i];
      deformed[i][i] += 1;
    }
    sums_[block].volume += large_ ? volume * determinant(deformed) : volume;
  }

  const CoverArrays& covers_;
  LatticeFunctions functions_;
  const std::vector<Vec3>& d_;
  std::vector<BlockMotion> sums_;
  std::vector<Mat3> gradient_;  // ∫ ∂u/∂x dV
  std::vector<Real> before_;    // m³, volume before the motion
  bool large_;
};

/// The part of a cut element, counted through all forms.
int part_of(const CoverArrays& covers, Index e) {
  return covers.element_part[e] +
         covers.parts_per_cell() * form_of_cell(covers.lattice, covers.element_cell[e]);
}

/// Where functions are known at points alone.
std::vector<BlockMotion> average_sampled_motion(const CoverArrays& covers, Averages& sums) {
  const ElementPoints rule(covers, sampling_degree(covers));
  const ElementFunctions functions(covers);
  const Index whole = covers.parts_per_cell() * covers.regular_count();
  std::vector<RockPoint> points;
  for (Index e = 0; e < whole; ++e) {
    points.clear();
    rule.add_element(e, points);
    sums.add(covers.regular_block[e / covers.parts_per_cell()], element_nodes(covers, e), points,
             functions);
  }
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
      points.clear();
      rule.add_piece(q, points);
      sums.add(covers.piece_block[q], element_nodes(covers, whole + e), points, functions);
    }
  return sums.take();
}

/// [cut elements] m³.
std::vector<Real> cut_volumes(const CoverArrays& covers, const PieceMoments& moments) {
  std::vector<Real> volume(covers.cut_count(), 0);
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      volume[e] += moments.volume[q];
  return volume;
}

/// [blocks] m³ below which an element is a sliver beside the largest of its block, or a whole one.
std::vector<Real> sliver_volumes(const CoverArrays& covers, const std::vector<Real>& volume) {
  constexpr Real share = 1e-3;
  const auto& edge = covers.lattice.edge;
  const Real whole = std::abs(dot(edge[0], cross(edge[1], edge[2]))) / covers.parts_per_cell();
  std::vector<Real> least;
  const auto offer = [&](Index block, Real of_element) {
    if (block >= static_cast<Index>(least.size())) least.resize(block + 1, 0);
    least[block] = std::max(least[block], share * std::min(whole, of_element));
  };
  for (const Index block : covers.regular_block) offer(block, whole);
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      offer(covers.piece_block[q], volume[e]);
  return least;
}

}  // namespace

std::vector<BlockMotion> average_block_motion(const CoverArrays& covers,
                                              const PieceMoments& moments,
                                              const std::vector<Vec3>& displacement, Index blocks,
                                              bool large) {
  Averages sums(covers, displacement, blocks, large);
  if (covers.sampled()) return average_sampled_motion(covers, sums);
  const LatticeFunctions& all = sums.functions();
  for (Index r = 0; r < covers.regular_count(); ++r) {
    const int first = all.parts * form_of_cell(covers.lattice, covers.regular_cell[r]);
    for (int part = first; part < first + all.parts; ++part) {
      std::array<Index, 8> cover{};
      for (int a = 0; a < all.nodes; ++a)
        cover[a] = covers.regular_cover[all.cell_nodes * r + all.part[part].node[a]];
      sums.add(covers.regular_block[r], part, cover.data(), all.part[part].moment.data(), 1);
    }
  }
  const std::size_t terms =
      moments.volume.empty() ? 0 : moments.local.size() / moments.volume.size();
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      sums.add(covers.piece_block[q], part_of(covers, e),
               &covers.element_cover[static_cast<std::size_t>(all.nodes) * e],
               &moments.local[terms * q], all.share);
  return sums.take();
}

LargestDisplacement find_largest_displacement(const CoverArrays& covers,
                                              const PieceMoments& moments,
                                              const std::vector<Vec3>& displacement) {
  LargestDisplacement largest;
  const std::vector<Real> volume = cut_volumes(covers, moments);
  const std::vector<Real> least = sliver_volumes(covers, volume);
  const auto offer = [&](const Vec3& u, const Vec3& point, Index block) {
    if (largest.block == none || norm(u) > largest.length) largest = {norm(u), point, block};
  };
  const int cell_nodes = covers.nodes_per_cell();
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int c = 0; c < cell_nodes; ++c)
      // At a node of a whole cell all functions of its cover vanish but the constant one.
      offer(displacement[covers.regular_cover[cell_nodes * r + c]],
            covers.lattice.node_position(covers.lattice.cell_node(covers.regular_cell[r], c)),
            covers.regular_block[r]);
  const LatticeFunctions all = lattice_functions(covers);
  const ElementFunctions functions(covers);
  const int n = covers.functions();
  std::vector<Real> value(functions.width());
  std::vector<FunctionValue> sampled(functions.width());
  const Index whole = covers.parts_per_cell() * covers.regular_count();
  for (Index e = 0; e < covers.cut_count(); ++e) {
    if (volume[e] < least[covers.piece_block[covers.piece_begin[e]]]) continue;
    const Vec3 centre = covers.lattice.cell_centre(covers.element_cell[e]);
    const ElementNodes nodes = element_nodes(covers, whole + e);
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      for (Index v = covers.vertex_begin[q]; v < covers.vertex_begin[q + 1]; ++v) {
        const Vec3 x{covers.vertex_xyz[3 * v], covers.vertex_xyz[3 * v + 1],
                     covers.vertex_xyz[3 * v + 2]};
        const Vec3 eta = covers.lattice.to_local(x);
        if (covers.sampled()) {
          functions.at(nodes, eta, sampled.data());
          for (std::size_t f = 0; f < value.size(); ++f) value[f] = sampled[f].value;
        } else {
          value = all.values(part_of(covers, e), eta);
        }
        Vec3 u{};
        for (std::size_t f = 0; f < value.size(); ++f)
          u += value[f] * displacement[f % n * covers.cover_count() + nodes.cover[f / n]];
        offer(u, centre + x, covers.piece_block[q]);
      }
  }
  return largest;
}

}  // namespace rockfold
