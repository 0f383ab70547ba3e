#include "tests/cut/oracles/nef_oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/convex_hull_3.h>

#include "src/base/vector.hpp"

namespace rockfold::test {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Plane = Kernel::Plane_3;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Point exact_point(const Vec3& p) {
  return {p[0], p[1], p[2]};
}
Vector exact_vector(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
// Of a lazy number itself to_double promises five digits.
Real rounded(const Number& x) {
  return CGAL::to_double(CGAL::exact(x));
}
Vec3 rounded(const Vector& v) {
  return {rounded(v.x()), rounded(v.y()), rounded(v.z())};
}

// ---- solids and joints as Nef polyhedra

Nef hull(const std::vector<Point>& points) {
  Polyhedron p;
  CGAL::convex_hull_3(points.begin(), points.end(), p);
  return Nef(p);
}

Nef solid(const BoxShape& b) {
  std::vector<Point> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? b.max[0] : b.min[0], i & 2 ? b.max[1] : b.min[1],
                         i & 4 ? b.max[2] : b.min[2]);
  return hull(corners);
}

Plane given_plane(const GivenPlane& p) {
  return {exact_point(p.point), exact_vector(std::get<Vec3>(p.orientation))};
}

Nef solid(const HalfspacesShape& s) {
  std::vector<Plane> inside;  // positive sides
  for (const HalfSpace& h : s.planes)
    inside.push_back(h.keep_above ? given_plane(h.plane) : given_plane(h.plane).opposite());
  std::vector<Point> corners;
  for (std::size_t i = 0; i < inside.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const auto met = CGAL::intersection(inside[i], inside[j], inside[k]);
        const Point* p = met ? boost::get<Point>(&*met) : nullptr;
        if (p && std::all_of(inside.begin(), inside.end(),
                             [&](const Plane& h) { return !h.has_on_negative_side(*p); }))
          corners.push_back(*p);
      }
  return hull(corners);
}

class PrismBuilder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  PrismBuilder(std::vector<Point> base, const Vector& extrude) : base_(std::move(base)) {
    Vector normal = CGAL::NULL_VECTOR;
    for (std::size_t i = 1; i + 1 < base_.size(); ++i)
      normal = normal + CGAL::cross_product(base_[i] - base_[0], base_[i + 1] - base_[0]);
    // The base is seen from outside, against the direction of extrusion, clockwise in the order of its corners.
    if (normal * extrude < 0) std::reverse(base_.begin(), base_.end());
    extrude_ = extrude;
  }
  void operator()(Polyhedron::HalfedgeDS& hds) override {
    const std::size_t n = base_.size();
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(hds, true);
    builder.begin_surface(2 * n, n + 2);
    for (const Point& p : base_) builder.add_vertex(p);
    for (const Point& p : base_) builder.add_vertex(p + extrude_);
    std::vector<std::size_t> low(n), high(n);
    std::iota(high.begin(), high.end(), n);
    std::iota(low.rbegin(), low.rend(), 0);
    builder.add_facet(low.begin(), low.end());
    builder.add_facet(high.begin(), high.end());
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n;
      const std::array<std::size_t, 4> side{i, next, next + n, i + n};
      builder.add_facet(side.begin(), side.end());
    }
    builder.end_surface();
  }

 private:
  std::vector<Point> base_;
  Vector extrude_;
};

Nef solid(const PrismShape& s) {
  std::vector<Point> base;
  for (const Vec3& p : s.base) base.push_back(exact_point(p));
  PrismBuilder build(std::move(base), exact_vector(s.extrude));
  Polyhedron p;
  p.delegate(build);
  return Nef(p);
}

template <class Other>
Nef solid(const Other&) {
  throw std::logic_error("the oracle knows boxes, half-spaces and prisms");
}

// A through-going joint: a square on its plane about the point nearest to `centre`, as large as asked for.
std::vector<Point> large_square(const Plane& plane, const Point& centre, Real size) {
  const Point o = plane.projection(centre);
  const auto reach = [&](const Vector& v) {
    return (size / std::sqrt(CGAL::to_double(v.squared_length()))) * v;
  };
  const Vector u = reach(plane.base1()), v = reach(plane.base2());
  return {o + u, o + v, o - u, o - v};
}

Nef joint_facet(const Joint& joint, const Point& centre, Real size) {
  const Plane plane = given_plane(joint.plane);
  std::vector<Point> corners;
  for (const Vec3& p : joint.polygon) corners.push_back(plane.projection(exact_point(p)));
  if (corners.empty()) corners = large_square(plane, centre, size);
  return Nef(corners.begin(), corners.end());
}

// ---- the surface of one volume

class Parts {
 public:
  explicit Parts(std::size_t n) : up_(n) { std::iota(up_.begin(), up_.end(), 0); }
  int find(int i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  void join(int a, int b) { up_[find(a)] = find(b); }
  Index count() {
    Index n = 0;
    for (std::size_t i = 0; i < up_.size(); ++i)
      n += find(static_cast<int>(i)) == static_cast<int>(i);
    return n;
  }

 private:
  std::vector<int> up_;
};

// Facets of the SNC that bound the volume from other volumes, with their loops.
struct Facet {
  Vec3 normal;  // out of the volume
  int group;    // plane, side, and whether it is a joint
};
struct Corner {
  int facet, vertex, next;  // next corner of the loop
};

class VolumeSurface {
 public:
  void add(Nef::Halffacet_const_handle f) {
    const Plane plane = f->plane();
    const int facet = static_cast<int>(facets_.size());
    const bool joint = f->twin()->incident_volume()->mark();
    facets_.push_back({{}, group(plane, joint)});
    ++euler_;  // 2 − loops, the first of which follows
    Vector vector_area = CGAL::NULL_VECTOR;
    bool first_loop = true;
    for (auto cycle = f->facet_cycles_begin(); cycle != f->facet_cycles_end(); ++cycle) {
      if (!cycle.is_shalfedge()) continue;  // a point where another joint touches
      if (!first_loop) --euler_;
      first_loop = false;
      const std::vector<Point> loop = add_loop(cycle, facet);
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const Vector a = loop[i] - loop[0], b = loop[i + 1] - loop[0];
        const Vector twice = CGAL::cross_product(a, b);
        vector_area = vector_area + twice;
        const Vector o = loop[0] - CGAL::ORIGIN;
        const Number v = o * twice;
        volume6_ += v;
        first24_ = first24_ + v * (o + o + o + a + b);
      }
    }
    const Vec3 area = rounded(vector_area);
    facets_.back().normal = normalized(area);
    if (joint) joint_area_ += norm(area) / 2;
  }

  NefBlock count() {
    // The sense of the SNC's loops is one for all: that of positive volume is outward.
    if (volume6_ < 0) reverse();
    NefBlock block;
    block.volume = rounded(volume6_) / 6;
    block.centroid = rounded(first24_ / (4 * volume6_));
    block.joint_area = joint_area_;
    pair_edges();
    Parts vertices(corners_.size()), shells(facets_.size()), faces(facets_.size());
    for (const Pair& p : pairs_) {
      vertices.join(p.from[0], corners_[p.from[1]].next);
      vertices.join(p.from[1], corners_[p.from[0]].next);
      shells.join(corners_[p.from[0]].facet, corners_[p.from[1]].facet);
      if (p.inner) faces.join(corners_[p.from[0]].facet, corners_[p.from[1]].facet);
    }
    block.shells = shells.count();
    block.counts.faces = faces.count();
    const Index euler = vertices.count() - static_cast<Index>(pairs_.size()) + euler_;
    block.genus = block.shells - euler / 2;
    std::map<int, std::vector<Vec3>> directions;  // of the edges that bound faces, at each vertex
    for (const Pair& p : pairs_) {
      if (p.inner) continue;
      ++block.counts.edges;
      const int from = p.from[0], to = corners_[from].next;
      const Vec3 d = normalized(position(to) - position(from));
      directions[vertices.find(from)].push_back(d);
      directions[vertices.find(to)].push_back(-d);
    }
    for (const auto& [vertex, d] : directions) {
      if (d.size() == 2 && norm(d[0] + d[1]) < 1e-9)
        --block.counts.edges;  // the middle of a straight edge
      else
        ++block.counts.vertices;
    }
    return block;
  }

 private:
  struct Pair {
    std::array<int, 2> from;  // the corners from which the two run, in opposite senses
    bool inner;
  };
  struct Use {
    int from;
    Real angle;
    bool rock_follows;
  };

  int group(const Plane& plane, bool joint) {
    // Parallel planes differ in d/|n|; a normal of scale 1 in its largest coordinate makes equal planes equal.
    Number scale = 0;
    for (const Number& c : {plane.a(), plane.b(), plane.c()})
      if (CGAL::abs(c) > scale) scale = CGAL::abs(c);
    const std::array<Number, 4> key{plane.a() / scale, plane.b() / scale, plane.c() / scale,
                                    plane.d() / scale};
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].first == key && groups_[g].second == joint) return static_cast<int>(g);
    groups_.emplace_back(key, joint);
    return static_cast<int>(groups_.size()) - 1;
  }

  template <class Cycle>
  std::vector<Point> add_loop(const Cycle& cycle, int facet) {
    const auto begin = static_cast<int>(corners_.size());
    std::vector<Point> loop;
    Nef::SHalfedge_around_facet_const_circulator at{Nef::SHalfedge_const_handle(cycle)};
    const auto end = at;
    CGAL_For_all(at, end) {
      const Nef::Vertex_const_handle v = at->source()->source();
      const auto [entry, fresh] = number_.emplace(&*v, static_cast<int>(points_.size()));
      if (fresh) points_.push_back(rounded(v->point() - CGAL::ORIGIN));
      corners_.push_back({facet, entry->second, static_cast<int>(corners_.size()) + 1});
      loop.push_back(v->point());
    }
    corners_.back().next = begin;
    return loop;
  }

  void reverse() {
    volume6_ = -volume6_;
    first24_ = -first24_;
    for (Facet& f : facets_) f.normal = -f.normal;
    std::vector<Corner> reversed = corners_;
    for (std::size_t c = 0; c < corners_.size(); ++c)
      reversed[corners_[c].next].next = static_cast<int>(c);
    corners_ = std::move(reversed);
  }

  const Vec3& position(int corner) const { return points_[corners_[corner].vertex]; }

  // Edges of one group that run against each other are inside a face. Those that are left meet where they enclose rock.
  void pair_edges() {
    std::map<std::pair<int, int>, std::vector<int>> uses;
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      const int a = corners_[c].vertex, b = corners_[corners_[c].next].vertex;
      uses[std::minmax(a, b)].push_back(static_cast<int>(c));
    }
    for (auto& [edge, list] : uses) {
      for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t j = i + 1; j < list.size(); ++j) {
          if (!across(list[i], list[j])) continue;
          pairs_.push_back({{list[i], list[j]}, true});
          list.erase(list.begin() + static_cast<std::ptrdiff_t>(j));
          list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
          --i;
          break;
        }
      pair_outer(edge.first, edge.second, list);
    }
  }
  bool across(int a, int b) const {
    return facets_[corners_[a].facet].group == facets_[corners_[b].facet].group &&
           corners_[a].vertex != corners_[b].vertex;
  }

  void pair_outer(int a, int b, const std::vector<int>& list) {
    if (list.empty()) return;
    const Vec3 axis = normalized(points_[b] - points_[a]);
    std::vector<Use> round;
    Vec3 zero{};
    for (const int c : list) {
      const Vec3& n = facets_[corners_[c].facet].normal;
      const Vec3 into = cross(n, corners_[c].vertex == a ? axis : -axis);
      if (round.empty()) zero = into;
      Real angle = std::atan2(dot(axis, cross(zero, into)), dot(zero, into));
      if (angle < 0) angle += 2 * 3.14159265358979323846;
      round.push_back({c, round.empty() ? 0 : angle, dot(cross(axis, into), n) < 0});
    }
    std::sort(round.begin(), round.end(),
              [](const Use& x, const Use& y) { return x.angle < y.angle; });
    if (round.size() % 2 != 0) throw std::logic_error("an edge with an odd number of facets");
    if (!round.front().rock_follows) std::rotate(round.begin(), round.begin() + 1, round.end());
    for (std::size_t i = 0; i < round.size(); i += 2) {
      if (!round[i].rock_follows || round[i + 1].rock_follows)
        throw std::logic_error("rock on neither or both sides of a facet");
      pairs_.push_back({{round[i].from, round[i + 1].from}, false});
    }
  }

  std::vector<Facet> facets_;
  std::vector<Corner> corners_;
  std::vector<Vec3> points_;
  std::map<const void*, int> number_;
  std::vector<std::pair<std::array<Number, 4>, bool>> groups_;
  std::vector<Pair> pairs_;
  Index euler_ = 0;
  Real joint_area_ = 0;
  Number volume6_ = 0;
  Vector first24_ = CGAL::NULL_VECTOR;
};

Real area_of(Nef::Halffacet_const_handle f) {
  Vector twice = CGAL::NULL_VECTOR;
  for (auto cycle = f->facet_cycles_begin(); cycle != f->facet_cycles_end(); ++cycle) {
    if (!cycle.is_shalfedge()) continue;
    Nef::SHalfedge_around_facet_const_circulator at{Nef::SHalfedge_const_handle(cycle)};
    const auto end = at;
    std::vector<Point> loop;
    CGAL_For_all(at, end) loop.push_back(at->source()->source()->point());
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      twice = twice + CGAL::cross_product(loop[i] - loop[0], loop[i + 1] - loop[0]);
  }
  return norm(rounded(twice)) / 2;
}

}  // namespace

std::vector<NefBlock> nef_blocks(const Model& model) {
  Nef rock;
  for (const Solid& s : model.solids) {
    const Nef shape = std::visit([](const auto& x) { return solid(x); }, s.shape);
    rock = s.add ? rock + shape : (rock - shape).closure();
  }
  rock = rock.regularization();
  std::vector<Point> corners;
  for (auto v = rock.vertices_begin(); v != rock.vertices_end(); ++v) corners.push_back(v->point());
  const CGAL::Bbox_3 box = CGAL::bbox_3(corners.begin(), corners.end());
  const Point centre((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
                     (box.zmin() + box.zmax()) / 2);
  const Real size =
      std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  for (const Joint& j : model.joints) rock = rock - joint_facet(j, centre, 4 * size);

  std::map<const void*, VolumeSurface> surfaces;
  std::map<const void*, Real> dead_ends;
  for (auto f = rock.halffacets_begin(); f != rock.halffacets_end(); ++f) {
    const auto volume = f->incident_volume();
    if (!volume->mark()) continue;
    if (volume == f->twin()->incident_volume())
      dead_ends[&*volume] += area_of(f) / 2;  // met from either side
    else
      surfaces[&*volume].add(f);
  }
  std::vector<NefBlock> blocks;
  for (auto& [volume, surface] : surfaces) {
    blocks.push_back(surface.count());
    blocks.back().dead_end_area = dead_ends[volume];
  }
  std::sort(blocks.begin(), blocks.end(), [](const NefBlock& a, const NefBlock& b) {
    return a.volume != b.volume ? a.volume < b.volume : a.centroid < b.centroid;
  });
  return blocks;
}

std::vector<std::string> differences(const Blocks& found, const std::vector<NefBlock>& expected) {
  std::vector<std::string> lines;
  const auto line = [&](const auto&... part) {
    if (lines.size() >= 20) return;
    std::ostringstream text;
    text.precision(17);
    (text << ... << part);
    lines.push_back(text.str());
  };
  const BlockArrays& a = found.arrays;
  Real rock = 0, shared = 0, dead = 0;
  for (const NefBlock& e : expected) {
    rock += e.volume;
    shared += e.joint_area / 2;
    dead += e.dead_end_area;
  }
  const Real length = std::cbrt(rock), volume_off = 1e-10 * rock,
             area_off = 1e-10 * length * length;
  if (a.block_count() != static_cast<Index>(expected.size()))
    line(a.block_count(), " blocks, expected ", expected.size());
  std::vector<bool> used(expected.size(), false);
  for (Index b = 0; b < a.block_count(); ++b) {
    std::size_t match = expected.size();
    for (std::size_t i = 0; i < expected.size() && match == expected.size(); ++i)
      if (!used[i] && std::abs(a.volume[b] - expected[i].volume) <= volume_off &&
          norm(a.centroid[b] - expected[i].centroid) <=
              1e-6 * length + 1e-10 * rock * length / expected[i].volume)
        match = i;
    if (match == expected.size()) {
      const Vec3& c = a.centroid[b];
      line("block ", b, " of volume ", a.volume[b], " about ", c[0], " ", c[1], " ", c[2],
           " is not expected");
      continue;
    }
    used[match] = true;
    const NefBlock& e = expected[match];
    if (!(counts_of(a, b) == e.counts))
      line("block ", b, ": ", counts_of(a, b), ", expected ", e.counts);
    if (a.shell_count[b] != e.shells)
      line("block ", b, ": ", a.shell_count[b], " shells, expected ", e.shells);
    if (a.genus[b] != e.genus) line("block ", b, ": genus ", a.genus[b], ", expected ", e.genus);
    const Real ends = a.dead_end_area.empty() ? 0 : a.dead_end_area[b];
    if (!(std::abs(ends - e.dead_end_area) <= area_off))
      line("block ", b, ": dead-end area ", ends, ", expected ", e.dead_end_area);
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      line("no block of volume ", expected[i].volume, " about ", expected[i].centroid[0], " ",
           expected[i].centroid[1], " ", expected[i].centroid[2]);
  const CutTotals& t = found.cutting.totals;
  if (!(std::abs(t.solid_volume - rock) <= volume_off))
    line("solid volume ", t.solid_volume, ", expected ", rock);
  if (!(std::abs(t.dangling_joint_area - dead) <= area_off))
    line("dangling joint area ", t.dangling_joint_area, ", expected ", dead);
  if (!(std::abs(t.joint_area - dead - shared) <= area_off))
    line("joint area ", t.joint_area, ", expected ", dead + shared);
  return lines;
}

}  // namespace rockfold::test
