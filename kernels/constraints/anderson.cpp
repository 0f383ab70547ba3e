#include "kernels/constraints/anderson.hpp"

#include <cmath>
#include <stdexcept>
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

void Anderson::learn(Pair pair) {
  const Real before = dot(pair.df, pair.df);
  for (int pass = 0; pass < 2; ++pass)  // twice is enough (Kahan)
    for (const Pair& known : pairs_) {
      const Real share = dot(known.df, pair.df);
      add(pair.df, -share, known.df);
      add(pair.dx, -share, known.dx);
    }
  const Real length = std::sqrt(dot(pair.df, pair.df));
  // A change that is all but a combination of known ones has nothing to tell but rounding.
  if (!(length * length > 1e-8 * before)) return;
  for (Real& v : pair.df) v /= length;
  for (Real& v : pair.dx) v /= length;
  pairs_.push_back(std::move(pair));
  if (pairs_.size() > depth_) pairs_.pop_front();
}

std::vector<Real> Anderson::next(const Vector& x, const Vector& f) {
  if (!last_x_.empty()) learn({difference(x, last_x_), difference(f, last_f_)});
  last_x_ = x;
  last_f_ = f;
  // What of f the known changes can take away, they do; the rest goes the plain way.
  Vector rest = f, result = x;
  for (const Pair& known : pairs_) {
    const Real share = dot(known.df, rest);
    add(rest, -share, known.df);
    add(result, -share, known.dx);
  }
  add(result, 1, rest);
  return result;
}

std::vector<Real> Anderson::knowledge() const {
  std::vector<Real> numbers;
  for (const Pair& pair : pairs_)
    for (const Vector* v : {&pair.dx, &pair.df})
      numbers.insert(numbers.end(), v->begin(), v->end());
  return numbers;
}

void Anderson::learn(const Vector& knowledge, std::size_t n) {
  if (n == 0 ? !knowledge.empty() : knowledge.size() % (2 * n) != 0)
    throw std::invalid_argument("not the knowledge of an iteration of so many unknowns");
  forget();
  for (auto at = knowledge.begin(); at != knowledge.end();) {
    const auto middle = at + static_cast<std::ptrdiff_t>(n),
               end = middle + static_cast<std::ptrdiff_t>(n);
    pairs_.push_back({{at, middle}, {middle, end}});
    at = end;
  }
}

void Anderson::forget() {
  pairs_.clear();
  last_x_.clear();
}

}  // namespace rockfold::solve
