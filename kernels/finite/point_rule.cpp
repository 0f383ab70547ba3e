#include "kernels/finite/point_rule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/integrate/moments_kernel.hpp"
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

/// Coordinates in which the values of the polynomials at the points are at most 1 and well apart, as far as the points tell the polynomials
/// apart at all: Gram & Schmidt's method, at each step for the point with most left.
class Coordinates {
 public:
  Coordinates(const std::vector<RockPoint>& points, int degree) : points_(points.size()) {
    const std::size_t terms = integrate::count_to(degree);
    std::vector<Real> left = values(points, degree);  // [terms][points]
    std::vector<Real> direction(terms), share(points_);
    Real most = 0;
    for (std::size_t k = 0; k < std::min(terms, points_); ++k) {
      const auto [pivot, size] = longest(left);
      most = std::max(most, size);
      if (!(size > 1e-12 * most)) break;
      pivot_.push_back(pivot);
      for (std::size_t m = 0; m < terms; ++m) direction[m] = left[m * points_ + pivot] / size;
      std::fill(share.begin(), share.end(), 0.0);
      for (std::size_t m = 0; m < terms; ++m)
        add_scaled(points_, direction[m], &left[m * points_], share.data());
      for (std::size_t m = 0; m < terms; ++m)
        add_scaled(points_, -direction[m], share.data(), &left[m * points_]);
      for (const Real c : share) value_.push_back(c / size);
    }
  }

  std::size_t count() const { return pivot_.size(); }
  /// Points whose coordinates are independent: that of the k-th are 0 beyond its own, which is 1.
  const std::vector<Index>& pivots() const { return pivot_; }
  Real at(std::size_t coordinate, Index point) const {
    return value_[coordinate * points_ + point];
  }

  /// y += a x, n numbers.
  static void add_scaled(std::size_t n, Real a, const Real* x, Real* y) {
    for (std::size_t i = 0; i < n; ++i) y[i] += a * x[i];
  }

 private:
  static std::vector<Real> values(const std::vector<RockPoint>& points, int degree) {
    Polynomials polynomials(degree);
    std::vector<Real> of_point, all(points.size() * integrate::count_to(degree));
    for (std::size_t i = 0; i < points.size(); ++i) {
      polynomials.evaluate(points[i].eta, of_point);
      for (std::size_t m = 0; m < of_point.size(); ++m) all[m * points.size() + i] = of_point[m];
    }
    return all;
  }

  std::pair<Index, Real> longest(const std::vector<Real>& left) const {
    std::vector<Real> square(points_, 0);
    for (std::size_t m = 0; m < left.size(); m += points_)
      for (std::size_t i = 0; i < points_; ++i) square[i] += left[m + i] * left[m + i];
    const auto found = std::max_element(square.begin(), square.end());
    return {static_cast<Index>(found - square.begin()), std::sqrt(*found)};
  }

  std::size_t points_;
  std::vector<Index> pivot_;
  std::vector<Real> value_;  ///< [coordinates][points]
};

/// A rule of as many points as coordinates, and the inverse of their coordinates.
class Basis {
 public:
  Basis(const std::vector<RockPoint>& from, const Coordinates& coordinates)
      : from_(from),
        coordinates_(coordinates),
        size_(coordinates.count()),
        inverse_(size_ * size_, 0),
        share_(size_),
        weight_(size_, 0),
        point_(coordinates.pivots()) {
    for (std::size_t i = 0; i < size_; ++i) inverse_[i * size_ + i] = 1;
    for (std::size_t i = 0; i < size_; ++i) {
      find_shares(point_[i]);
      replace(i, point_[i], from_[point_[i]].weight);
      total_ += weight_[i];
    }
  }

  /// Takes point j in, with its weight.
  void absorb(Index j) {
    const Real given = from_[j].weight;
    find_shares(j);
    const std::size_t leaves = place_to_leave(given);
    const Real move = leaves < size_ ? weight_[leaves] / -share_[leaves] : given;
    for (std::size_t i = 0; i < size_; ++i)
      weight_[i] = std::max(0.0, weight_[i] + move * share_[i]);
    if (leaves < size_) replace(leaves, j, given - move);
    total_ += given;
  }

  /// Points and their weights, with what rounding has left in them on the way taken out as far as that makes them better.
  std::vector<std::pair<Index, Real>> result() {
    std::vector<Real> left = unbalanced(weight_), better(size_);
    for (int round = 0; round < 3; ++round) {
      std::fill(share_.begin(), share_.end(), 0.0);
      for (std::size_t m = 0; m < size_; ++m)
        Coordinates::add_scaled(size_, left[m], &inverse_[m * size_], share_.data());
      for (std::size_t i = 0; i < size_; ++i) better[i] = std::max(0.0, weight_[i] + share_[i]);
      std::vector<Real> left_then = unbalanced(better);
      if (!(largest(left_then) < largest(left))) break;
      weight_ = better;
      left = std::move(left_then);
    }
    std::vector<std::pair<Index, Real>> rule;
    for (std::size_t i = 0; i < size_; ++i)
      if (weight_[i] > 0) rule.emplace_back(point_[i], weight_[i]);
    return rule;
  }

 private:
  /// What the given rule's integrals of the coordinates have more than these weights'.
  std::vector<Real> unbalanced(const std::vector<Real>& weight) const {
    std::vector<Real> left(size_, 0);
    for (std::size_t m = 0; m < size_; ++m) {
      for (std::size_t j = 0; j < from_.size(); ++j)
        left[m] += from_[j].weight * coordinates_.at(m, static_cast<Index>(j));
      for (std::size_t i = 0; i < size_; ++i) left[m] -= weight[i] * coordinates_.at(m, point_[i]);
    }
    return left;
  }

  static Real largest(const std::vector<Real>& values) {
    Real most = 0;
    for (const Real v : values) most = std::max(most, std::abs(v));
    return most;
  }

  /// The point as a sum of those there are.
  void find_shares(Index j) {
    std::fill(share_.begin(), share_.end(), 0.0);
    for (std::size_t m = 0; m < size_; ++m)
      Coordinates::add_scaled(size_, coordinates_.at(m, j), &inverse_[m * size_], share_.data());
  }

  /// The point whose weight ends first as `most` of a new one is moved to the points there are; size_ if none ends, but for rounding. Of
  /// those that end within rounding of each other the one with the largest share: small ones would spoil the inverse (Harris 1973).
  std::size_t place_to_leave(Real most) const {
    const Real slack = 1e-14 * total_;
    Real bound = most;
    for (std::size_t i = 0; i < size_; ++i)
      if (share_[i] < 0) bound = std::min(bound, (weight_[i] + slack) / -share_[i]);
    std::size_t leaves = size_;
    if (bound < most)
      for (std::size_t i = 0; i < size_; ++i)
        if (share_[i] < 0 && weight_[i] <= bound * -share_[i] &&
            (leaves == size_ || share_[i] < share_[leaves]))
          leaves = i;
    return leaves;
  }

  /// Point j, whose shares are known, stands at place r from now on.
  void replace(std::size_t r, Index j, Real weight) {
    for (std::size_t m = 0; m < size_; ++m) {
      Real* column = &inverse_[m * size_];
      const Real pivot = column[r] / share_[r];
      Coordinates::add_scaled(size_, -pivot, share_.data(), column);
      column[r] = pivot;
    }
    point_[r] = j;
    weight_[r] = weight;
  }

  const std::vector<RockPoint>& from_;
  const Coordinates& coordinates_;
  std::size_t size_;
  std::vector<Real> inverse_;  ///< [coordinates][places]
  std::vector<Real> share_, weight_;
  std::vector<Index> point_;
  Real total_ = 0;  ///< of the weights taken in
};

/// The points in a box −1/2 … 1/2 about them.
std::vector<RockPoint> in_box(std::vector<RockPoint> points) {
  Vec3 low = points.front().eta, high = low;
  for (const RockPoint& p : points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p.eta[d]);
      high[d] = std::max(high[d], p.eta[d]);
    }
  for (RockPoint& p : points)
    for (int d = 0; d < 3; ++d)
      p.eta[d] = (p.eta[d] - 0.5 * (low[d] + high[d])) / std::max(high[d] - low[d], 1e-15);
  return points;
}

}  // namespace

std::vector<RockPoint> reduce(const std::vector<RockPoint>& points, int degree) {
  const std::size_t count = points.size();
  if (count <= static_cast<std::size_t>(integrate::count_to(degree))) return points;
  const Coordinates coordinates(in_box(points), degree);
  Basis basis(points, coordinates);
  std::vector<bool> taken(count, false);
  for (const Index j : coordinates.pivots()) taken[j] = true;
  for (std::size_t j = 0; j < count; ++j)
    if (!taken[j]) basis.absorb(static_cast<Index>(j));
  std::vector<RockPoint> few;
  for (const auto& [j, weight] : basis.result()) few.push_back({points[j].eta, weight});
  return few;
}

}  // namespace rockfold::finite
