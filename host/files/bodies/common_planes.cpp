#include "host/files/bodies/common_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Matrix = Eigen::SparseMatrix<Real>;

// Two directions in a plane, unit.
std::array<Vec3, 2> axes(const Vec3& normal) {
  int least = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) < std::abs(normal[least])) least = d;
  Vec3 along{};
  along[least] = 1;
  const Vec3 u = normalized(cross(normal, along));
  return {u, cross(normal, u)};
}

// Of rows·x = wanted the least x, but for a share of `damping` over the square of a singular value: the next step sees to it. Rows have a
// length of about 2; that much of a square is what rounding of the factors leaves.
Eigen::VectorXd least_change(const Matrix& rows, const Eigen::VectorXd& wanted) {
  constexpr Real damping = 1e-8;
  Matrix normal = rows.transpose() * rows;
  for (Eigen::Index i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += damping;
  const Eigen::SimplicialLDLT<Matrix> factors(normal);
  return factors.solve(rows.transpose() * wanted);
}

class Solver {
 public:
  Solver(std::vector<Vec3> corner, Index plane_count,
         const std::vector<std::pair<Index, Index>>& on)
      : on_(on) {
    for (const Vec3& x : corner) origin_ += (1 / static_cast<Real>(corner.size())) * x;
    for (Vec3& x : corner) x -= origin_;
    at_.corner = std::move(corner);
    fit_planes(plane_count);
  }

  CommonPlanes run() {
    // The error squares with each step, or falls by the damping where corners hang on each other in long chains.
    constexpr int most_steps = 20;
    at_.off = largest_residual();
    for (int step = 0; step < most_steps && at_.off > 0; ++step) {
      CommonPlanes before = at_;
      move();
      at_.off = largest_residual();
      if (at_.off < 0.5 * before.off) continue;
      if (at_.off > before.off) at_ = std::move(before);
      break;
    }
    for (Vec3& x : at_.corner) x += origin_;
    for (FittedPlane& plane : at_.plane) plane.centre += origin_;
    return std::move(at_);
  }

 private:
  void fit_planes(Index count) {
    std::vector<std::vector<Index>> corners(count);
    for (const auto& [c, p] : on_) corners[p].push_back(c);
    for (const auto& of_plane : corners) {
      PlaneFit fit(at_.corner[of_plane.front()]);
      for (const Index c : of_plane) fit.add(at_.corner[c]);
      at_.plane.push_back(fit.plane());
      Real size = 0;
      for (const Index c : of_plane)
        size = std::max(size, norm(at_.corner[c] - at_.plane.back().centre));
      size_.push_back(size);
    }
  }

  Real residual(const std::pair<Index, Index>& on) const {
    return at_.plane[on.second].above(at_.corner[on.first]);
  }
  Real largest_residual() const {
    Real most = 0;
    for (const auto& on : on_) most = std::max(most, std::abs(residual(on)));
    return most;
  }

  // Unknowns: 3 of a corner; of a plane how far its centre goes along the normal and its rim, `size` away, along it too.
  void move() {
    const auto corners = static_cast<Index>(at_.corner.size());
    std::vector<Eigen::Triplet<Real, Index>> entries;
    Eigen::VectorXd wanted(static_cast<Eigen::Index>(on_.size()));
    std::vector<std::array<Vec3, 2>> frame;
    for (const FittedPlane& plane : at_.plane) frame.push_back(axes(plane.normal));
    for (Index row = 0; row < static_cast<Index>(on_.size()); ++row) {
      const auto [c, p] = on_[row];
      const Vec3& n = at_.plane[p].normal;
      const Vec3 y = (1 / size_[p]) * (at_.corner[c] - at_.plane[p].centre);
      const Index at_plane = 3 * corners + 3 * p;
      for (int d = 0; d < 3; ++d) entries.emplace_back(row, 3 * c + d, n[d]);
      for (int k = 0; k < 2; ++k) entries.emplace_back(row, at_plane + k, dot(frame[p][k], y));
      entries.emplace_back(row, at_plane + 2, -1);
      wanted[row] = -residual(on_[row]);
    }
    const auto unknowns = 3 * corners + 3 * static_cast<Index>(at_.plane.size());
    Matrix rows(static_cast<Index>(on_.size()), unknowns);
    rows.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd change = least_change(rows, wanted);
    const auto at = [&](Index i) { return Vec3{change[i], change[i + 1], change[i + 2]}; };
    for (Index c = 0; c < corners; ++c) at_.corner[c] += at(3 * c);
    for (std::size_t p = 0; p < at_.plane.size(); ++p) {
      const Vec3 by = at(3 * corners + 3 * static_cast<Index>(p));
      FittedPlane& plane = at_.plane[p];
      const Vec3 turn = (by[0] / size_[p]) * frame[p][0] + (by[1] / size_[p]) * frame[p][1];
      plane.centre += by[2] * plane.normal;
      plane.normal = normalized(plane.normal + turn);
    }
  }

  const std::vector<std::pair<Index, Index>>& on_;
  Vec3 origin_{};
  std::vector<Real> size_;  // [planes] m, from the centre to the farthest corner
  CommonPlanes at_;
};

}  // namespace

CommonPlanes common_planes(std::vector<Vec3> corner, Index plane_count,
                           const std::vector<std::pair<Index, Index>>& on) {
  return Solver(std::move(corner), plane_count, on).run();
}

}  // namespace rockfold
