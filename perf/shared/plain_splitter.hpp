// The yardstick for cutting: convex polyhedra split by planes in double precision, depth first with inherited plane lists
// as host/cut does it, but without exact decisions, plane ids, adjacency or threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "src/base/vector.hpp"

namespace rockfold {

struct PlainPlane {
  Vec3 normal;  ///< unit
  Real offset;
};

/// Faces are loops of points, one after another: face f is corners[face_begin[f]] … corners[face_begin[f + 1] − 1],
/// counter-clockwise seen from outside. A vector for each face, and a tree for the points on cut edges, cost three times as much.
struct PlainCell {
  std::vector<Vec3> points;
  std::vector<int> corners, face_begin{0};

  void clear() {
    points.clear();
    corners.clear();
    face_begin.assign(1, 0);
  }
};

/// Cells one after another.
struct PlainCells {
  std::vector<Vec3> points;
  std::vector<int> corners, face_begin;
  struct Begin {
    std::size_t points, corners, faces;
  };
  std::vector<Begin> begin{{0, 0, 0}};  ///< [size + 1]; a cell has one face_begin more than faces

  std::size_t size() const { return begin.size() - 1; }
  void append(const PlainCell& cell) {
    points.insert(points.end(), cell.points.begin(), cell.points.end());
    corners.insert(corners.end(), cell.corners.begin(), cell.corners.end());
    face_begin.insert(face_begin.end(), cell.face_begin.begin(), cell.face_begin.end());
    begin.push_back({points.size(), corners.size(), face_begin.size()});
  }
  Real volume(std::size_t cell) const {
    const Begin &at = begin[cell], &end = begin[cell + 1];
    const Vec3* point = &points[at.points];
    Real volume6 = 0;
    for (std::size_t f = at.faces; f + 1 < end.faces; ++f) {
      const int* loop = &corners[at.corners];
      for (int k = face_begin[f] + 1; k + 1 < face_begin[f + 1]; ++k)
        volume6 += dot(point[loop[face_begin[f]]] - point[0],
                       cross(point[loop[k]] - point[0], point[loop[k + 1]] - point[0]));
    }
    return volume6 / 6;
  }
};

class PlainSplitter {
 public:
  explicit PlainSplitter(std::vector<PlainPlane> planes) : planes_(std::move(planes)) {}

  PlainCells run(const Vec3& low, const Vec3& high) {
    PlainCell box;
    for (int c = 0; c < 8; ++c)
      box.points.push_back(
          {(c & 1 ? high : low)[0], (c & 2 ? high : low)[1], (c & 4 ? high : low)[2]});
    box.corners = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
    box.face_begin = {0, 4, 8, 12, 16, 20, 24};
    std::vector<int> all(planes_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    descend(box, all, 0);
    return std::move(cells_);
  }

 private:
  struct Level {
    PlainCell below, above;
    std::vector<int> rest;
  };
  struct CutEdge {
    int low, high, point;
  };

  void descend(const PlainCell& cell, const std::vector<int>& list, std::size_t depth) {
    if (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
    Level& level = *levels_[depth];
    Vec3 centre{};
    for (const Vec3& p : cell.points) centre += (1.0 / static_cast<Real>(cell.points.size())) * p;
    Real radius2 = 0;
    for (const Vec3& p : cell.points) radius2 = std::max(radius2, dot(p - centre, p - centre));
    const Real radius = std::sqrt(radius2);
    const auto reaches = [&](int plane) {
      return std::abs(dot(planes_[plane].normal, centre) - planes_[plane].offset) <= radius;
    };
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!reaches(list[i]) || !classify(cell, planes_[list[i]])) continue;
      // Only planes that reach the cell are handed on.
      level.rest.clear();
      for (std::size_t j = i + 1; j < list.size(); ++j)
        if (reaches(list[j])) level.rest.push_back(list[j]);
      part(cell, -1, level.below);
      part(cell, 1, level.above);
      descend(level.below, level.rest, depth + 1);
      descend(level.above, level.rest, depth + 1);
      return;
    }
    cells_.append(cell);
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

  int keep(const PlainCell& cell, int v, PlainCell& out) {
    if (number_[v] < 0) {
      number_[v] = static_cast<int>(out.points.size());
      out.points.push_back(cell.points[v]);
    }
    return number_[v];
  }

  int crossing(const PlainCell& cell, int u, int v, PlainCell& out) {
    if (u > v) std::swap(u, v);
    for (const CutEdge& e : cut_)
      if (e.low == u && e.high == v) return e.point;
    const Real t = distance_[u] / (distance_[u] - distance_[v]);
    cut_.push_back({u, v, static_cast<int>(out.points.size())});
    out.points.push_back((1 - t) * cell.points[u] + t * cell.points[v]);
    return cut_.back().point;
  }

  void part(const PlainCell& cell, int side, PlainCell& out) {
    out.clear();
    number_.assign(cell.points.size(), -1);
    cut_.clear();
    cap_.clear();
    for (std::size_t f = 0; f + 1 < cell.face_begin.size(); ++f) {
      const int* face = &cell.corners[cell.face_begin[f]];
      const int n = cell.face_begin[f + 1] - cell.face_begin[f];
      int leave = -1, enter = -1;
      bool any = false;
      for (int k = 0; k < n; ++k) any = any || distance_[face[k]] * side > 0;
      if (!any) continue;
      for (int k = 0; k < n; ++k) {
        const int u = face[k], v = face[k + 1 == n ? 0 : k + 1];
        const Real du = distance_[u] * side, dv = distance_[v] * side;
        if (du >= 0) out.corners.push_back(keep(cell, u, out));
        if (du == 0 && dv <= 0) leave = out.corners.back();
        if (du == 0 && dv > 0) enter = out.corners.back();
        if (du * dv < 0) {
          out.corners.push_back(crossing(cell, u, v, out));
          (du > 0 ? leave : enter) = out.corners.back();
        }
      }
      if (leave >= 0 && enter >= 0 && leave != enter) cap_.emplace_back(enter, leave);
      out.face_begin.push_back(static_cast<int>(out.corners.size()));
    }
    const int first = cap_.front().first;
    int at = first;
    do {
      out.corners.push_back(at);
      at = std::find_if(cap_.begin(), cap_.end(), [&](const auto& e) {
             return e.first == at;
           })->second;
    } while (at != first);
    out.face_begin.push_back(static_cast<int>(out.corners.size()));
  }

  std::vector<PlainPlane> planes_;
  std::vector<Real> distance_;
  std::vector<int> number_;
  std::vector<CutEdge> cut_;
  std::vector<std::pair<int, int>> cap_;  // from a point of the cap to the next
  std::vector<std::unique_ptr<Level>> levels_;
  PlainCells cells_;
};

}  // namespace rockfold
