#include "host/bolting/wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "host/bolting/rock_lines.hpp"
#include "host/bolting/swept_layout.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();

template <class Visit>
void for_each_corner(const BlockArrays& blocks, Index face, Visit visit) {
  const Index loop = blocks.loop_begin[face];
  for (Index c = blocks.corner_begin[loop]; c < blocks.corner_begin[loop + 1]; ++c)
    visit(blocks.vertex[blocks.corner_vertex[c]]);
}

Bounds bounds_of(const BlockArrays& blocks, Index face) {
  Bounds box{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  for_each_corner(blocks, face, [&](const Vec3& x) {
    for (int d = 0; d < 3; ++d) {
      box.min[d] = std::min(box.min[d], x[d]);
      box.max[d] = std::max(box.max[d], x[d]);
    }
  });
  return box;
}

/// Axes of a plane face as seen from the opening, `outward` pointing at the viewer: u level to the right, v up the dip.
std::pair<Vec3, Vec3> face_axes(const Vec3& outward) {
  const bool level = std::hypot(outward[0], outward[1]) < 1e-9;
  const Vec3 u = level ? Vec3{1, 0, 0} : normalized(Vec3{-outward[1], outward[0], 0});
  return {u, cross(outward, u)};
}

/// A bolt on the rim of a sheet stands this share of its width inside.
constexpr Real rim = 1e-6;

/// Sheet coordinates closer than this share of the model's size are one.
constexpr Real rounding = 1e-9;

/// Which face a collar is on is looked up this share of the model's size to the right of it and up, so that it is one
/// face even where the collar is on a joint; next to edges of the strip, where that leads off it, to the other sides.
constexpr Real aside = 1e-7;
constexpr std::array<std::array<Real, 2>, 4> to_the_side{
    {{0.731, 0.469}, {-0.731, -0.469}, {0.731, -0.469}, {-0.731, 0.469}}};

/// Away from both ends of a range.
Real inside(Real value, const std::array<Real, 2>& range) {
  const Real margin = rim * (range[1] - range[0]);
  return std::clamp(value, range[0] + margin, range[1] - margin);
}

/// ±x, ±y, ±z as 0 … 5: where a face of a surface looks.
int looks(const Vec3& normal) {
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[axis]) + rounding) axis = d;
  return 2 * axis + (normal[axis] > 0 ? 1 : 0);
}

}  // namespace

Wall::Wall(const BlockArrays& blocks, const Model& model, const WallFaces& faces,
           const Place& place)
    : blocks_(blocks), size_(model_size(blocks)) {
  std::vector<Bounds> boxes;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    if (!blocks.stage.empty() && blocks.stage[b] > 0) continue;
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
      if (const FaceOrigin& origin = blocks.origins[blocks.face_origin[f]];
          !origin.continues && faces.hold(origin)) {
        faces_.push_back(f);
        side_of_face_.push_back(origin.face_of(origin.kind, faces.owner));
        boxes.push_back(bounds_of(blocks, f));
        area_ += blocks.face_area[f];
      }
  }
  if (faces_.empty())
    refuse(place, place.key + ".on",
           "\"" + faces.name +
               "\" is no free face of the cut rock: it must lie in the rock, and not continue");
  tree_ = BoxTree(std::move(boxes));
  const Shape& shape =
      faces.excavation ? model.excavations[faces.owner].shape : model.solids[faces.owner].shape;
  const auto side_faces = faces_named(shape, "side");
  const bool sides = std::all_of(faces.faces.begin(), faces.faces.end(), [&](Index f) {
    return std::find(side_faces.begin(), side_faces.end(), f) != side_faces.end();
  });
  strip_of_face_.assign(faces_.size(), none);
  if (sides && faces.faces.size() > 1 && !swept_layout(shape).segments.empty()) {
    lay_sides(shape, faces.name);
  } else if (std::holds_alternative<MeshShape>(shape) ||
             std::holds_alternative<TerrainShape>(shape) ||
             std::holds_alternative<SphereShape>(shape)) {
    lay_surfaces(faces.name);
  } else {
    lay_planes(shape, faces.excavation ? model.excavations[faces.owner].name
                                       : model.solids[faces.owner].name);
  }
}

void Wall::lay_sides(const Shape& shape, const std::string& name) {
  const SweptLayout layout = swept_layout(shape);
  const std::size_t n = layout.section.size();
  WallPanel panel{name, {-layout.perimeter / 2, layout.perimeter / 2}, {0, 0}, true, {}};
  for (const SweptSegment& segment : layout.segments) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto &a = layout.section[i], &b = layout.section[(i + 1) % n];
      const Vec3 p = a[0] * segment.right + a[1] * segment.up;
      const Vec3 q = b[0] * segment.right + b[1] * segment.up;
      // u grows clockwise seen along the path, whichever way the section's edges run.
      const Vec3 edge = normalized(q - p);
      WallStrip strip;
      strip.u = layout.edge_u[i];
      strip.v = {segment.v0, segment.v0 + segment.length};
      strip.along_v = segment.along;
      strip.origin = segment.start + (layout.counter_clockwise ? q : p);
      strip.along_u = layout.counter_clockwise ? -edge : edge;
      strip.across = normalized(cross(strip.along_u, strip.along_v));
      strip.reach = 1e-3 * layout.perimeter;
      strip.side = static_cast<Index>(i);
      strip.end_point = {segment.start, segment.start + segment.length * segment.along};
      strip.end_normal = {segment.start_plane, segment.end_plane};
      panel.strips.push_back(static_cast<Index>(strips_.size()));
      strips_.push_back(strip);
    }
    panel.v[1] = segment.v0 + segment.length;
  }
  // The strip of a face: of its side, on the segment whose plane is nearest.
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Index side = side_of_face_[k];
    Real best = infinite;
    for (std::size_t s = 0; s < layout.segments.size(); ++s) {
      const auto id = static_cast<Index>(s * n + static_cast<std::size_t>(side));
      Real off = 0;
      for_each_corner(blocks_, faces_[k], [&](const Vec3& x) {
        off = std::max(off, std::abs(dot(strips_[id].across, x - strips_[id].origin)));
      });
      if (off < best) best = off, strip_of_face_[k] = id;
    }
  }
  panels_.push_back(std::move(panel));
}

/// A panel of one strip for faces that look along `normal`; its grid covers them all.
void Wall::add_panel_for(const std::vector<std::size_t>& members, const Vec3& normal, Real reach,
                         std::string name) {
  const auto axes = face_axes(normal);
  const Vec3 u = axes.first, v = axes.second;
  const Real u0 = panels_.empty() ? 0 : panels_.back().u[1] + 1;
  WallStrip strip;
  strip.along_u = u, strip.along_v = v, strip.across = normal;
  std::array<Real, 2> ru{infinite, -infinite}, rv{infinite, -infinite}, rn{infinite, -infinite};
  for (const std::size_t k : members)
    for_each_corner(blocks_, faces_[k], [&](const Vec3& x) {
      const auto widen = [](std::array<Real, 2>& range, Real value) {
        range[0] = std::min(range[0], value), range[1] = std::max(range[1], value);
      };
      widen(ru, dot(u, x)), widen(rv, dot(v, x)), widen(rn, dot(normal, x));
    });
  strip.origin = ru[0] * u + rv[0] * v + (0.5 * (rn[0] + rn[1])) * normal;
  strip.u = {u0, u0 + ru[1] - ru[0]};
  strip.v = {0, rv[1] - rv[0]};
  strip.reach = reach + 0.5 * (rn[1] - rn[0]);
  for (const std::size_t k : members) strip_of_face_[k] = static_cast<Index>(strips_.size());
  panels_.push_back(
      {std::move(name), strip.u, strip.v, false, {static_cast<Index>(strips_.size())}});
  strips_.push_back(strip);
}

/// A panel for each plane and side of it.
void Wall::lay_planes(const Shape& shape, const std::string& owner) {
  std::map<std::tuple<Index, Index, int>, std::vector<std::size_t>> planes;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Index f = faces_[k];
    planes[{side_of_face_[k], blocks_.face_plane[f], blocks_.face_up[f]}].push_back(k);
  }
  const Real reach = 1e-6 * size_;
  const auto names = face_names(shape);
  for (const auto& [key, members] : planes)
    add_panel_for(members, blocks_.face_normal[faces_[members.front()]], reach,
                  owner + "." + names[std::get<0>(key)]);
}

/// A panel for the triangles that look along each of ±x, ±y, ±z, in the mean of their directions.
void Wall::lay_surfaces(const std::string& name) {
  std::map<int, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < faces_.size(); ++k)
    groups[looks(blocks_.face_normal[faces_[k]])].push_back(k);
  const Real reach = 1e-6 * size_;
  for (const auto& [direction, members] : groups) {
    Vec3 mean{};
    for (const std::size_t k : members)
      mean += blocks_.face_area[faces_[k]] * blocks_.face_normal[faces_[k]];
    add_panel_for(members, normalized(mean), reach, name);
  }
}

/// u as it lies on the strip, if it does: round an axis each u belongs to one edge of the section, one that two share to
/// the second.
std::optional<Real> Wall::u_on(const WallPanel& panel, const WallStrip& strip, Real u) const {
  const Real slack = rounding * size_;
  if (!panel.around) {
    if (u < strip.u[0] - slack || u > strip.u[1] + slack) return {};
    return inside(u, strip.u);
  }
  const Real around = panel.u[1] - panel.u[0];
  while (u < strip.u[0] - slack) u += around;
  while (u >= strip.u[0] - slack + around) u -= around;
  if (u >= strip.u[1] - slack) return {};
  return u;
}

/// Whether a point of a strip lies between the strip's ends; a bend belongs to the straight after it.
bool Wall::between_ends(const WallPanel& panel, const WallStrip& strip, const Vec3& point) const {
  if (strip.side == none) return true;
  const Real slack = rounding * size_;
  const bool last = strip.v[1] >= panel.v[1] - slack;
  return dot(strip.end_normal[0], point - strip.end_point[0]) >= -slack &&
         dot(strip.end_normal[1], point - strip.end_point[1]) < (last ? slack : -slack);
}

/// The wall's face of a strip that lies along `across` from a point of it.
std::optional<Wall::Hit> Wall::face_of(const WallPanel& panel, Index s, const Vec3& point) const {
  const WallStrip& strip = strips_[s];
  std::optional<Hit> nearest;
  Real best = infinite;
  const Real step = aside * size_;
  for (const auto& [right, up] : to_the_side) {
    if (nearest) break;
    const Vec3 beside = point + (step * right) * strip.along_u + (step * up) * strip.along_v;
    for (const Index k : tree_.along(beside, strip.across, -strip.reach, strip.reach)) {
      if (strip.side == none ? strip_of_face_[k] != s : side_of_face_[k] != strip.side) continue;
      if (!line_meets_face(blocks_, faces_[k], beside, strip.across)) continue;
      const Real t = way_to_plane(blocks_, faces_[k], point, strip.across);
      if (std::abs(t) > strip.reach) continue;
      // Of several faces of a surface the one nearest to the opening.
      const Real rank = panel.around ? std::abs(t) : -t;
      if (rank < best) best = rank, nearest = Hit{faces_[k], point + t * strip.across};
    }
  }
  return nearest;
}

std::optional<Wall::Hit> Wall::at(const WallPanel& panel, Real u, Real v) const {
  const Real slack = rounding * size_;
  if (v < panel.v[0] - slack || v > panel.v[1] + slack) return {};
  v = inside(v, panel.v);
  std::optional<Hit> beyond;
  for (const Index s : panel.strips) {
    const WallStrip& strip = strips_[s];
    const auto su = u_on(panel, strip, u);
    if (!su) continue;
    const Vec3 point =
        strip.origin + (*su - strip.u[0]) * strip.along_u + (v - strip.v[0]) * strip.along_v;
    if (!between_ends(panel, strip, point)) continue;
    const auto hit = face_of(panel, s, point);
    if (!hit) continue;
    // Outside of a bend both straights reach on; the one that v is on counts.
    if (v >= strip.v[0] - slack && v < strip.v[1] - slack) return hit;
    if (!beyond) beyond = hit;
  }
  return beyond;
}

std::optional<std::size_t> Wall::face_at(const Vec3& point) const {
  const Real near = 1e-3 * size_;
  std::optional<std::size_t> nearest;
  Real best = near;
  // Whatever way the faces look: lines along the axes meet those nearby.
  for (int d = 0; d < 3; ++d) {
    Vec3 along{};
    along[d] = 1;
    for (const Index k : tree_.along(point, along, -near, near)) {
      const auto t = line_meets_face(blocks_, faces_[k], point, blocks_.face_normal[faces_[k]]);
      if (t && std::abs(*t) < best) best = std::abs(*t), nearest = static_cast<std::size_t>(k);
    }
  }
  return nearest;
}

std::array<Real, 2> Wall::on_sheet(std::size_t face_number, const Vec3& point) const {
  const WallStrip& strip = strips_[strip_of_face_[face_number]];
  const Vec3 offset = point - strip.origin;
  return {strip.u[0] + dot(offset, strip.along_u), strip.v[0] + dot(offset, strip.along_v)};
}

}  // namespace rockfold
