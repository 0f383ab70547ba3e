#include "host/files/meshes/separate_bodies.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "host/cut/bodies/union_find.hpp"
#include "host/cut/cells/patch.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

class Separator {
 public:
  Separator(const PolygonSoup& soup, bool by_place)
      : soup_(soup), by_place_(by_place), parts_(soup.polygon_count()) {}

  std::vector<SoupBody> run() {
    find_labels();
    join_polygons();
    find_surfaces();
    join_cavities();
    return bodies();
  }

 private:
  struct Surface {
    std::vector<Index> polygons;
    Box box;
    Real volume = 0;  ///< m³, below 0 of one that is inside out
    std::size_t around = none_around;
  };
  static constexpr std::size_t none_around = std::numeric_limits<std::size_t>::max();

  const Vec3& corner(Index k) const { return soup_.vertices[soup_.corner[k]]; }

  void find_labels() {
    label_.assign(soup_.polygon_count(), none);
    for (std::size_t l = 0; l < soup_.labels.size(); ++l) {
      const Index end =
          l + 1 < soup_.labels.size() ? soup_.labels[l + 1].first : soup_.polygon_count();
      std::fill(label_.begin() + soup_.labels[l].first, label_.begin() + end,
                static_cast<Index>(l));
    }
  }
  Index object_of(Index polygon) const {
    return label_[polygon] == none ? 0 : soup_.labels[label_[polygon]].object;
  }

  // A vertex of two objects is none that joins them.
  void join_polygons() {
    std::map<std::pair<Index, Index>, Index> by_vertex;
    std::map<std::pair<Index, Vec3>, Index> by_point;
    for (Index p = 0; p < soup_.polygon_count(); ++p)
      for (Index k = soup_.corner_begin[p]; k < soup_.corner_begin[p + 1]; ++k) {
        const Index object = object_of(p);
        const auto first = by_place_
                               ? by_point.try_emplace({object, corner(k)}, p).first->second
                               : by_vertex.try_emplace({object, soup_.corner[k]}, p).first->second;
        parts_.join(first, p);
      }
  }

  void find_surfaces() {
    const std::vector<Index> component = parts_.components();
    for (Index p = 0; p < soup_.polygon_count(); ++p) {
      if (component[p] == static_cast<Index>(surfaces_.size())) surfaces_.emplace_back();
      Surface& surface = surfaces_[component[p]];
      surface.polygons.push_back(p);
      const Index begin = soup_.corner_begin[p], end = soup_.corner_begin[p + 1];
      const Vec3 origin = corner(soup_.corner_begin[surface.polygons.front()]);
      for (Index k = begin; k < end; ++k) surface.box.add(corner(k));
      for (Index k = begin + 1; k + 1 < end; ++k)
        surface.volume +=
            dot(corner(begin) - origin, cross(corner(k) - origin, corner(k + 1) - origin)) / 6;
    }
  }

  static bool holds(const Box& outer, const Box& inner) {
    for (int d = 0; d < 3; ++d)
      if (inner.low[d] <= outer.low[d] || inner.high[d] >= outer.high[d]) return false;
    return true;
  }

  void join_cavities() {
    for (Surface& cavity : surfaces_) {
      if (cavity.volume >= 0) continue;
      for (std::size_t s = 0; s < surfaces_.size(); ++s)
        if (surfaces_[s].volume > 0 && holds(surfaces_[s].box, cavity.box) &&
            (cavity.around == none_around || surfaces_[s].volume < surfaces_[cavity.around].volume))
          cavity.around = s;
    }
    for (const Surface& cavity : surfaces_)
      if (cavity.around != none_around) {
        auto& polygons = surfaces_[cavity.around].polygons;
        polygons.insert(polygons.end(), cavity.polygons.begin(), cavity.polygons.end());
      }
  }

  std::vector<SoupBody> bodies() const {
    std::vector<SoupBody> bodies;
    std::set<std::string> objects, groups;
    for (const Surface& surface : surfaces_) {
      if (surface.around != none_around) continue;
      SoupBody& body = bodies.emplace_back();
      body.soup = soup_of(surface.polygons);
      if (const Index label = label_[surface.polygons.front()]; label != none) {
        objects.insert(soup_.labels[label].object_name);
        groups.insert(soup_.labels[label].group_name);
      }
    }
    auto body = bodies.begin();
    for (const Surface& surface : surfaces_) {
      if (surface.around != none_around) continue;
      if (const Index label = label_[surface.polygons.front()]; label != none) {
        const auto& names = soup_.labels[label];
        body->name = groups.size() > objects.size() || names.object_name.empty()
                         ? names.group_name
                         : names.object_name;
      }
      ++body;
    }
    return bodies;
  }

  PolygonSoup soup_of(const std::vector<Index>& polygons) const {
    PolygonSoup part;
    part.single_precision = soup_.single_precision;
    std::map<Index, Index> number;
    for (const Index p : polygons) {
      for (Index k = soup_.corner_begin[p]; k < soup_.corner_begin[p + 1]; ++k) {
        const auto [at, is_new] =
            number.try_emplace(soup_.corner[k], static_cast<Index>(part.vertices.size()));
        if (is_new) part.vertices.push_back(corner(k));
        part.corner.push_back(at->second);
      }
      part.corner_begin.push_back(static_cast<Index>(part.corner.size()));
      part.line.push_back(soup_.line[p]);
    }
    return part;
  }

  const PolygonSoup& soup_;
  bool by_place_;
  UnionFind parts_;
  std::vector<Index> label_;  ///< [polygons] none = before the first one
  std::vector<Surface> surfaces_;
};

}  // namespace

std::vector<SoupBody> separate_bodies(const PolygonSoup& soup, bool by_place) {
  return Separator(soup, by_place).run();
}

}  // namespace rockfold
