// Tunnels: a section along a path, mitred at its bends.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/refuse.hpp"
#include "host/shapes/convex_pieces_exact.hpp"
#include "host/shapes/exact_vector_exact.hpp"
#include "host/shapes/families_exact.hpp"
#include "host/shapes/section_frame.hpp"
#include "host/shapes/swept_sides_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real straight = 1e-10;  // decision 5, rule 2
// Relative to the section's reach: ten times the tolerance by which the cutter takes planes for one.
constexpr Real matching = 1e-9;
constexpr Real turns_back = 1e-6;  // twice the sine of half the angle between the legs of a bend

// A point of the path that stays, and the plane across the tunnel there.
struct Station {
  std::size_t number = 0;  // counted from 1, as the user wrote them
  Vec3 point{};
  Vec3 normal{};             // of the plane, along the path
  Index face_before = none;  // the plane as the end of the segment before it
  Index face_after = none;   // and as the start of the one after it
};

struct Segment {
  Vec3 direction{};  // unit
  Real length = 0;
  SectionFrame frame;
  std::vector<Vec3> corner;  // of the section, about the path
};

std::vector<Station> stations_of(const std::vector<Vec3>& path, const Place& place) {
  std::vector<Station> stations;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!stations.empty() && path[i] == stations.back().point) continue;
    if (!stations.empty() && i + 1 < path.size()) {
      const Vec3 in = path[i] - stations.back().point, out = path[i + 1] - path[i];
      if (norm(cross(in, out)) <= straight * norm(in) * norm(out) && dot(in, out) >= 0) continue;
    }
    stations.push_back({i + 1, path[i], {}, none, none});
  }
  if (stations.size() < 2) refuse(place, place.key, "the tunnel's path has no length");
  return stations;
}

std::vector<Segment> segments_of(const std::vector<Station>& stations, const TunnelShape& tunnel) {
  std::vector<Segment> segments;
  for (std::size_t s = 0; s + 1 < stations.size(); ++s) {
    Segment& segment = segments.emplace_back();
    const Vec3 leg = stations[s + 1].point - stations[s].point;
    segment.length = norm(leg);
    segment.direction = normalized(leg);
    segment.frame = section_frame(leg);
    for (const auto& [x, y] : tunnel.section)
      segment.corner.push_back(x * segment.frame.right + y * segment.frame.up);
  }
  return segments;
}

// How far along the path's direction the line through a corner meets the plane across, from the path point.
Real advance(const Segment& segment, std::size_t i, const Vec3& normal) {
  return -dot(normal, segment.corner[i]) / dot(normal, segment.direction);
}

bool sections_meet(const Segment& before, const Segment& after, const Vec3& normal) {
  Real off = 0, reach = 0;
  for (std::size_t i = 0; i < before.corner.size(); ++i) {
    const Vec3 a = before.corner[i] + advance(before, i, normal) * before.direction;
    const Vec3 b = after.corner[i] + advance(after, i, normal) * after.direction;
    off = std::max(off, norm(a - b));
    reach = std::max({reach, norm(a), norm(b)});
  }
  return off <= matching * reach;
}

void lay_planes(const std::vector<Segment>& segments, Index sides, std::vector<Station>& stations,
                const Place& place) {
  stations.front().normal = segments.front().direction;
  stations.front().face_after = sides;
  stations.back().normal = segments.back().direction;
  stations.back().face_before = sides + 1;
  for (std::size_t s = 0; s + 1 < segments.size(); ++s) {
    Station& bend = stations[s + 1];
    bend.normal = segments[s].direction + segments[s + 1].direction;
    if (norm(bend.normal) < turns_back)
      refuse(place, place.key,
             fmt::format("the path turns back on itself at its point {}; leave the way back out",
                         bend.number));
    if (sections_meet(segments[s], segments[s + 1], bend.normal)) continue;
    bend.face_before = sides + 1;
    bend.face_after = sides;
  }
}

// The planes at both ends of a segment must not meet inside it.
void check_length(const Segment& segment, const Station& start, const Station& end,
                  const Place& place) {
  Real taken = 0;
  const Station* sharper = &start;
  for (std::size_t i = 0; i < segment.corner.size(); ++i) {
    const Real at_start = advance(segment, i, start.normal);
    const Real at_end = -advance(segment, i, end.normal);
    if (at_start + at_end <= taken) continue;
    taken = at_start + at_end;
    sharper = at_start >= (1 - matching) * at_end ? &start : &end;
  }
  if (taken < (1 - matching) * segment.length) return;
  refuse(place, place.key,
         fmt::format("the bend at point {} of the path is too sharp for the section: from point {} "
                     "to point {} the path is {:.6g} m long, and the mitred ends there take {:.6g} "
                     "m of it on the inner side; move the points further apart, or make the "
                     "section narrower or the bend gentler",
                     sharper->number, start.number, end.number, segment.length, taken));
}

ExactVec3 exact_corner(const TunnelShape& tunnel, const SectionFrame& frame, Index i) {
  return exact(tunnel.section[i][0]) * exact(frame.right) +
         exact(tunnel.section[i][1]) * exact(frame.up);
}

// The plane across at a station; at the path's ends exactly perpendicular to it, at a bend the same for both segments.
ExactPlane plane_across(const Station& station, bool at_path_end, const ExactVec3& along) {
  const ExactVec3 n = at_path_end ? along : exact(station.normal);
  return {n, dot(n, exact(station.point))};
}

void add_corners(const Segment& segment, const Station& start, const Station& end,
                 std::vector<Vec3>& corners) {
  for (std::size_t i = 0; i < segment.corner.size(); ++i)
    for (const Station* s : {&start, &end})
      corners.push_back(s->point + segment.corner[i] +
                        advance(segment, i, s->normal) * segment.direction);
}

}  // namespace

ShapeGeometry tunnel_geometry(const TunnelShape& tunnel, const Place& place) {
  ExactPolygon section;
  for (const auto& [x, y] : tunnel.section) section.push_back({exact(x), exact(y)});
  const std::vector<ConvexPiece> pieces = convex_pieces(section);
  if (pieces.empty())
    refuse(place, place.key,
           "the section's edges cross or touch each other; a simple polygon, once around an area, "
           "would be right");
  std::vector<Station> stations = stations_of(tunnel.path, place);
  const std::vector<Segment> segments = segments_of(stations, tunnel);
  const auto sides = static_cast<Index>(tunnel.section.size());
  lay_planes(segments, sides, stations, place);

  ShapeGeometry geometry;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const Station &start = stations[s], &end = stations[s + 1];
    check_length(segments[s], start, end, place);
    add_corners(segments[s], start, end, geometry.corners);
    const ExactVec3 origin = exact(start.point), along = exact(end.point) - origin;
    const ExactPlane first = plane_across(start, s == 0, along);
    const ExactPlane last = plane_across(end, s + 1 == segments.size(), along);
    SweptPolygon swept{{}, std::vector<ExactVec3>(sides, along)};
    for (Index i = 0; i < sides; ++i)
      swept.corner.push_back(origin + exact_corner(tunnel, segments[s].frame, i));
    for (const ConvexPiece& piece : pieces) {
      ConvexPart& part = geometry.parts.emplace_back(swept_sides(swept, piece));
      part.faces.push_back({first, true, start.face_after});
      part.faces.push_back({last, false, end.face_before});
    }
  }
  return geometry;
}

}  // namespace rockfold
