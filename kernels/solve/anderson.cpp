#include "kernels/solve/anderson.hpp"

#include <cmath>
#include <utility>

namespace rockfold::solve {
namespace {

using Vector = std::vector<Real>;

Real dot(const Vector& a, const Vector& b) {
  Real sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Vector difference(const Vector& a, const Vector& b) {
  Vector d(a.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

/// y += s·x.
void add(Vector& y, Real s, const Vector& x) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += s * x[i];
}

}  // namespace

std::vector<Real> Anderson::next(const Vector& x, const Vector& f) {
  if (!last_x_.empty()) {
    pairs_.push_front({difference(x, last_x_), difference(f, last_f_)});
    if (pairs_.size() > depth_) pairs_.pop_back();
  }
  last_x_ = x;
  last_f_ = f;
  // Gram-Schmidt on the changes of f, newest first, carrying the changes of x along: each orthogonal part takes its share
  // out of f. A change that is all but a combination of newer ones has nothing to tell.
  Vector rest = f, result = x;
  std::vector<Pair> orthogonal;
  for (const Pair& pair : pairs_) {
    Pair p = pair;
    const Real before = dot(p.df, p.df);
    for (int pass = 0; pass < 2; ++pass)
      for (const Pair& q : orthogonal) {
        const Real share = dot(q.df, p.df);
        add(p.df, -share, q.df);
        add(p.dx, -share, q.dx);
      }
    const Real length = std::sqrt(dot(p.df, p.df));
    if (!(length * length > 1e-8 * before)) continue;
    for (Real& v : p.df) v /= length;
    for (Real& v : p.dx) v /= length;
    const Real share = dot(p.df, rest);
    add(rest, -share, p.df);
    add(result, -share, p.dx);
    orthogonal.push_back(std::move(p));
  }
  add(result, 1, rest);
  return result;
}

void Anderson::forget() {
  pairs_.clear();
  last_x_.clear();
}

}  // namespace rockfold::solve
