#include "host/cut/planes/surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "host/cut/planes/edge_planes.hpp"
#include "host/cut/planes/joint_patches_exact.hpp"
#include "host/cut/planes/part_planes_exact.hpp"
#include "host/joints/place_joints_exact.hpp"
#include "host/refuse.hpp"
#include "host/shapes/shape_geometry_exact.hpp"
#include "src/base/vector.hpp"
#include "src/model/pair_law.hpp"

namespace rockfold {

namespace {

// A shape of the model and what it is for.
struct ShapeRegion {
  Body::Role role;
  Index owner;
  ShapeGeometry geometry;
  Index first_origin = none;  // of face 0; none = its faces are no faces of blocks
};

Place keyed(const Place& place, std::string key) {
  return {place.file, place.line, place.column, std::move(key)};
}

std::vector<ShapeRegion> make_regions(const Model& model) {
  std::vector<ShapeRegion> regions;
  const auto count = [](const auto& list) { return static_cast<Index>(list.size()); };
  for (Index s = 0; s < count(model.solids); ++s) {
    const Solid& solid = model.solids[s];
    const Place place = keyed(solid.place, fmt::format("solid[{}] \"{}\"", s + 1, solid.name));
    regions.push_back({Body::Role::solid, s, shape_geometry(solid.shape, solid.add, place)});
  }
  for (Index e = 0; e < count(model.excavations); ++e) {
    const Excavation& excavation = model.excavations[e];
    const Place place =
        keyed(excavation.place, fmt::format("excavation[{}] \"{}\"", e + 1, excavation.name));
    regions.push_back({Body::Role::excavation, e, shape_geometry(excavation.shape, false, place)});
  }
  for (Index m = 0; m < count(model.merges); ++m) {
    const auto& region = model.merges[m].region;
    if (const auto* box = std::get_if<Merge::Box>(&region))
      regions.push_back(
          {Body::Role::merge, m,
           shape_geometry(BoxShape{box->min, box->max}, false, model.merges[m].place)});
    else if (const auto* inside = std::get_if<Merge::InSolid>(&region))
      regions.push_back({Body::Role::merge, m, regions[inside->solid].geometry});
  }
  return regions;
}

RockBounds rock_bounds(const Model& model, const std::vector<ShapeRegion>& regions) {
  RockBounds rock;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    const auto& corners = regions[s].geometry.corners;
    rock.solid_corners.push_back(corners);
    if (model.solids[s].add)
      rock.corners.insert(rock.corners.end(), corners.begin(), corners.end());
  }
  if (rock.corners.empty())
    refuse({model.path, 0, 0, {}}, "solid", "no solid is added: there is no rock to cut");
  return rock;
}

FaceOrigin shape_origin(FaceOrigin::Kind kind, const std::string& owner, const std::string& face,
                        std::size_t owner_id, std::size_t face_id) {
  FaceOrigin origin;
  origin.kind = kind;
  origin.name = owner + "." + face;
  origin.solid = static_cast<Index>(owner_id);
  origin.solid_face = static_cast<Index>(face_id);
  return origin;
}

FaceOrigin joint_origin(const std::string& name, Index material) {
  FaceOrigin origin;
  origin.name = name;
  origin.joint_material = material;
  return origin;
}

// The joints round solids with an interface: of its material, and of each that it gives with others.
void add_interfaces(const Model& model, Complex& complex) {
  auto& [kind, material, given, origin] = complex.interfaces;
  complex.first_interface = static_cast<Index>(complex.origins.size());
  std::map<std::pair<Index, Index>, Index> kinds;  // of interface and surface
  std::vector<Index> example;
  for (Index s = 0; s < std::ssize(model.solids); ++s) {
    const auto [at, fresh] = kinds.try_emplace(
        {model.solids[s].interface, interface_surface(model, s)}, std::ssize(example));
    if (fresh) example.push_back(s);
    kind.push_back(at->second);
    given.push_back(model.solids[s].interface != none ? 1 : 0);
  }
  for (const Index a : example) {
    auto& row = material.emplace_back();
    for (const Index b : example) row.push_back(interface_material(model, a, b));
  }
  for (Index s = 0; s < std::ssize(model.solids); ++s) {
    if (given[s] == 0) continue;
    std::vector<Index> materials = material[kind[s]];
    materials.insert(materials.begin(), model.solids[s].interface);
    for (const Index m : materials)
      if (origin.try_emplace({s, m}, static_cast<Index>(complex.origins.size())).second)
        complex.origins.push_back(joint_origin(model.solids[s].name + ".interface", m));
  }
}

void add_origins(const Model& model, const PlacedJoints& joints, std::vector<ShapeRegion>& regions,
                 Complex& complex) {
  auto& origins = complex.origins;
  for (const JointOrigin& joint : joints.origins)
    origins.push_back(joint_origin(joint.name, joint.material));
  for (ShapeRegion& region : regions) {
    if (region.role == Body::Role::merge) continue;
    region.first_origin = static_cast<Index>(origins.size());
    const bool is_solid = region.role == Body::Role::solid;
    const std::string& owner =
        is_solid ? model.solids[region.owner].name : model.excavations[region.owner].name;
    const auto names = face_names(is_solid ? model.solids[region.owner].shape
                                           : model.excavations[region.owner].shape);
    for (std::size_t f = 0; f < names.size(); ++f) {
      origins.push_back(
          shape_origin(is_solid ? FaceOrigin::Kind::solid_face : FaceOrigin::Kind::excavation,
                       owner, names[f], region.owner, f));
      if (!is_solid) continue;
      const auto& continues = model.solids[region.owner].continues;
      origins.back().continues = f < continues.size() && continues[f];
    }
  }
  for (const Solid& solid : model.solids) complex.adds_solid.push_back(solid.add);
  add_interfaces(model, complex);
}

Index origin_of(const ShapeRegion& region, Index face) {
  return region.first_origin == none || face == none ? none : region.first_origin + face;
}

// The faces that a convex part has inside the enclosing box, with the edges between them.
void add_convex(const ShapeRegion& region, const ConvexPart& part,
                std::vector<HalfSpaceId> half_spaces, const CellView& start, Complex& complex) {
  Body body;
  body.role = region.role;
  body.owner = region.owner;
  body.inside = std::move(half_spaces);
  body.facet_begin = static_cast<Index>(complex.facets.size());
  const ConvexCell cell = clip(complex.planes, start, body.inside);
  for (const Vertex& v : cell.vertices) body.box.add(v.x);
  for (const auto& face : cell.faces) {
    const auto found = std::find(body.inside.begin(), body.inside.end(), face.inside);
    if (found == body.inside.end()) continue;  // of the enclosing box
    const Polygon polygon = face_polygon(cell, face);
    Facet facet;
    facet.patch.plane = polygon.plane;
    facet.patch.edges = polygon.edge;
    facet.patch.box = facet.patch.corners = {};
    for (const Vertex& v : polygon.corner) {
      facet.patch.box.add(v.x);
      facet.patch.corners.add(v.x + complex.planes.centre());
    }
    facet.inside = face.inside;
    facet.origin = origin_of(region, part.faces[found - body.inside.begin()].face);
    facet.body = static_cast<Index>(complex.bodies.size());
    complex.facets.push_back(std::move(facet));
  }
  body.facet_end = static_cast<Index>(complex.facets.size());
  complex.bodies.push_back(std::move(body));
}

// A closed surface with its corners as exact numbers, and what lies across its edges.
class SurfaceFacets {
 public:
  SurfaceFacets(const ClosedSurface& surface, PlaneTable& planes)
      : surface_(surface), planes_(planes) {
    for (const Vec3& x : surface.vertices) exact_.push_back(exact(x));
    const auto count = static_cast<Index>(surface.face.size());
    outward_.resize(count, none);
    for (Index i = 0; i < count; ++i) outward_[i] = plane_of_polygon(i);
    for (Index i = 0; i < count; ++i)
      if (outward_[i] != none) add_edges(i);
    std::sort(edges_.begin(), edges_.end());
  }

  Index size() const { return static_cast<Index>(outward_.size()); }
  /// The half-space outside, none for a polygon without area, which bounds nothing.
  HalfSpaceId outward(Index polygon) const { return outward_[polygon]; }

  std::vector<Vec3> corners(Index polygon) const {
    std::vector<Vec3> corners;
    for (Index k = begin(polygon); k < end(polygon); ++k)
      corners.push_back(surface_.vertices[surface_.corner[k]]);
    return corners;
  }

  /// The half-spaces of a polygon's edges: bounded by the plane of the polygon across the edge, which passes through it
  /// exactly, or by a plane of their own. Corners run counter-clockwise seen from outside.
  std::vector<HalfSpaceId> edges(Index polygon) const {
    const std::vector<Vec3> corner = corners(polygon);
    std::vector<HalfSpaceId> result;
    for (Index k = begin(polygon); k < end(polygon); ++k) {
      const Index from = surface_.corner[k], to = next_corner(polygon, k);
      HalfSpaceId inside = none;
      if (const Index other = across(from, to); other != none)
        inside = side_of_corners(planes_, plane_of(outward_[other]), corner);
      if (inside == none)
        inside = side_of_corners(planes_,
                                 plane_across(planes_, surface_.vertices[from],
                                              surface_.vertices[to], plane_of(outward_[polygon])),
                                 corner);
      result.push_back(inside);
    }
    return result;
  }

 private:
  struct DirectedEdge {
    Index from, to, polygon;
    bool operator<(const DirectedEdge& o) const {
      return std::tie(from, to, polygon) < std::tie(o.from, o.to, o.polygon);
    }
  };

  Index begin(Index polygon) const { return surface_.polygon_begin[polygon]; }
  Index end(Index polygon) const { return surface_.polygon_begin[polygon + 1]; }
  Index next_corner(Index polygon, Index k) const {
    return surface_.corner[k + 1 < end(polygon) ? k + 1 : begin(polygon)];
  }

  void add_edges(Index polygon) {
    for (Index k = begin(polygon); k < end(polygon); ++k)
      edges_.push_back({surface_.corner[k], next_corner(polygon, k), polygon});
  }

  // Another plane that runs through the edge the other way, none where there is none.
  Index across(Index from, Index to) const {
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), DirectedEdge{to, from, none});
    return found != edges_.end() && found->from == to && found->to == from ? found->polygon : none;
  }

  // Through the three corners that make the largest triangle with the first.
  HalfSpaceId plane_of_polygon(Index polygon) {
    const Index first = begin(polygon);
    const auto corner = [&](Index k) { return surface_.vertices[surface_.corner[k]]; };
    Index widest = first + 1;
    Real largest = 0;
    for (Index k = first + 1; k + 1 < end(polygon); ++k) {
      const Real area = norm(cross(corner(k) - corner(first), corner(k + 1) - corner(first)));
      if (area > largest) largest = area, widest = k;
    }
    const ExactPlane plane =
        plane_through_points(exact_[surface_.corner[first]], exact_[surface_.corner[widest]],
                             exact_[surface_.corner[widest + 1]]);
    if (plane.n[0] == 0 && plane.n[1] == 0 && plane.n[2] == 0) return none;
    return planes_.find_or_add(plane);
  }

  const ClosedSurface& surface_;
  PlaneTable& planes_;
  std::vector<ExactVec3> exact_;
  std::vector<HalfSpaceId> outward_;
  std::vector<DirectedEdge> edges_;
};

void add_surface(const ShapeRegion& region, const SurfaceFacets& facets, Complex& complex) {
  Body body;
  body.role = region.role;
  body.owner = region.owner;
  body.facet_begin = static_cast<Index>(complex.facets.size());
  for (Index i = 0; i < facets.size(); ++i) {
    if (facets.outward(i) == none) continue;
    Facet facet;
    facet.patch.plane = plane_of(facets.outward(i));
    facet.patch.edges = facets.edges(i);
    facet.patch.box = facet.patch.corners = {};
    for (const Vec3& x : facets.corners(i)) {
      facet.patch.box.add(x - complex.planes.centre());
      facet.patch.corners.add(x);
    }
    facet.inside = facets.outward(i) ^ 1;
    facet.origin = origin_of(region, region.geometry.surface.face[i]);
    facet.body = static_cast<Index>(complex.bodies.size());
    body.box.add(facet.patch.box);
    complex.facets.push_back(std::move(facet));
  }
  body.facet_end = static_cast<Index>(complex.facets.size());
  complex.bodies.push_back(std::move(body));
}

// The planes that the edges of finite joints may lie on.
std::vector<GivenFace> given_faces(const Complex& complex, const JointPolygons& joints) {
  std::vector<Index> everywhere = joints.through_going;
  std::vector<GivenFace> faces;
  for (const Body& body : complex.bodies) {
    for (const HalfSpaceId h : body.inside) everywhere.push_back(plane_of(h));
    for (Index f = body.facet_begin; f < body.facet_end && body.inside.empty(); ++f)
      faces.push_back({complex.facets[f].patch.plane, complex.facets[f].patch.corners});
  }
  std::sort(everywhere.begin(), everywhere.end());
  everywhere.erase(std::unique(everywhere.begin(), everywhere.end()), everywhere.end());
  for (const Index plane : everywhere) faces.push_back({plane});
  return faces;
}

// Of a convex polygon. An edge's plane is no nearer to the middle than the edge.
void find_circles(const std::vector<Vec3>& corner, const PlaneTable& planes, Patch& patch) {
  patch.middle = {};
  for (const Vec3& x : corner)
    patch.middle += (1 / static_cast<Real>(corner.size())) * (x - planes.centre());
  patch.outer = 0;
  for (const Vec3& x : corner)
    patch.outer = std::max(patch.outer, norm(x - planes.centre() - patch.middle));
  patch.inner = patch.outer;
  for (const HalfSpaceId h : patch.edges) {
    const Real above = dot(planes.normal(plane_of(h)), patch.middle) - planes.offset(plane_of(h));
    patch.inner = std::min(patch.inner, is_above(h) ? above : -above);
  }
}

void add_joint_edges(const JointPolygons& joints, Complex& complex, GivenIntent& intent) {
  if (joints.polygons.empty()) return;
  EdgePlanes found = edge_planes(complex.planes, joints.polygons, given_faces(complex, joints));
  for (std::size_t i = 0; i < joints.polygons.size(); ++i) {
    Patch& patch = complex.joints[joints.patch[i]].patch;
    patch.edges = std::move(found.edges[i]);
    find_circles(joints.polygons[i].corner, complex.planes, patch);
  }
  intent.edges = found.identified;
}

}  // namespace

CuttingInput make_surfaces(const Model& model) {
  std::vector<ShapeRegion> regions = make_regions(model);
  const RockBounds rock = rock_bounds(model, regions);
  PlacedJoints placed = place_joints(model, rock);

  Box box;
  for (const Vec3& x : rock.corners) box.add(x);
  const Vec3 centre = 0.5 * (box.low + box.high);
  const Real size = norm(box.high - box.low);
  CuttingInput input{Complex(PlaneTable(centre, size)), {}, {}, std::move(placed.plane_sets)};
  Complex& complex = input.complex;
  // The rock, and all closed surfaces, so that the border of the start is outside of them.
  Vec3 reach = 0.5 * (box.high - box.low);
  for (const ShapeRegion& region : regions)
    if (!region.geometry.surface.face.empty())
      for (const Vec3& x : region.geometry.corners)
        for (int d = 0; d < 3; ++d) reach[d] = std::max(reach[d], std::abs(x[d] - centre[d]));
  reach += 0.125 * size * Vec3{1, 1, 1};
  const ConvexCell start = make_box(complex.planes, -reach, reach);
  input.start.append(start);

  add_origins(model, placed, regions, complex);
  // Closed surfaces first: their triangles are one plane only where they are equal, and what is given otherwise may coincide
  // with them (rule 2).
  std::list<SurfaceFacets> surfaces;
  std::vector<const ConvexPart*> parts;
  for (const ShapeRegion& region : regions) {
    if (!region.geometry.surface.face.empty())
      surfaces.emplace_back(region.geometry.surface, complex.planes);
    for (const ConvexPart& part : region.geometry.parts) parts.push_back(&part);
  }
  auto half_spaces = part_half_spaces(parts, reach, complex.planes);
  auto next = half_spaces.begin();
  auto surface = surfaces.begin();
  for (const ShapeRegion& region : regions) {
    for (const ConvexPart& part : region.geometry.parts)
      add_convex(region, part, std::move(*next++), start, complex);
    if (!region.geometry.surface.face.empty()) add_surface(region, *surface++, complex);
  }
  add_joint_edges(add_joints(placed, input), complex, input.intent);
  complex.facets_by_plane = ByPlane::sort(complex.facets, complex.planes.size());
  complex.joints_by_plane = ByPlane::sort(complex.joints, complex.planes.size());
  return input;
}

}  // namespace rockfold
