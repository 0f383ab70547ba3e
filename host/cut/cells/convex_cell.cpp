#include "host/cut/cells/convex_cell.hpp"

#include <algorithm>
#include <cmath>

#include "host/cut/cells/polygon.hpp"
#include "host/exact/plane_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

BoundingBall bounding_ball(const CellView& cell) {
  Vec3 low = cell.vertices.front().x, high = low;
  for (const Vertex& v : cell.vertices)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], v.x[d]);
      high[d] = std::max(high[d], v.x[d]);
    }
  BoundingBall ball;
  ball.centre = 0.5 * (low + high);
  Real squared = 0;
  for (const Vertex& v : cell.vertices) {
    const Vec3 r = v.x - ball.centre;
    squared = std::max(squared, dot(r, r));
  }
  ball.radius = std::sqrt(squared);
  return ball;
}

CellSide CellSplitter::classify(const CellView& cell, Index plane) {
  side_.resize(cell.vertices.size());
  has_cut_vertices_ = false;
  bool below = false, above = false;
  for (std::size_t v = 0; v < cell.vertices.size(); ++v) {
    side_[v] = static_cast<std::int8_t>(planes_.side(cell.vertices[v], plane));
    below = below || side_[v] < 0;
    above = above || side_[v] > 0;
  }
  if (!below) return CellSide::above;
  return above ? CellSide::split : CellSide::below;
}

void CellSplitter::split(const CellView& cell, Index plane, ConvexCell* below, ConvexCell* above) {
  make_cut_vertices(cell, plane);
  if (below) write_part(cell, half_space(plane, false), *below);
  if (above) write_part(cell, half_space(plane, true), *above);
}

// The cap's loop runs against the faces' sense: from the end of a face's cut edge to its start.
template <class Visit>
void CellSplitter::for_each_in_cap(const Visit& visit) const {
  const std::int32_t first = cap_edges_.front().to;
  std::int32_t at = first;
  do {
    const auto edge = std::find_if(cap_edges_.begin(), cap_edges_.end(),
                                   [at](const CapEdge& e) { return e.to == at; });
    visit(*edge);
    at = edge->from;
  } while (at != first);
}

// The cap of the part below, of which only the edges in the plane are looked for: what write_face() finds of them.
void CellSplitter::section(const CellView& cell, Index plane, Polygon& section) {
  make_cut_vertices(cell, plane);
  cap_edges_.clear();
  for (const auto& face : cell.faces) {
    std::int32_t leaves = -1, enters = -1;
    bool any_below = false;
    for (std::int32_t k = 0; k < face.count; ++k) {
      const std::int32_t u = cell.corners[face.begin + k].vertex;
      const std::int32_t v = cell.corners[face.begin + (k + 1 == face.count ? 0 : k + 1)].vertex;
      any_below = any_below || side_[u] < 0;
      if (side_[u] < 0 && side_[v] > 0) leaves = find_cut_vertex(u, v);
      if (side_[u] > 0 && side_[v] < 0) enters = find_cut_vertex(u, v);
      if (side_[u] == 0) (side_[v] >= 0 ? leaves : enters) = u;
    }
    if (any_below && leaves >= 0) cap_edges_.push_back({leaves, enters, face.inside});
  }
  section.plane = plane;
  section.corner.clear();
  section.edge.clear();
  const auto own = static_cast<std::int32_t>(cell.vertices.size());
  for_each_in_cap([&](const CapEdge& e) {
    section.corner.push_back(e.to < own ? cell.vertices[e.to] : cut_vertices_[e.to - own]);
    section.corner.back().note(plane);
    section.edge.push_back(e.face);
  });
}

// Each crossed edge is met twice, once from each of its faces; the first meeting makes the vertex.
void CellSplitter::make_cut_vertices(const CellView& cell, Index plane) {
  if (has_cut_vertices_) return;
  has_cut_vertices_ = true;
  cut_edges_.clear();
  cut_vertices_.clear();
  for (const auto& face : cell.faces)
    for (std::int32_t k = 0; k < face.count; ++k) {
      const auto& corner = cell.corners[face.begin + k];
      const std::int32_t u = corner.vertex;
      const std::int32_t v = cell.corners[face.begin + (k + 1 == face.count ? 0 : k + 1)].vertex;
      if (side_[u] * side_[v] >= 0 || u > v) continue;
      const auto id = static_cast<std::int32_t>(cell.vertices.size() + cut_vertices_.size());
      cut_edges_.push_back({u, v, id});
      cut_vertices_.push_back(
          planes_.vertex(plane_of(face.inside), plane_of(corner.neighbour), plane));
    }
}

std::int32_t CellSplitter::find_cut_vertex(std::int32_t u, std::int32_t v) const {
  if (u > v) std::swap(u, v);
  for (const CutEdge& e : cut_edges_)
    if (e.low == u && e.high == v) return e.vertex;
  return -1;  // never: exact sides agree on both faces of an edge
}

std::int32_t CellSplitter::part_vertex(const CellView& cell, std::int32_t vertex,
                                       HalfSpaceId inside, ConvexCell& part) {
  std::int32_t& id = renumbered_[vertex];
  if (id < 0) {
    id = static_cast<std::int32_t>(part.vertices.size());
    const auto own = static_cast<std::int32_t>(cell.vertices.size());
    part.vertices.push_back(vertex < own ? cell.vertices[vertex] : cut_vertices_[vertex - own]);
    if (vertex < own && side_[vertex] == 0) part.vertices.back().note(plane_of(inside));
  }
  return id;
}

void CellSplitter::write_part(const CellView& cell, HalfSpaceId inside, ConvexCell& part) {
  part.clear();
  cap_edges_.clear();
  renumbered_.assign(cell.vertices.size() + cut_vertices_.size(), -1);
  const int wanted = is_above(inside) ? 1 : -1;
  for (const auto& face : cell.faces) {
    bool kept = false;
    for (std::int32_t k = 0; k < face.count && !kept; ++k)
      kept = side_[cell.corners[face.begin + k].vertex] == wanted;
    if (kept) write_face(cell, face, inside, part);
  }
  write_cap(inside, part);
}

// Walks a face's loop and keeps what is inside; where the walk leaves the half-space it follows the cut.
void CellSplitter::write_face(const CellView& cell, const ConvexCell::Face& face,
                              HalfSpaceId inside, ConvexCell& part) {
  const int wanted = is_above(inside) ? 1 : -1;
  const auto begin = static_cast<std::int32_t>(part.corners.size());
  std::int32_t leaves = -1;  // the corner of `part` whose edge runs along the cut
  for (std::int32_t k = 0; k < face.count; ++k) {
    const auto& corner = cell.corners[face.begin + k];
    const std::int32_t u = corner.vertex;
    const std::int32_t v = cell.corners[face.begin + (k + 1 == face.count ? 0 : k + 1)].vertex;
    const int su = side_[u] * wanted, sv = side_[v] * wanted;
    if (su > 0) {
      part.corners.push_back({part_vertex(cell, u, inside, part), corner.neighbour});
      if (sv < 0) {
        leaves = static_cast<std::int32_t>(part.corners.size());
        part.corners.push_back({part_vertex(cell, find_cut_vertex(u, v), inside, part), inside});
      }
    } else if (su == 0) {
      const bool along_cut = sv <= 0;
      if (along_cut) leaves = static_cast<std::int32_t>(part.corners.size());
      part.corners.push_back(
          {part_vertex(cell, u, inside, part), along_cut ? inside : corner.neighbour});
    } else if (sv > 0) {
      part.corners.push_back(
          {part_vertex(cell, find_cut_vertex(u, v), inside, part), corner.neighbour});
    }
  }
  const auto end = static_cast<std::int32_t>(part.corners.size());
  part.faces.push_back({face.inside, begin, end - begin});
  if (leaves >= 0) {
    // A face that only touches the plane at one vertex leaves and enters there: no edge of the cap.
    const std::int32_t next = leaves + 1 == end ? begin : leaves + 1;
    cap_edges_.push_back({part.corners[leaves].vertex, part.corners[next].vertex, face.inside});
  }
}

void CellSplitter::write_cap(HalfSpaceId inside, ConvexCell& part) {
  const auto begin = static_cast<std::int32_t>(part.corners.size());
  for_each_in_cap([&](const CapEdge& e) { part.corners.push_back({e.to, e.face}); });
  part.faces.push_back({inside, begin, static_cast<std::int32_t>(part.corners.size()) - begin});
}

namespace {

// The fan of each face from its first corner, outward.
std::vector<std::array<Index, 3>> boundary_triangles(const CellView& cell) {
  std::vector<std::array<Index, 3>> triangles;
  for (const auto& f : cell.faces)
    for (std::int32_t k = 1; k + 1 < f.count; ++k)
      triangles.push_back({cell.corners[f.begin].vertex, cell.corners[f.begin + k].vertex,
                           cell.corners[f.begin + k + 1].vertex});
  return triangles;
}

}  // namespace

RoundedMeasure measure_in_doubles(const CellView& cell) {
  const Vec3 o = cell.vertices.front().x;
  Real volume6 = 0, area2 = 0, error = 0;
  Vec3 first24{};
  for (const Vertex& v : cell.vertices) error = std::max(error, Real{v.error});
  for (const auto& f : cell.faces)
    for (std::int32_t k = 1; k + 1 < f.count; ++k) {
      const Vec3 a = cell.vertices[cell.corners[f.begin].vertex].x - o;
      const Vec3 b = cell.vertices[cell.corners[f.begin + k].vertex].x - o;
      const Vec3 c = cell.vertices[cell.corners[f.begin + k + 1].vertex].x - o;
      const Real v = dot(a, cross(b, c));
      volume6 += v;
      first24 += v * (a + b + c);
      area2 += norm(cross(b - a, c - a));
    }
  volume6 = std::max<Real>(volume6, 0);
  // Vertices off by `error` change the volume by at most the area times it; the bound is some 30 times what happens.
  const bool loses_digits = !(error * area2 / 2 < 1e-9 * volume6 / 6);
  return {{volume6 / 6, (1.0 / 24) * first24 + (volume6 / 6) * o}, area2 / 2, loses_digits};
}

CellMoments cell_moments(const CellView& cell, const PlaneTable& planes) {
  const RoundedMeasure rounded = measure_in_doubles(cell);
  if (!rounded.loses_digits) return rounded.moments;
  const auto exact = planes.exact_moments(cell.vertices, boundary_triangles(cell));
  return {exact.volume, exact.first};
}

ConvexCell make_box(PlaneTable& planes, const Vec3& min, const Vec3& max) {
  Index id[6];
  for (int d = 0; d < 3; ++d)
    for (int s = 0; s < 2; ++s) {
      Vec3 n{};
      n[d] = 1;
      const Vec3& p = s == 0 ? min : max;
      id[2 * d + s] = planes.add({exact(n), exact(p[d]) + exact(planes.centre()[d])});
    }
  ConvexCell box;
  for (int v = 0; v < 8; ++v)
    box.vertices.push_back(planes.vertex(id[v & 1], id[2 + (v >> 1 & 1)], id[4 + (v >> 2 & 1)]));
  // Corners c = x + 2y + 4z, counter-clockwise from outside; across = the face over the edge to the next corner.
  constexpr int loop[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  constexpr int across[6][4] = {{2, 5, 3, 4}, {4, 3, 5, 2}, {4, 1, 5, 0},
                                {0, 5, 1, 4}, {0, 3, 1, 2}, {2, 1, 3, 0}};
  const auto inside = [&](int f) { return half_space(id[f], f % 2 == 0); };
  for (int f = 0; f < 6; ++f) {
    box.faces.push_back({inside(f), 4 * f, 4});
    for (int k = 0; k < 4; ++k) box.corners.push_back({loop[f][k], inside(across[f][k])});
  }
  return box;
}

ConvexCell clip(const PlaneTable& planes, const CellView& view,
                const std::vector<HalfSpaceId>& inside) {
  ConvexCell cell, part;
  cell.vertices.assign(view.vertices.begin(), view.vertices.end());
  cell.faces.assign(view.faces.begin(), view.faces.end());
  cell.corners.assign(view.corners.begin(), view.corners.end());
  CellSplitter splitter(planes);
  for (const HalfSpaceId h : inside) {
    const CellSide place = splitter.classify(cell, plane_of(h));
    if (place == CellSide::split) {
      splitter.split(cell, plane_of(h), is_above(h) ? nullptr : &part,
                     is_above(h) ? &part : nullptr);
      std::swap(cell, part);
    } else if ((place == CellSide::above) != is_above(h)) {
      return {};
    }
  }
  return cell;
}

ConvexCell clip_cube(PlaneTable& planes, Real reach, const std::vector<HalfSpaceId>& inside) {
  const ConvexCell cube = make_box(planes, {-reach, -reach, -reach}, {reach, reach, reach});
  return clip(planes, cube, inside);
}

}  // namespace rockfold
