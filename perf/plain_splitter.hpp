// The yardstick for cutting: convex polyhedra split by planes in double precision, depth first with inherited plane lists
// as host/cut does it, but without exact decisions, plane ids, adjacency or threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "src/base/vector.hpp"

namespace rockfold {

struct PlainPlane {
  Vec3 normal;  ///< unit
  Real offset;
};

struct PlainCell {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;  ///< loops, counter-clockwise seen from outside
};

inline Real plain_volume(const PlainCell& cell) {
  Real volume6 = 0;
  const Vec3& o = cell.points.front();
  for (const auto& f : cell.faces)
    for (std::size_t k = 1; k + 1 < f.size(); ++k)
      volume6 +=
          dot(cell.points[f[0]] - o, cross(cell.points[f[k]] - o, cell.points[f[k + 1]] - o));
  return volume6 / 6;
}

class PlainSplitter {
 public:
  explicit PlainSplitter(std::vector<PlainPlane> planes) : planes_(std::move(planes)) {}

  std::vector<PlainCell> run(const Vec3& low, const Vec3& high) {
    PlainCell box;
    for (int c = 0; c < 8; ++c)
      box.points.push_back(
          {(c & 1 ? high : low)[0], (c & 2 ? high : low)[1], (c & 4 ? high : low)[2]});
    box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<int> all(planes_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    descend(box, all, 0);
    return std::move(cells_);
  }

 private:
  void descend(const PlainCell& cell, const std::vector<int>& list, std::size_t from) {
    Vec3 centre{};
    for (const Vec3& p : cell.points) centre += (1.0 / static_cast<Real>(cell.points.size())) * p;
    Real radius = 0;
    for (const Vec3& p : cell.points) radius = std::max(radius, norm(p - centre));
    for (std::size_t i = from; i < list.size(); ++i) {
      const PlainPlane& plane = planes_[list[i]];
      if (std::abs(dot(plane.normal, centre) - plane.offset) > radius) continue;
      if (!classify(cell, plane)) continue;
      // Only planes that reach the cell are handed on.
      std::vector<int> rest;
      for (std::size_t j = i + 1; j < list.size(); ++j)
        if (std::abs(dot(planes_[list[j]].normal, centre) - planes_[list[j]].offset) <= radius)
          rest.push_back(list[j]);
      const PlainCell below = part(cell, -1), above = part(cell, 1);
      descend(below, rest, 0);
      descend(above, rest, 0);
      return;
    }
    cells_.push_back(cell);
  }

  bool classify(const PlainCell& cell, const PlainPlane& plane) {
    distance_.clear();
    bool below = false, above = false;
    for (const Vec3& p : cell.points) {
      Real d = dot(plane.normal, p) - plane.offset;
      if (std::abs(d) < 1e-11) d = 0;
      distance_.push_back(d);
      below = below || d < 0;
      above = above || d > 0;
    }
    return below && above;
  }

  PlainCell part(const PlainCell& cell, int side) const {
    PlainCell out;
    std::vector<int> number(cell.points.size(), -1);
    std::map<std::pair<int, int>, int> cut;
    std::map<int, int> cap;  // from a point of the cap to the next
    const auto keep = [&](int v) {
      if (number[v] < 0)
        number[v] = static_cast<int>(out.points.size()), out.points.push_back(cell.points[v]);
      return number[v];
    };
    const auto crossing = [&](int u, int v) {
      const auto [it, fresh] =
          cut.try_emplace(std::minmax(u, v), static_cast<int>(out.points.size()));
      if (fresh) {
        const auto [a, b] = it->first;
        const Real t = distance_[a] / (distance_[a] - distance_[b]);
        out.points.push_back((1 - t) * cell.points[a] + t * cell.points[b]);
      }
      return it->second;
    };
    for (const auto& face : cell.faces) {
      std::vector<int> loop;
      int leave = -1, enter = -1;
      bool any = false;
      for (const int v : face) any = any || distance_[v] * side > 0;
      if (!any) continue;
      for (std::size_t k = 0; k < face.size(); ++k) {
        const int u = face[k], v = face[k + 1 == face.size() ? 0 : k + 1];
        const Real du = distance_[u] * side, dv = distance_[v] * side;
        if (du >= 0) loop.push_back(keep(u));
        if (du == 0 && dv <= 0) leave = loop.back();
        if (du == 0 && dv > 0) enter = loop.back();
        if (du * dv < 0) {
          loop.push_back(crossing(u, v));
          (du > 0 ? leave : enter) = loop.back();
        }
      }
      if (leave >= 0 && enter >= 0 && leave != enter) cap[enter] = leave;
      out.faces.push_back(std::move(loop));
    }
    std::vector<int> loop;
    const int first = cap.begin()->first;
    for (int at = first; loop.empty() || at != first; at = cap.at(at)) loop.push_back(at);
    out.faces.push_back(std::move(loop));
    return out;
  }

  std::vector<PlainPlane> planes_;
  std::vector<Real> distance_;
  std::vector<PlainCell> cells_;
};

}  // namespace rockfold
