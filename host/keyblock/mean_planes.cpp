#include "host/keyblock/mean_planes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Of angles between doubles that ought to be equal.
constexpr Real rounding = 1e-9;

/// Means are taken anew so often at most; later rounds move hardly any facet.
constexpr int most_rounds = 20;

class PlaneSearch {
 public:
  PlaneSearch(std::span<const SurfaceFacet> facets, Real flatness)
      : limit_((1 + rounding) * 2 * std::sin(0.5 * flatness * std::numbers::pi / 180)),
        least_(least_area(facets)),
        order_(facets.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    const auto key = [&](std::size_t i) { return std::tie(facets[i].normal, facets[i].area); };
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    for (const std::size_t i : order_)
      if (facets[i].area > least_) weighty_.push_back(facets[i]);
    plane_.assign(weighty_.size(), 0);
  }

  std::vector<Vec3> run(std::span<const SurfaceFacet> facets) {
    find_planes();
    std::vector<Vec3> normals(facets.size());
    std::size_t next = 0;
    for (const std::size_t i : order_)
      normals[i] = mean_[facets[i].area > least_ ? plane_[next++] : nearest(facets[i].normal)];
    return normals;
  }

 private:
  struct Farthest {
    std::size_t facet = 0;
    Real distance = 0;
  };

  static Real least_area(std::span<const SurfaceFacet> facets) {
    std::vector<Real> areas;
    for (const SurfaceFacet& f : facets) areas.push_back(f.area);
    std::sort(areas.begin(), areas.end());
    const Real most = least_plane_share * std::accumulate(areas.begin(), areas.end(), Real{0});
    Real least = 0, sum = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      sum += areas[i];
      if (sum > most) break;
      if (i + 1 == areas.size() || areas[i + 1] > areas[i]) least = areas[i];
    }
    return least;
  }

  void find_planes() {
    mean_ = {weighty_.front().normal};
    take_means();
    if (farthest_from_mean().distance <= limit_) return;
    begin_planes();
    settle();
    for (auto far = farthest_from_mean(); far.distance > limit_; far = farthest_from_mean()) {
      if (mean_.size() >= weighty_.size()) return keep_normals();
      mean_.push_back(weighty_[far.facet].normal);
      settle();
    }
  }

  /// One for each of the facets that are more than twice the flatness apart from each other.
  void begin_planes() {
    Farthest far = farthest_from_mean();
    mean_.clear();
    std::vector<Real> distance(weighty_.size(), 4);  // to the nearest of those found; more than any
    do {
      mean_.push_back(weighty_[far.facet].normal);
      far = {};
      for (std::size_t i = 0; i < weighty_.size(); ++i) {
        distance[i] = std::min(distance[i], norm(weighty_[i].normal - mean_.back()));
        if (distance[i] > far.distance) far = {i, distance[i]};
      }
    } while (far.distance > 2 * limit_);
  }

  void settle() {
    for (int round = 0; round < most_rounds; ++round) {
      bool changed = false;
      for (std::size_t i = 0; i < weighty_.size(); ++i) {
        const std::size_t now = nearest(weighty_[i].normal);
        changed = changed || now != plane_[i];
        plane_[i] = now;
      }
      take_means();
      if (!changed) return;
    }
  }

  /// Of what belongs to each plane; where that is nothing, or cancels, the mean stays.
  void take_means() {
    std::vector<Vec3> sum(mean_.size());
    std::vector<Real> area(mean_.size(), 0);
    for (std::size_t i = 0; i < weighty_.size(); ++i) {
      sum[plane_[i]] += weighty_[i].area * weighty_[i].normal;
      area[plane_[i]] += weighty_[i].area;
    }
    for (std::size_t p = 0; p < mean_.size(); ++p)
      if (norm(sum[p]) > rounding * area[p]) mean_[p] = normalized(sum[p]);
  }

  std::size_t nearest(const Vec3& normal) const {
    std::size_t best = 0;
    for (std::size_t p = 1; p < mean_.size(); ++p)
      if (norm(normal - mean_[p]) < norm(normal - mean_[best])) best = p;
    return best;
  }

  Farthest farthest_from_mean() const {
    Farthest far;
    for (std::size_t i = 0; i < weighty_.size(); ++i)
      if (const Real d = norm(weighty_[i].normal - mean_[plane_[i]]); d > far.distance)
        far = {i, d};
    return far;
  }

  void keep_normals() {
    mean_.clear();
    for (std::size_t i = 0; i < weighty_.size(); ++i) {
      mean_.push_back(weighty_[i].normal);
      plane_[i] = i;
    }
  }

  Real limit_;                      ///< between the ends of unit normals that are `flatness` apart
  Real least_;                      ///< m²: facets of no more begin no plane
  std::vector<std::size_t> order_;  ///< [facets] by normal, then area
  std::vector<SurfaceFacet> weighty_;  ///< those that may begin a plane, in that order
  std::vector<std::size_t> plane_;     ///< [weighty] into mean_
  std::vector<Vec3> mean_;
};

}  // namespace

std::vector<Vec3> mean_plane_normals(std::span<const SurfaceFacet> facets, Real flatness) {
  if (facets.empty()) return {};
  if (flatness > 0) return PlaneSearch(facets, flatness).run(facets);
  std::vector<Vec3> normals;
  for (const SurfaceFacet& f : facets) normals.push_back(f.normal);
  return normals;
}

}  // namespace rockfold
