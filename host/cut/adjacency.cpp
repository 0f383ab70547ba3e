#include "host/cut/adjacency.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

struct FaceRef {
  Index cell = none, face = none;
};

// A face with what is needed to match it: its edges as a sorted set, and a bounding ball.
struct PlaneFace {
  FaceRef ref;
  std::uint64_t hash = 0;
};

std::uint64_t mix(std::uint64_t x) {  // the finaliser of SplitMix64
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9u;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Independent of where the loop starts and which way it runs.
std::uint64_t edge_set_hash(const CellView& cell, const ConvexCell::Face& face) {
  std::uint64_t sum = static_cast<std::uint64_t>(face.count);
  for (const auto& corner : cell.corners.subspan(face.begin, face.count))
    sum += mix(static_cast<std::uint64_t>(corner.neighbour) + 0x9e3779b97f4a7c15u);
  return sum;
}

std::vector<HalfSpaceId> edge_set(const CellView& cell, const ConvexCell::Face& face) {
  std::vector<HalfSpaceId> set;
  for (const auto& corner : cell.corners.subspan(face.begin, face.count))
    set.push_back(corner.neighbour);
  std::sort(set.begin(), set.end());
  return set;
}

// What one plane contributes; polygon numbers are local until all planes are joined.
struct PlaneResult {
  std::vector<Fragment> fragments;
  std::vector<FreePart> free_parts;
  std::vector<Polygon> polygons;
  IntentCount intent;
};

class PlaneMatcher {
 public:
  PlaneMatcher(const Complex& complex, Index plane)
      : complex_(complex), plane_(plane), clipper_(complex.planes) {}

  PlaneResult run(std::vector<PlaneFace>& below, std::vector<PlaneFace>& above) {
    const auto order = [](const PlaneFace& a, const PlaneFace& b) {
      return a.hash != b.hash ? a.hash < b.hash : a.ref.cell < b.ref.cell;
    };
    std::sort(below.begin(), below.end(), order);
    std::sort(above.begin(), above.end(), order);
    match_equal(below, above);
    overlap_rest();
    result_.intent = clipper_.intent;
    return std::move(result_);
  }

 private:
  struct Loose {
    FaceRef ref;
    Polygon polygon;
    Vec3 low{}, high{};
    std::vector<Polygon> rest;  // not yet covered by a face of the other side
    bool touched = false;
  };

  ConvexCell::Face face(const FaceRef& ref) const {
    return complex_.cells[ref.cell].faces[ref.face];
  }

  bool same_edges(const FaceRef& a, const FaceRef& b) const {
    return edge_set(complex_.cells[a.cell], face(a)) == edge_set(complex_.cells[b.cell], face(b));
  }

  void match_equal(const std::vector<PlaneFace>& below, const std::vector<PlaneFace>& above) {
    std::size_t j = 0;
    for (const PlaneFace& b : below) {
      while (j < above.size() && above[j].hash < b.hash) loosen(above[j++].ref, loose_above_);
      if (j < above.size() && above[j].hash == b.hash && same_edges(b.ref, above[j].ref)) {
        add_fragment(b.ref, above[j].ref, none,
                     polygon_moments(face_polygon(complex_.cells[b.ref.cell], face(b.ref))).area);
        ++j;
      } else {
        loosen(b.ref, loose_below_);
      }
    }
    while (j < above.size()) loosen(above[j++].ref, loose_above_);
  }

  void loosen(const FaceRef& ref, std::vector<Loose>& list) const {
    Loose loose;
    loose.ref = ref;
    loose.polygon = face_polygon(complex_.cells[ref.cell], face(ref));
    loose.low = loose.high = loose.polygon.corner.front().x;
    for (const Vertex& v : loose.polygon.corner)
      for (int d = 0; d < 3; ++d) {
        loose.low[d] = std::min(loose.low[d], v.x[d]);
        loose.high[d] = std::max(loose.high[d], v.x[d]);
      }
    list.push_back(std::move(loose));
  }

  static bool boxes_meet(const Loose& a, const Loose& b, Real slack) {
    for (int d = 0; d < 3; ++d)
      if (a.low[d] > b.high[d] + slack || b.low[d] > a.high[d] + slack) return false;
    return true;
  }

  // Sweep along the axis in which the plane extends most.
  void overlap_rest() {
    const Vec3& n = complex_.planes.normal(plane_);
    int axis = 0;
    for (int d = 1; d < 3; ++d)
      if (std::abs(n[d]) < std::abs(n[axis])) axis = d;
    const auto by_low = [axis](const Loose& a, const Loose& b) {
      return a.low[axis] != b.low[axis] ? a.low[axis] < b.low[axis] : a.ref.cell < b.ref.cell;
    };
    std::sort(loose_below_.begin(), loose_below_.end(), by_low);
    std::sort(loose_above_.begin(), loose_above_.end(), by_low);
    const Real slack = complex_.planes.tolerance();
    std::vector<std::size_t> active;
    std::size_t next = 0;
    for (Loose& b : loose_below_) {
      while (next < loose_above_.size() && loose_above_[next].low[axis] <= b.high[axis] + slack)
        active.push_back(next++);
      std::erase_if(
          active, [&](std::size_t i) { return loose_above_[i].high[axis] < b.low[axis] - slack; });
      for (const std::size_t i : active)
        if (boxes_meet(b, loose_above_[i], slack)) overlap(b, loose_above_[i]);
    }
    for (Loose& b : loose_below_) finish(b);
    for (Loose& a : loose_above_) finish(a);
  }

  void overlap(Loose& below, Loose& above) {
    Polygon common = clipper_.intersection(below.polygon, above.polygon);
    if (common.empty()) return;
    const Real area = polygon_moments(common).area;
    if (!(area > 0)) return;
    for (Loose* side : {&below, &above}) {
      if (!side->touched) side->rest = {side->polygon};
      side->touched = true;
      std::vector<Polygon> rest;
      for (const Polygon& p : side->rest) {
        if (clipper_.intersection(p, common).empty())
          rest.push_back(p);
        else
          clipper_.subtract(p, common, rest);
      }
      side->rest = std::move(rest);
    }
    add_fragment(below.ref, above.ref, static_cast<Index>(result_.polygons.size()), area);
    result_.polygons.push_back(std::move(common));
  }

  void finish(const Loose& loose) {
    if (!loose.touched) {
      add_free_parts(loose.ref, loose.polygon, true);
      return;
    }
    for (const Polygon& p : loose.rest) add_free_parts(loose.ref, p, false);
  }

  struct Part {
    Polygon polygon;
    Index origin;
  };

  void add_free_parts(const FaceRef& ref, const Polygon& polygon, bool whole_face) {
    std::vector<Part> parts = divide_by_origin(ref, polygon);
    for (Part& part : parts) {
      const Real area = polygon_moments(part.polygon).area;
      const bool whole = whole_face && parts.size() == 1;
      // Where no solid ends, the rules of intent have moved the neighbours of a joint's face aside by
      // up to the tolerance: a whole face stays the joint's, a sliver beside fragments is nothing.
      if (part.origin == none && whole) part.origin = complex_.joint_of_plane[plane_];
      if (!(area > 0) || part.origin == none) continue;
      result_.free_parts.push_back({ref.cell, ref.face, part.origin,
                                    whole ? none : static_cast<Index>(result_.polygons.size()),
                                    area});
      if (!whole) result_.polygons.push_back(std::move(part.polygon));
    }
  }

  void add_fragment(const FaceRef& below, const FaceRef& above, Index polygon, Real area) {
    result_.fragments.push_back({{below.cell, above.cell},
                                 {below.face, above.face},
                                 complex_.joint_of_plane[plane_],
                                 none,
                                 polygon,
                                 area});
  }

  // The faces of solids that a free area lies on: of the solid whose rock the cell is, if the plane bounds it; else of
  // the solids that were taken away there, each where no later one was.
  std::vector<Part> divide_by_origin(const FaceRef& ref, const Polygon& polygon) {
    const HalfSpaceId inside = face(ref).inside;
    const Index own = origin_on(complex_.bodies[complex_.cell_body[ref.cell]], inside);
    if (own != none) return {{polygon, own}};
    std::vector<Part> parts;
    std::vector<Polygon> left{polygon};
    Index first_listed = none;
    for (std::size_t i = complex_.bodies.size(); i-- > 0;) {
      const ConvexBody& body = complex_.bodies[i];
      const Index origin = origin_on(body, inside ^ 1);
      if (origin == none) continue;
      first_listed = origin;
      Polygon bounds;
      std::copy_if(body.inside.begin(), body.inside.end(), std::back_inserter(bounds.edge),
                   [this](HalfSpaceId h) { return plane_of(h) != plane_; });
      std::vector<Polygon> rest;
      for (Polygon& p : left) {
        Polygon common = clipper_.intersection(p, bounds);
        if (common.empty()) {
          rest.push_back(std::move(p));
          continue;
        }
        clipper_.subtract(p, bounds, rest);
        parts.push_back({std::move(common), origin});
      }
      left = std::move(rest);
    }
    for (Polygon& p : left)
      parts.push_back({std::move(p), first_listed});  // rounding may leave a trace
    return parts;
  }

  static Index origin_on(const ConvexBody& body, HalfSpaceId h) {
    const auto it = std::find(body.inside.begin(), body.inside.end(), h);
    return it == body.inside.end()
               ? none
               : body.first_origin + static_cast<Index>(it - body.inside.begin());
  }

  const Complex& complex_;
  const Index plane_;
  PolygonClipper clipper_;
  PlaneResult result_;
  std::vector<Loose> loose_below_, loose_above_;
};

struct FacesByPlane {
  std::vector<std::int64_t> begin;  // [planes + 1]
  std::vector<PlaneFace> faces;     // by plane, then cell
};

FacesByPlane sort_by_plane(const Complex& complex) {
  FacesByPlane result;
  result.begin.assign(static_cast<std::size_t>(complex.planes.size()) + 1, 0);
  for (Index c = 0; c < complex.cells.size(); ++c)
    for (const auto& f : complex.cells[c].faces) ++result.begin[plane_of(f.inside) + 1];
  for (std::size_t p = 1; p < result.begin.size(); ++p) result.begin[p] += result.begin[p - 1];
  result.faces.resize(result.begin.back());
  std::vector<std::int64_t> next(result.begin.begin(), result.begin.end() - 1);
  for (Index c = 0; c < complex.cells.size(); ++c) {
    const CellView cell = complex.cells[c];
    for (std::size_t f = 0; f < cell.faces.size(); ++f)
      result.faces[next[plane_of(cell.faces[f].inside)]++] = {{c, static_cast<Index>(f)}, 0};
  }
  return result;
}

}  // namespace

IntentCount find_adjacency(Complex& complex) {
  const FacesByPlane by_plane = sort_by_plane(complex);
  complex.joint_of_plane.resize(complex.planes.size(), none);
  std::vector<PlaneResult> results(complex.planes.size());
  parallel_for(complex.planes.size(), 1, [&](std::int64_t plane) {
    std::vector<PlaneFace> below, above;  // cells below and above the plane
    for (auto i = by_plane.begin[plane]; i < by_plane.begin[plane + 1]; ++i) {
      PlaneFace f = by_plane.faces[i];
      const CellView cell = complex.cells[f.ref.cell];
      f.hash = edge_set_hash(cell, cell.faces[f.ref.face]);
      (is_above(cell.faces[f.ref.face].inside) ? above : below).push_back(f);
    }
    results[plane] = PlaneMatcher(complex, static_cast<Index>(plane)).run(below, above);
  });

  IntentCount intent;
  for (PlaneResult& r : results) {
    const auto shift = static_cast<Index>(complex.polygons.size());
    for (Fragment& f : r.fragments) {
      if (f.polygon != none) f.polygon += shift;
      complex.fragments.push_back(f);
    }
    for (FreePart& f : r.free_parts) {
      if (f.polygon != none) f.polygon += shift;
      complex.free_parts.push_back(f);
    }
    std::move(r.polygons.begin(), r.polygons.end(), std::back_inserter(complex.polygons));
    intent.add(r.intent);
    r = {};
  }
  return intent;
}

}  // namespace rockfold
