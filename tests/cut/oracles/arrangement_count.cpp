#include "tests/cut/oracles/arrangement_count.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rockfold::test {

namespace {

using Long = long double;
using LongVec = std::array<Long, 3>;

struct Plane {
  LongVec n;  // unit
  Long d;     // about the box' centre
};

LongVec cross(const LongVec& a, const LongVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Long dot(const LongVec& a, const LongVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

class Counter {
 public:
  Counter(const Vec3& low, const Vec3& high, const std::vector<PointAndNormal>& given) {
    LongVec centre;
    for (int d = 0; d < 3; ++d) {
      centre[d] = (Long{low[d]} + Long{high[d]}) / 2;
      half_[d] = (Long{high[d]} - Long{low[d]}) / 2;
    }
    diagonal_ = 2 * std::sqrt(dot(half_, half_));
    for (const auto& [point, normal] : given) {
      LongVec n{normal[0], normal[1], normal[2]};
      const Long length = std::sqrt(dot(n, n));
      for (Long& x : n) x /= length;
      planes_.push_back({n, n[0] * (point[0] - centre[0]) + n[1] * (point[1] - centre[1]) +
                                n[2] * (point[2] - centre[2])});
    }
  }

  ArrangementCount run() {
    for (const Plane& p : planes_)
      if (decide(std::abs(p.n[0]) * half_[0] + std::abs(p.n[1]) * half_[1] +
                 std::abs(p.n[2]) * half_[2] - std::abs(p.d)))
        ++count_.planes;
    for (std::size_t i = 0; i < planes_.size(); ++i)
      for (std::size_t j = i + 1; j < planes_.size(); ++j) {
        if (line_hits(planes_[i], planes_[j])) ++count_.lines;
        for (std::size_t k = j + 1; k < planes_.size(); ++k) count_point(i, j, k);
      }
    return count_;
  }

 private:
  bool decide(Long distance) {
    count_.clearance = std::min(count_.clearance, std::abs(distance) / diagonal_);
    return distance > 0;
  }

  // The line x(t) = o + t·u within the three slabs |x_d| < half_d.
  bool line_hits(const Plane& p, const Plane& q) {
    const LongVec u = cross(p.n, q.n), a = cross(q.n, u), b = cross(u, p.n);
    const Long uu = dot(u, u);
    Long from = -1e30L, to = 1e30L;
    for (int d = 0; d < 3; ++d) {
      const Long o = (p.d * a[d] + q.d * b[d]) / uu;
      const Long t1 = (-half_[d] - o) / u[d], t2 = (half_[d] - o) / u[d];
      from = std::max(from, std::min(t1, t2));
      to = std::min(to, std::max(t1, t2));
    }
    return decide((to - from) * std::sqrt(uu));
  }

  void count_point(std::size_t i, std::size_t j, std::size_t k) {
    const Plane &p = planes_[i], &q = planes_[j], &r = planes_[k];
    const LongVec qr = cross(q.n, r.n), rp = cross(r.n, p.n), pq = cross(p.n, q.n);
    const Long det = dot(p.n, qr);
    LongVec x;
    bool inside = true;
    Long margin = 1e30L;
    for (int d = 0; d < 3; ++d) {
      x[d] = (p.d * qr[d] + q.d * rp[d] + r.d * pq[d]) / det;
      inside = inside && std::abs(x[d]) < half_[d];
      margin = std::min(margin, half_[d] - std::abs(x[d]));
    }
    decide(margin);
    if (!inside) return;
    ++count_.points;
    for (std::size_t s = 0; s < planes_.size(); ++s)
      if (s != i && s != j && s != k) decide(dot(planes_[s].n, x) - planes_[s].d);
  }

  LongVec half_{};
  Long diagonal_ = 0;
  std::vector<Plane> planes_;
  ArrangementCount count_;
};

}  // namespace

ArrangementCount count_cells(const Vec3& low, const Vec3& high,
                             const std::vector<PointAndNormal>& planes) {
  return Counter(low, high, planes).run();
}

}  // namespace rockfold::test
