#include "host/cut/plane_areas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

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

// Matches the faces of the cells below a plane with those of the cells above it.
class PlaneMatcher {
 public:
  PlaneMatcher(const PlaneTable& planes, const CellStore& cells, Index plane, bool may_be_open)
      : planes_(planes),
        cells_(cells),
        plane_(plane),
        may_be_open_(may_be_open),
        clipper_(planes) {}

  PlaneAreas run(std::vector<PlaneFace>& below, std::vector<PlaneFace>& above) {
    const auto order = [](const PlaneFace& a, const PlaneFace& b) {
      return a.hash != b.hash ? a.hash < b.hash : a.ref.cell < b.ref.cell;
    };
    std::sort(below.begin(), below.end(), order);
    std::sort(above.begin(), above.end(), order);
    match_equal(below, above);
    overlap_rest();
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

  ConvexCell::Face face(const FaceRef& ref) const { return cells_[ref.cell].faces[ref.face]; }

  // Seen from their own cells the loops of one area run against each other.
  bool same_edges(const FaceRef& a, const FaceRef& b) const {
    const ConvexCell::Face f = face(a), g = face(b);
    if (f.count != g.count) return false;
    const auto* x = &cells_[a.cell].corners[f.begin];
    const auto* y = &cells_[b.cell].corners[g.begin];
    std::int32_t j = 0;
    while (j < g.count && y[j].neighbour != x[0].neighbour) ++j;
    if (j == g.count) return false;
    for (std::int32_t k = 1; k < f.count; ++k) {
      j = j == 0 ? g.count - 1 : j - 1;
      if (y[j].neighbour != x[k].neighbour) return false;
    }
    return true;
  }

  void match_equal(const std::vector<PlaneFace>& below, const std::vector<PlaneFace>& above) {
    std::size_t j = 0;
    for (const PlaneFace& b : below) {
      while (j < above.size() && above[j].hash < b.hash) loosen(above[j++].ref, loose_above_);
      if (j < above.size() && above[j].hash == b.hash && same_edges(b.ref, above[j].ref)) {
        result_.shared.push_back(
            {{b.ref.cell, above[j].ref.cell}, {b.ref.face, above[j].ref.face}, {}});
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
    loose.polygon = face_polygon(cells_[ref.cell], face(ref));
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
    const Vec3& n = planes_.normal(plane_);
    int axis = 0;
    for (int d = 1; d < 3; ++d)
      if (std::abs(n[d]) < std::abs(n[axis])) axis = d;
    const auto by_low = [axis](const Loose& a, const Loose& b) {
      return a.low[axis] != b.low[axis] ? a.low[axis] < b.low[axis] : a.ref.cell < b.ref.cell;
    };
    std::sort(loose_below_.begin(), loose_below_.end(), by_low);
    std::sort(loose_above_.begin(), loose_above_.end(), by_low);
    const Real slack = planes_.width_tolerance();
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
    if (!may_be_open_) return;
    for (Loose& b : loose_below_) finish(b);
    for (Loose& a : loose_above_) finish(a);
  }

  void overlap(Loose& below, Loose& above) {
    Polygon common = clipper_.intersection(below.polygon, above.polygon.edge);
    if (common.empty()) return;
    if (may_be_open_) {
      cover(below, common);
      cover(above, common);
    }
    result_.shared.push_back(
        {{below.ref.cell, above.ref.cell}, {below.ref.face, above.ref.face}, std::move(common)});
  }

  void cover(Loose& loose, const Polygon& common) {
    if (!loose.touched) loose.rest.push_back(loose.polygon);
    loose.touched = true;
    std::vector<Polygon> rest;
    for (const Polygon& p : loose.rest) clipper_.subtract(p, common.edge, rest);
    loose.rest = std::move(rest);
  }

  void finish(Loose& loose) {
    if (!loose.touched) result_.open.push_back({loose.ref.cell, loose.ref.face, {}});
    for (Polygon& p : loose.rest)
      result_.open.push_back({loose.ref.cell, loose.ref.face, std::move(p)});
  }

  const PlaneTable& planes_;
  const CellStore& cells_;
  const Index plane_;
  const bool may_be_open_;
  PolygonClipper clipper_;
  PlaneAreas result_;
  std::vector<Loose> loose_below_, loose_above_;
};

struct FacesByPlane {
  std::vector<std::int64_t> begin;  // [planes + 1]
  std::vector<PlaneFace> faces;     // by plane, then cell
};

FacesByPlane sort_by_plane(const PlaneTable& planes, const CellStore& cells) {
  const auto n = static_cast<std::int64_t>(cells.size()), plane_count = std::int64_t{planes.size()};
  const std::int64_t total = cells.face_begin(cells.size());
  // Each part of the cells counts for itself, where that takes little memory beside the faces.
  const std::int64_t parts = std::clamp<std::int64_t>(total / (4 * plane_count + 1000), 1, 64);
  const auto first = [&](std::int64_t part) { return static_cast<Index>(part * n / parts); };
  std::vector<std::vector<std::int64_t>> next(parts);
  parallel_for(parts, 1, [&](std::int64_t part) {
    next[part].assign(plane_count, 0);
    for (Index c = first(part); c < first(part + 1); ++c)
      for (const auto& f : cells[c].faces) ++next[part][plane_of(f.inside)];
  });
  FacesByPlane result;
  result.begin.assign(plane_count + 1, 0);
  for (std::int64_t p = 0; p < plane_count; ++p) {
    std::int64_t at = result.begin[p];
    for (auto& counts : next) at += std::exchange(counts[p], at);
    result.begin[p + 1] = at;
  }
  result.faces.resize(total);
  parallel_for(parts, 1, [&](std::int64_t part) {
    for (Index c = first(part); c < first(part + 1); ++c) {
      const CellView cell = cells[c];
      for (std::size_t f = 0; f < cell.faces.size(); ++f)
        result.faces[next[part][plane_of(cell.faces[f].inside)]++] = {
            {c, static_cast<Index>(f)}, edge_set_hash(cell, cell.faces[f])};
    }
  });
  return result;
}

}  // namespace

void for_each_plane(const PlaneTable& planes, const CellStore& cells,
                    const std::function<bool(Index)>& may_be_open,
                    const std::function<void(Index, PlaneAreas&)>& use) {
  const FacesByPlane by_plane = sort_by_plane(planes, cells);
  const auto match = [&](std::int64_t plane) {
    if (by_plane.begin[plane] == by_plane.begin[plane + 1]) return;
    std::vector<PlaneFace> below, above;  // cells below and above the plane
    for (auto i = by_plane.begin[plane]; i < by_plane.begin[plane + 1]; ++i) {
      const PlaneFace& f = by_plane.faces[i];
      (is_above(cells[f.ref.cell].faces[f.ref.face].inside) ? above : below).push_back(f);
    }
    const auto p = static_cast<Index>(plane);
    PlaneAreas areas = PlaneMatcher(planes, cells, p, may_be_open(p)).run(below, above);
    use(p, areas);
  };
  parallel_for(planes.size(), 1, match, by_plane.faces.size() > 2000);
}

}  // namespace rockfold
