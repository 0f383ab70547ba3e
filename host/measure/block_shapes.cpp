#include "host/measure/block_shapes.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real cube_factor =
    7.7;  // 6 faces × the mean chord of the unit cube, 1.282 (Kalenchuk et al. 2006)
constexpr Real greatest_ratio = 1e7;

/// What the vertices are taken about, and the unit of length: block coordinates may be large.
struct Frame {
  Vec3 origin{};
  Real unit = 1;
};

Frame frame_of(const BlockArrays& blocks, Index b) {
  Frame frame{blocks.centroid[b], 0};
  for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v)
    frame.unit = std::max(frame.unit, norm(blocks.vertex[v] - frame.origin));
  if (!(frame.unit > 0)) frame.unit = 1;
  return frame;
}

/// Between two vertices.
struct Chord {
  Real length;
  Index along;  ///< into Workspace::along
};

/// What one thread works in, block after block.
struct Workspace {
  std::vector<Vec3> points;
  std::vector<Vec3> along;
  std::vector<Chord> chords;
};

/// Evenly spaced vertices of a block, at most most_chord_vertices.
void find_chord_vertices(const BlockArrays& blocks, Index b, const Frame& frame,
                         std::vector<Vec3>& points) {
  const std::int64_t first = blocks.vertex_begin[b], n = blocks.vertex_begin[b + 1] - first;
  const std::int64_t taken = std::min<std::int64_t>(n, most_chord_vertices);
  points.clear();
  for (std::int64_t i = 0; i < taken; ++i)
    points.push_back((1 / frame.unit) * (blocks.vertex[first + i * n / taken] - frame.origin));
}

void find_chords(Workspace& my) {
  my.along.clear();
  my.chords.clear();
  for (std::size_t i = 0; i < my.points.size(); ++i)
    for (std::size_t j = i + 1; j < my.points.size(); ++j) {
      my.along.push_back(my.points[j] - my.points[i]);
      my.chords.push_back({norm(my.along.back()), static_cast<Index>(my.chords.size())});
    }
}

Real mean_length(const std::vector<Chord>& chords) {
  Real sum = 0;
  for (const Chord& c : chords) sum += c.length;
  return sum / static_cast<Real>(chords.size());
}

/// Σ_ab (a·b)² is the squared Frobenius norm of Σ_a a aᵀ, so that no pairs are visited.
Real beta_of(Workspace& my) {
  std::vector<Chord>& chords = my.chords;
  const auto middle = static_cast<std::ptrdiff_t>(chords.size() / 2);
  const auto shorter = [](const Chord& a, const Chord& b) { return a.length < b.length; };
  std::nth_element(chords.begin(), chords.begin() + middle, chords.end(), shorter);
  Real median = chords[middle].length;
  if (chords.size() % 2 == 0)
    median =
        0.5 * (median + std::max_element(chords.begin(), chords.begin() + middle, shorter)->length);
  // Chords of one length differ by rounding.
  const Real least = median * (1 - 1e-12);
  Mat3 m{};
  Real trace = 0;
  for (const Chord& c : chords) {
    if (c.length < least) continue;
    const Vec3& along = my.along[c.along];
    for (int i = 0; i < 3; ++i) m[i] += along[i] * along;
    trace += c.length * c.length;
  }
  const Real correlated = dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2]);
  const Real share = correlated / (trace * trace);
  return 10 * share * share;
}

/// Covariance of the block's volume about its centroid, from tetrahedra between the centroid and a fan over each loop:
/// signed, so that holes and concave loops come out right.
Eigen::Matrix3d covariance(const BlockArrays& blocks, Index b, const Frame& frame) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Real volume = 0;
  const auto at = [&](Index corner) {
    const Vec3 x = (1 / frame.unit) * (blocks.vertex[blocks.corner_vertex[corner]] - frame.origin);
    return Eigen::Vector3d(x[0], x[1], x[2]);
  };
  const Index first_loop = blocks.loop_begin[blocks.face_begin[b]];
  const Index last_loop = blocks.loop_begin[blocks.face_begin[b + 1]];
  for (Index l = first_loop; l < last_loop; ++l) {
    const Index begin = blocks.corner_begin[l], end = blocks.corner_begin[l + 1];
    const Eigen::Vector3d p = at(begin);
    for (Index c = begin + 1; c + 1 < end; ++c) {
      const Eigen::Vector3d q = at(c), r = at(c + 1), s = p + q + r;
      const Real v = p.dot(q.cross(r)) / 6;
      // ∫x xᵀ over a tetrahedron with a corner at 0: V/20 (Σ x_i x_iᵀ + s sᵀ).
      sum +=
          v / 20 * (p * p.transpose() + q * q.transpose() + r * r.transpose() + s * s.transpose());
      volume += v;
    }
  }
  return sum / volume;
}

Real aspect_ratio_of(const BlockArrays& blocks, Index b, const Frame& frame) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance(blocks, b, frame),
                                                              Eigen::EigenvaluesOnly);
  const Real least = solver.eigenvalues()[0], most = solver.eigenvalues()[2];
  if (!(least * greatest_ratio * greatest_ratio > most)) return greatest_ratio;
  return std::sqrt(most / least);
}

BlockShape shape_of(const BlockArrays& blocks, Index b, Workspace& my) {
  BlockShape shape;
  for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
    shape.surface_area += blocks.face_area[f];
  const Frame frame = frame_of(blocks, b);
  find_chord_vertices(blocks, b, frame, my.points);
  find_chords(my);
  shape.alpha =
      shape.surface_area * frame.unit * mean_length(my.chords) / (cube_factor * blocks.volume[b]);
  // A sliver whose corners coincide in doubles has no shape left: as thin as can be.
  if (!(shape.alpha < greatest_ratio)) shape.alpha = greatest_ratio;
  const Real beta = beta_of(my);
  shape.beta = beta >= 0 ? beta : 10;
  shape.aspect_ratio = aspect_ratio_of(blocks, b, frame);
  return shape;
}

}  // namespace

ShapeClass shape_class(Real alpha, Real beta) {
  if (beta >= 7) return ShapeClass::elongated;
  if (beta >= 4) return alpha < 3 ? ShapeClass::cubic_elongated : ShapeClass::elongated_platy;
  if (alpha < 2) return ShapeClass::cubic;
  return alpha < 5 ? ShapeClass::platy_cubic : ShapeClass::platy;
}

std::vector<BlockShape> block_shapes(const BlockArrays& blocks) {
  constexpr Index chunk = 64;
  const Index count = blocks.block_count();
  std::vector<BlockShape> shapes(count);
  parallel_for((count + chunk - 1) / chunk, 1, [&](std::int64_t k) {
    Workspace workspace;
    const auto begin = static_cast<Index>(k * chunk);
    for (Index b = begin; b < std::min(begin + chunk, count); ++b)
      shapes[b] = shape_of(blocks, b, workspace);
  });
  return shapes;
}

}  // namespace rockfold
