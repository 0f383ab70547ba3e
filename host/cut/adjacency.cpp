#include "host/cut/adjacency.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "host/cut/patch_finder.hpp"
#include "host/cut/plane_areas.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// What one plane contributes; polygon numbers are local until all planes are joined.
struct PlaneResult {
  std::vector<Fragment> fragments;
  std::vector<FreePart> free_parts;
  std::vector<Fragment> gaps;
  std::vector<Polygon> polygons;
  std::vector<std::vector<Index>> shared_faces;  // origins of the free parts that lie on several
};

bool have_common(const std::vector<Index>& a, const std::vector<Index>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](Index i) { return std::binary_search(b.begin(), b.end(), i); });
}

Box box_of(const Polygon& polygon) {
  Box box;
  for (const Vertex& v : polygon.corner) box.add(v.x);
  return box;
}

// Labels the areas of one plane.
class PlaneLabeller {
 public:
  PlaneLabeller(const Complex& complex, Index plane, Index rock_count)
      : complex_(complex),
        plane_(plane),
        rock_count_(rock_count),
        clipper_(complex.planes),
        joints_(complex.joints_by_plane.on(plane), complex.planes.normal(plane),
                [&](Index j) { return complex.joints[j].patch.box; }),
        facets_(complex.facets_by_plane.on(plane), complex.planes.normal(plane),
                [&](Index f) { return complex.facets[f].patch.box; }) {
    bool several = false;
    for (const Index f : complex.facets_by_plane.on(plane))
      if (names_rock(complex.facets[f])) {
        several = several || (only_origin_ != none && only_origin_ != complex.facets[f].origin);
        only_origin_ = complex.facets[f].origin;
      }
    if (several) only_origin_ = none;
  }

  PlaneResult run(PlaneAreas& areas) {
    result_.fragments.reserve(areas.shared.size());
    for (SharedArea& shared : areas.shared) {
      if (is_rock(shared.cell[0]) && is_rock(shared.cell[1]))
        label(shared);
      else
        label_gap(shared);
    }
    for (OpenArea& open : areas.open)
      if (is_rock(open.cell)) label(open, none);
    return std::move(result_);
  }

 private:
  bool is_rock(Index cell) const { return cell < rock_count_; }
  const Zone& zone(Index cell) const { return complex_.zone(cell); }
  const ConvexCell::Face& face(Index cell, Index f) const { return complex_.cells[cell].faces[f]; }

  bool applies(const JointPatch& joint, const SharedArea& shared) const {
    if (joint.within == none) return true;
    const auto inside = [&](Index cell) {
      if (!is_rock(cell)) return false;
      const auto& solids = zone(cell).within;
      return std::binary_search(solids.begin(), solids.end(), joint.within);
    };
    return inside(shared.cell[0]) || inside(shared.cell[1]);
  }

  // An excavation's boundary is a free face to be, whatever lies there; merging makes all else intact; of joints the first
  // listed wins where they overlap; what no joint covers is a solid's interface or glue.
  void label(SharedArea& shared) {
    const Zone &below = zone(shared.cell[0]), &above = zone(shared.cell[1]);
    if (below.stage != above.stage) return add_whole(shared, excavation_origin(shared), none);
    if (have_common(below.merges, above.merges)) return add_whole(shared, none, none);
    label_joints(shared, interface_between(complex_, below, above));
  }

  // `rest`: what no joint covers.
  void label_joints(SharedArea& shared, Index rest) {
    usable_.clear();
    for (const Index j : joints_near(shared))
      if (applies(complex_.joints[j], shared)) usable_.push_back(j);
    if (usable_.empty()) return add_whole(shared, rest, none);
    if (const JointPatch& first = complex_.joints[usable_.front()];
        !first.patch.bounded() || lies_inside_circle(shared, first.patch))
      return add_whole(shared, first.origin, first.instance);
    divide_by_joints(shared, rest);
  }

  // As most areas that a joint covers do: their corners need not be compared with its edges.
  bool lies_inside_circle(const SharedArea& shared, const Patch& patch) const {
    const Real reach = patch.inner - complex_.planes.width_tolerance();
    if (reach <= 0) return false;
    const auto is_inside = [&](const Vertex& v) {
      const Vec3 r = v.x - patch.middle;
      return dot(r, r) < reach * reach;
    };
    const auto& polygon = shared.polygon.corner;
    if (!polygon.empty()) return std::all_of(polygon.begin(), polygon.end(), is_inside);
    const CellView cell = complex_.cells[shared.cell[0]];
    const ConvexCell::Face& f = cell.faces[shared.face[0]];
    const auto corners = cell.corners.subspan(f.begin, f.count);
    return std::all_of(corners.begin(), corners.end(),
                       [&](const auto& corner) { return is_inside(cell.vertices[corner.vertex]); });
  }

  // Rock before a narrow void has a free face there; whether rock is behind, beams will tell.
  void label_gap(SharedArea& shared) {
    for (int side = 0; side < 2; ++side)
      if (is_rock(shared.cell[side])) {
        OpenArea open{shared.cell[side], shared.face[side], polygon_of(shared)};
        label(open, shared.cell[1 - side]);
      }
    add_to_ = &result_.gaps;
    label_joints(shared, none);
    add_to_ = &result_.fragments;
  }

  // Of few joints all: divide_by_joints() looks at their boxes.
  std::span<const Index> joints_near(const SharedArea& shared) {
    const auto on_plane = complex_.joints_by_plane.on(plane_);
    if (on_plane.size() <= 16) return on_plane;
    joints_.near(box_of(polygon_of(shared)), complex_.planes.width_tolerance(), near_);
    return near_;
  }

  Polygon polygon_of(const SharedArea& shared) const {
    return shared.polygon.empty()
               ? face_polygon(complex_.cells[shared.cell[0]], face(shared.cell[0], shared.face[0]))
               : shared.polygon;
  }

  void divide_by_joints(SharedArea& shared, Index rest) {
    std::vector<Polygon> left{polygon_of(shared)};
    const Box box = box_of(left.front());
    bool whole = true;
    for (const Index j : usable_) {
      const JointPatch& joint = complex_.joints[j];
      if (!joint.patch.box.meets(box, complex_.planes.width_tolerance())) continue;
      std::vector<Polygon> next;
      for (Polygon& p : left) {
        const auto share = clipper_.share(p, joint.patch.edges);
        if (share == PolygonClipper::Share::all) {
          if (whole) return add_whole(shared, joint.origin, joint.instance);
          add_part(shared, std::move(p), joint.origin, joint.instance);
          continue;
        }
        Polygon common;
        if (share == PolygonClipper::Share::some)
          common = clipper_.intersection(p, joint.patch.edges);
        if (common.empty()) {
          next.push_back(std::move(p));
          continue;
        }
        clipper_.subtract(p, joint.patch.edges, next);
        add_part(shared, std::move(common), joint.origin, joint.instance);
        whole = false;
      }
      left = std::move(next);
    }
    if (whole) return add_whole(shared, rest, none);
    for (Polygon& p : left) add_part(shared, std::move(p), rest, none);
  }

  // The excavation's face that covers most of an area between two stages.
  Index excavation_origin(const SharedArea& shared) {
    const Polygon polygon = polygon_of(shared);
    Index best = none;
    Real most = 0;
    facets_.near(box_of(polygon), complex_.planes.width_tolerance(), near_);
    for (const Index f : near_) {
      const Facet& facet = complex_.facets[f];
      if (complex_.bodies[facet.body].role != Body::Role::excavation || facet.origin == none)
        continue;
      const Real area = polygon_moments(clipper_.intersection(polygon, facet.patch.edges)).area;
      if (best == none || area > most) best = facet.origin, most = area;
    }
    return best;
  }

  void add_whole(SharedArea& shared, Index joint, Index instance) {
    if (!shared.polygon.empty())
      return add_part(shared, std::move(shared.polygon), joint, instance);
    const CellView cell = complex_.cells[shared.cell[0]];
    add_to_->push_back({{shared.cell[0], shared.cell[1]},
                        {shared.face[0], shared.face[1]},
                        joint,
                        instance,
                        none,
                        face_area(cell, cell.faces[shared.face[0]])});
  }

  void add_part(const SharedArea& shared, Polygon polygon, Index joint, Index instance) {
    const Real area = polygon_moments(polygon).area;
    add_to_->push_back({{shared.cell[0], shared.cell[1]},
                        {shared.face[0], shared.face[1]},
                        joint,
                        instance,
                        static_cast<Index>(result_.polygons.size()),
                        area});
    result_.polygons.push_back(std::move(polygon));
  }

  struct Part {
    Polygon polygon;
    std::vector<Index> origins;  // of the faces of solids that it lies on, the last solid's first
  };

  // `gap`: the narrow void that the area faces, or none.
  void label(OpenArea& open, Index gap) {
    const bool whole_face = open.polygon.empty();
    const CellView cell = complex_.cells[open.cell];
    std::vector<Part> parts = divide_by_facets(
        whole_face ? face_polygon(cell, cell.faces[open.face]) : std::move(open.polygon),
        cell.faces[open.face].inside);
    const bool whole = whole_face && parts.size() == 1;
    for (Part& part : parts) {
      const Real area = polygon_moments(part.polygon).area;
      result_.free_parts.push_back({open.cell, open.face, number_of(std::move(part.origins)),
                                    whole ? none : static_cast<Index>(result_.polygons.size()),
                                    area, gap});
      if (!whole) result_.polygons.push_back(std::move(part.polygon));
    }
  }

  bool names_rock(const Facet& facet) const {
    return facet.origin != none && complex_.bodies[facet.body].role == Body::Role::solid;
  }

  // Several faces are numbered below none; find_adjacency() makes origins of them.
  Index number_of(std::vector<Index> origins) {
    if (origins.size() == 1) return origins.front();
    auto& known = result_.shared_faces;
    const auto at = std::find(known.begin(), known.end(), origins);
    const auto number = static_cast<Index>(at - known.begin());
    if (at == known.end()) known.push_back(std::move(origins));
    return none - 1 - number;
  }

  // Whether rock on the given side lies on a solid's own surface there: inside of what was added, outside of what was taken.
  bool bounds(const Facet& facet, HalfSpaceId rock) const {
    return (facet.inside == rock) == complex_.adds_solid[complex_.bodies[facet.body].owner];
  }

  // All faces of solids that a free area lies on; the solid that was added or taken away there last comes first.
  std::vector<Part> divide_by_facets(Polygon polygon, HalfSpaceId rock) {
    if (only_origin_ != none) return {{std::move(polygon), {only_origin_}}};
    facets_.near(box_of(polygon), complex_.planes.width_tolerance(), near_);
    usable_.clear();
    for (std::size_t i = near_.size(); i-- > 0;)
      if (const Facet& facet = complex_.facets[near_[i]]; names_rock(facet) && bounds(facet, rock))
        usable_.push_back(near_[i]);
    const Index first = usable_.empty() ? nearest_face() : complex_.facets[usable_.front()].origin;
    std::vector<Part> parts;
    parts.push_back({std::move(polygon), {}});
    if (usable_.size() > 1)
      for (std::size_t begin = 0, end = 0; begin < usable_.size(); begin = end) {
        while (end < usable_.size() && owner_of(usable_[end]) == owner_of(usable_[begin])) ++end;
        name_parts(std::span(usable_).subspan(begin, end - begin), parts);
      }
    for (Part& part : parts)
      if (part.origins.empty()) part.origins = {first};
    return parts;
  }

  Index owner_of(Index facet) const { return complex_.bodies[complex_.facets[facet].body].owner; }

  // Facets of one solid do not overlap: an area that lies on one of them is done.
  void name_parts(std::span<const Index> facets, std::vector<Part>& parts) {
    std::vector<Part> named;
    for (const Index f : facets) parts = take(complex_.facets[f], std::move(parts), named);
    std::move(named.begin(), named.end(), std::back_inserter(parts));
  }

  // Where nothing names an area: a convex part's plane that was taken for another one ends beside its facets by rounding.
  Index nearest_face() const {
    for (const Index f : complex_.facets_by_plane.on(plane_))
      if (names_rock(complex_.facets[f])) return complex_.facets[f].origin;
    for (const Facet& facet : complex_.facets)
      if (names_rock(facet)) return facet.origin;
    return none;
  }

  // What the facet does not cover; what it covers is named after it too.
  std::vector<Part> take(const Facet& facet, std::vector<Part> left, std::vector<Part>& named) {
    std::vector<Part> rest;
    for (Part& p : left) {
      const auto share = clipper_.share(p.polygon, facet.patch.edges);
      Polygon common;
      if (share == PolygonClipper::Share::all)
        common = std::move(p.polygon);
      else if (share == PolygonClipper::Share::some)
        common = clipper_.intersection(p.polygon, facet.patch.edges);
      if (common.empty()) {
        rest.push_back(std::move(p));
        continue;
      }
      if (share == PolygonClipper::Share::some) {
        std::vector<Polygon> outside;
        clipper_.subtract(p.polygon, facet.patch.edges, outside);
        for (Polygon& polygon : outside) rest.push_back({std::move(polygon), p.origins});
      }
      p.origins.push_back(facet.origin);
      named.push_back({std::move(common), std::move(p.origins)});
    }
    return rest;
  }

  const Complex& complex_;
  const Index plane_, rock_count_;
  PolygonClipper clipper_;
  PlaneResult result_;
  std::vector<Fragment>* add_to_ = &result_.fragments;
  PatchFinder joints_, facets_;
  Index only_origin_ = none;          // of all the plane's faces of solids
  std::vector<Index> near_, usable_;  // joints or facets that count for the area at hand
};

}  // namespace

namespace {

// The origin of an area that lies on several faces of solids.
FaceOrigin shared_origin(const std::vector<FaceOrigin>& origins, const std::vector<Index>& faces) {
  FaceOrigin shared = origins[faces.front()];
  for (std::size_t i = 1; i < faces.size(); ++i) {
    const FaceOrigin& other = origins[faces[i]];
    shared.name += ", " + other.name;
    shared.also.push_back({other.solid, other.solid_face});
    shared.continues = shared.continues || other.continues;
  }
  return shared;
}

// Numbers the areas on several faces as origins of their own, plane by plane.
void add_shared_origins(std::vector<PlaneResult>& results, std::vector<FaceOrigin>& origins) {
  std::map<std::vector<Index>, Index> number;
  for (PlaneResult& r : results) {
    for (const auto& faces : r.shared_faces) {
      const auto [at, fresh] = number.try_emplace(faces, static_cast<Index>(origins.size()));
      if (fresh) origins.push_back(shared_origin(origins, faces));
    }
    for (FreePart& part : r.free_parts)
      if (part.origin < none) part.origin = number.at(r.shared_faces[none - 1 - part.origin]);
  }
}

}  // namespace

Index interface_between(const Complex& complex, const Zone& one, const Zone& two) {
  if (one.solid == two.solid) return none;
  // The later solid made the boundary.
  const auto [first, last] = std::minmax(one.solid, two.solid);
  const auto& interfaces = complex.interfaces;
  const Index material = interfaces.material[interfaces.kind[last]][interfaces.kind[first]];
  if (material == none) return none;
  return interfaces.origin.at({interfaces.given[last] != 0 ? last : first, material});
}

std::vector<Fragment> find_adjacency(Complex& complex, Index rock_count) {
  std::vector<PlaneResult> results(complex.planes.size());
  // Rock ends on faces of shapes alone.
  const auto may_be_open = [&](Index plane) { return !complex.facets_by_plane.on(plane).empty(); };
  for_each_plane(complex.planes, complex.cells, may_be_open, [&](Index plane, PlaneAreas& areas) {
    results[plane] = PlaneLabeller(complex, plane, rock_count).run(areas);
  });

  add_shared_origins(results, complex.origins);

  // Joined in the order of planes, on all threads.
  std::vector<std::array<std::size_t, 4>> begin(results.size() + 1);
  for (std::size_t p = 0; p < results.size(); ++p)
    begin[p + 1] = {begin[p][0] + results[p].fragments.size(),
                    begin[p][1] + results[p].free_parts.size(),
                    begin[p][2] + results[p].polygons.size(), begin[p][3] + results[p].gaps.size()};
  std::vector<Fragment> gaps(begin.back()[3]);
  complex.fragments.resize(begin.back()[0]);
  complex.free_parts.resize(begin.back()[1]);
  complex.polygons.resize(begin.back()[2]);
  const auto take = [&](std::int64_t p) {
    PlaneResult& r = results[p];
    const auto shift = static_cast<Index>(begin[p][2]);
    const auto append = [&](auto& from, auto& to, std::size_t at) {
      for (auto& item : from) {
        if (item.polygon != none) item.polygon += shift;
        to[at++] = item;
      }
    };
    append(r.fragments, complex.fragments, begin[p][0]);
    append(r.free_parts, complex.free_parts, begin[p][1]);
    append(r.gaps, gaps, begin[p][3]);
    std::move(r.polygons.begin(), r.polygons.end(),
              complex.polygons.begin() + static_cast<std::ptrdiff_t>(begin[p][2]));
    r = {};
  };
  parallel_for(static_cast<std::int64_t>(results.size()), 16, take,
               complex.fragments.size() > 2000);
  return gaps;
}

}  // namespace rockfold
