#include "kernels/finite/point_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "kernels/integrate/moments_kernel.hpp"
#include "src/base/gauss.hpp"
#include "src/base/vector.hpp"

namespace rockfold::finite {

namespace {

/// All products of Legendre's polynomials up to a total degree, at points of the cell.
class Polynomials {
 public:
  explicit Polynomials(int degree) : degree_(degree), line_(3 * (degree + 1)) {}

  void evaluate(const Vec3& x, std::vector<Real>& value) {
    const int n = degree_ + 1;
    for (int d = 0; d < 3; ++d) {
      Real* p = &line_[static_cast<std::size_t>(d) * n];
      p[0] = 1;
      if (degree_ > 0) p[1] = 2 * x[d];
      for (int k = 2; k < n; ++k)
        p[k] = ((2 * k - 1) * 2 * x[d] * p[k - 1] - (k - 1) * p[k - 2]) / k;
    }
    value.clear();
    for (int a = 0; a < n; ++a)
      for (int b = 0; a + b < n; ++b)
        for (int c = 0; a + b + c < n; ++c)
          value.push_back(line_[a] * line_[n + b] * line_[2 * n + c] *
                          std::sqrt((2.0 * a + 1) * (2 * b + 1) * (2 * c + 1)));
  }

 private:
  int degree_;
  std::vector<Real> line_;
};

/// A rule of as many points as polynomials, and the inverse of their values. Where there is no point yet stands a unit vector with no
/// weight, which must never get any.
class Basis {
 public:
  Basis(const PointRule& from, int degree)
      : from_(from),
        polynomials_(degree),
        size_(integrate::count_to(degree)),
        inverse_(size_ * size_, 0),
        share_(size_),
        weight_(size_, 0),
        point_(size_, none) {
    for (std::size_t i = 0; i < size_; ++i) inverse_[i * size_ + i] = 1;
  }

  /// Takes point j with its weight in; false: it tells the polynomials still without a point apart, but less than `least`.
  bool absorb(Index j, Real least) {
    polynomials_.evaluate(from_.point[j], value_);
    for (std::size_t i = 0; i < size_; ++i)
      share_[i] = std::inner_product(value_.begin(), value_.end(), &inverse_[i * size_], 0.0);
    const std::size_t open = largest_open();
    if (open < size_ && std::abs(share_[open]) > rounding) {
      if (std::abs(share_[open]) < least) return false;
      replace(open, j, from_.weight[j]);
      return true;
    }
    Real move = from_.weight[j];
    std::size_t leaves = size_;
    for (std::size_t i = 0; i < size_; ++i)
      if (point_[i] != none && share_[i] < -rounding && weight_[i] < -share_[i] * move) {
        move = -weight_[i] / share_[i];
        leaves = i;
      }
    for (std::size_t i = 0; i < size_; ++i)
      if (point_[i] != none) weight_[i] = std::max(0.0, weight_[i] + move * share_[i]);
    if (leaves < size_) replace(leaves, j, from_.weight[j] - move);
    return true;
  }

  /// With weights found anew from all of the given rule: what rounding has left in them on the way goes.
  PointRule result() {
    std::vector<Real> left(size_, 0);
    for (std::size_t j = 0; j < from_.size(); ++j) add(from_.point[j], from_.weight[j], left);
    std::fill(weight_.begin(), weight_.end(), 0.0);
    for (int round = 0; round < 3; ++round) {
      for (std::size_t i = 0; i < size_; ++i)
        if (point_[i] != none) {
          const Real step = std::inner_product(left.begin(), left.end(), &inverse_[i * size_], 0.0);
          weight_[i] += step;
          share_[i] = step;
        }
      for (std::size_t i = 0; i < size_; ++i)
        if (point_[i] != none) add(from_.point[point_[i]], -share_[i], left);
    }
    PointRule rule;
    for (std::size_t i = 0; i < size_; ++i)
      if (weight_[i] > 0) rule.add(from_.point[point_[i]], weight_[i]);
    return rule;
  }

 private:
  static constexpr Real rounding = 1e-11;

  /// sum += w · polynomials(x)
  void add(const Vec3& x, Real w, std::vector<Real>& sum) {
    polynomials_.evaluate(x, value_);
    for (std::size_t m = 0; m < size_; ++m) sum[m] += w * value_[m];
  }

  /// The place without a point that the new one has most of.
  std::size_t largest_open() const {
    std::size_t best = size_;
    Real most = -1;
    for (std::size_t i = 0; i < size_; ++i)
      if (point_[i] == none && std::abs(share_[i]) > most) {
        most = std::abs(share_[i]);
        best = i;
      }
    return best;
  }

  /// Point j, whose shares are known, stands at place r from now on.
  void replace(std::size_t r, Index j, Real weight) {
    Real* pivot_row = &inverse_[r * size_];
    for (std::size_t m = 0; m < size_; ++m) pivot_row[m] /= share_[r];
    for (std::size_t i = 0; i < size_; ++i) {
      if (i == r) continue;
      Real* row = &inverse_[i * size_];
      const Real s = share_[i];
      for (std::size_t m = 0; m < size_; ++m) row[m] -= s * pivot_row[m];
    }
    point_[r] = j;
    weight_[r] = weight;
  }

  const PointRule& from_;
  Polynomials polynomials_;
  std::size_t size_;
  std::vector<Real> inverse_;  ///< [places][polynomials]
  std::vector<Real> value_, share_, weight_;
  std::vector<Index> point_;
};

}  // namespace

PointRule tetrahedron_rule(int degree) {
  const int n = (degree + 2) / 2;
  PointRule rule;
  for (const auto& a : gauss_points(n, 2))
    for (const auto& b : gauss_points(n, 1))
      for (const auto& c : gauss_points(n))
        rule.add({a.x, b.x * (1 - a.x), c.x * (1 - a.x) * (1 - b.x)},
                 6 * a.weight * b.weight * c.weight);
  return rule;
}

PointRule cell_rule(int degree) {
  const auto line = gauss_points((degree + 2) / 2);
  PointRule rule;
  for (const auto& a : line)
    for (const auto& b : line)
      for (const auto& c : line)
        rule.add({a.x - 0.5, b.x - 0.5, c.x - 0.5}, a.weight * b.weight * c.weight);
  return rule;
}

PointRule reduce(const PointRule& rule, int degree) {
  if (rule.size() <= static_cast<std::size_t>(integrate::count_to(degree))) return rule;
  // Far apart first: neighbours tell little apart.
  std::vector<Index> waiting;
  const std::size_t count = rule.size();
  std::size_t stride = static_cast<std::size_t>(0.618 * static_cast<Real>(count));
  while (std::gcd(stride, count) != 1) ++stride;
  for (std::size_t i = 0; i < count; ++i) waiting.push_back(static_cast<Index>(i * stride % count));
  Basis basis(rule, degree);
  for (Real least = 1e-1; !waiting.empty(); least *= 1e-2) {
    const auto taken = [&](Index j) { return basis.absorb(j, least); };
    waiting.erase(std::remove_if(waiting.begin(), waiting.end(), taken), waiting.end());
  }
  return basis.result();
}

}  // namespace rockfold::finite
