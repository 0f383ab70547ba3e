#include "host/cut/surfaces.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "host/cut/edge_planes.hpp"
#include "host/cut/joint_patches_exact.hpp"
#include "host/cut/part_planes_exact.hpp"
#include "host/joints/place_joints_exact.hpp"
#include "host/refuse.hpp"
#include "host/shapes/shape_geometry_exact.hpp"
#include "src/base/vector.hpp"

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
  complex.interface_of_solid.assign(model.solids.size(), none);
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    if (model.solids[s].interface == none) continue;
    complex.interface_of_solid[s] = static_cast<Index>(origins.size());
    origins.push_back(joint_origin(model.solids[s].name + ".interface", model.solids[s].interface));
  }
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

// The plane of a polygon of the surface, through the three corners that make the largest triangle with the first.
ExactPlane plane_of_polygon(const ClosedSurface& surface, Index begin, Index end) {
  const auto corner = [&](Index k) { return surface.vertices[surface.corner[k]]; };
  Index widest = begin + 1;
  Real largest = 0;
  for (Index k = begin + 1; k + 1 < end; ++k) {
    const Real area = norm(cross(corner(k) - corner(begin), corner(k + 1) - corner(begin)));
    if (area > largest) largest = area, widest = k;
  }
  return plane_through_points(corner(begin), corner(widest), corner(widest + 1));
}

bool holds_corners(const ExactPlane& plane, const ClosedSurface& surface, Index begin, Index end) {
  if (end - begin == 3) return true;
  for (Index k = begin; k < end; ++k)
    if (dot(plane.n, exact(surface.vertices[surface.corner[k]])) != plane.d) return false;
  return true;
}

// A closed surface; its facets get their edges together with the joints'.
void add_surface(const ShapeRegion& region, bool alone, Complex& complex,
                 std::vector<FlatPolygon>& polygons, std::vector<Index>& facet_of_polygon) {
  const ClosedSurface& surface = region.geometry.surface;
  Body body;
  body.role = region.role;
  body.owner = region.owner;
  body.facet_begin = static_cast<Index>(complex.facets.size());
  const auto count = static_cast<Index>(surface.face.size());
  for (Index i = 0; i < count; ++i) {
    const Index begin = surface.polygon_begin[i], end = surface.polygon_begin[i + 1];
    const ExactPlane plane = plane_of_polygon(surface, begin, end);
    std::vector<Vec3> corners;  // about the centre
    for (Index k = begin; k < end; ++k)
      corners.push_back(surface.vertices[surface.corner[k]] - complex.planes.centre());
    const Known known = holds_corners(plane, surface, begin, end) ? Known::exactly : Known::nearly;
    const HalfSpaceId outward = alone ? complex.planes.find_or_add(plane, known)
                                      : complex.planes.find_or_add(plane, corners, known);
    FlatPolygon polygon;
    polygon.plane = plane_of(outward);
    Facet facet;
    facet.patch.plane = polygon.plane;
    facet.patch.box = facet.patch.corners = {};
    for (Index k = begin; k < end; ++k) {
      polygon.corner.push_back(surface.vertices[surface.corner[k]]);
      facet.patch.box.add(polygon.corner.back() - complex.planes.centre());
      facet.patch.corners.add(polygon.corner.back());
    }
    if (!is_above(outward)) std::reverse(polygon.corner.begin(), polygon.corner.end());
    facet.inside = outward ^ 1;
    facet.origin = origin_of(region, surface.face[i]);
    facet.body = static_cast<Index>(complex.bodies.size());
    body.box.add(facet.patch.box);
    facet_of_polygon.push_back(static_cast<Index>(complex.facets.size()));
    complex.facets.push_back(std::move(facet));
    polygons.push_back(std::move(polygon));
  }
  body.facet_end = static_cast<Index>(complex.facets.size());
  complex.bodies.push_back(std::move(body));
}

// Edges of the facets of closed surfaces and of the joints' polygons.
void add_edges(const std::vector<Index>& facet_of_polygon, std::vector<FlatPolygon> polygons,
               const JointPolygons& joints, Complex& complex) {
  std::vector<Index> unbounded;  // planes of convex bodies and of through-going joints
  for (const Body& body : complex.bodies)
    for (const HalfSpaceId h : body.inside) unbounded.push_back(plane_of(h));
  unbounded.insert(unbounded.end(), joints.through_going.begin(), joints.through_going.end());
  std::sort(unbounded.begin(), unbounded.end());
  unbounded.erase(std::unique(unbounded.begin(), unbounded.end()), unbounded.end());

  const std::size_t facets = polygons.size();
  polygons.insert(polygons.end(), joints.polygons.begin(), joints.polygons.end());
  auto edges = edge_planes(complex.planes, polygons, unbounded);
  for (std::size_t i = 0; i < facets; ++i)
    complex.facets[facet_of_polygon[i]].patch.edges = std::move(edges[i]);
  for (std::size_t i = facets; i < polygons.size(); ++i)
    complex.joints[joints.patch[i - facets]].patch.edges = std::move(edges[i]);
}

// Of planes that the user gave; triangles of one surface may be as nearly coplanar as they like.
void count_near_planes(const PlaneTable& planes, IntentCount& intent) {
  for (Index p = 0; p < planes.size(); ++p) {
    if (planes.exactly_known(p) || !planes.is_near_another(p)) continue;
    ++intent.near_decisions;
    intent.near_planes.push_back(p);
  }
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
  CuttingInput input{Complex(PlaneTable(centre, size)), {}, 0, {}, std::move(placed.plane_sets)};
  Complex& complex = input.complex;
  const Vec3 reach = 0.5 * (box.high - box.low) + 0.125 * size * Vec3{1, 1, 1};
  const ConvexCell start = make_box(complex.planes, -reach, reach);
  input.start.append(start);

  add_origins(model, placed, regions, complex);
  std::vector<FlatPolygon> polygons;
  std::vector<Index> facet_of_polygon;
  std::vector<const ConvexPart*> parts;
  for (const ShapeRegion& region : regions)
    for (const ConvexPart& part : region.geometry.parts) parts.push_back(&part);
  auto half_spaces = part_half_spaces(parts, reach, complex.planes);
  auto next = half_spaces.begin();
  // Closed surfaces with nothing beside them that meets them to a tolerance: docs/decisions/0005-near-planes.md.
  const bool alone = parts.empty() && placed.joints.empty();
  for (const ShapeRegion& region : regions) {
    for (const ConvexPart& part : region.geometry.parts)
      add_convex(region, part, std::move(*next++), start, complex);
    if (!region.geometry.surface.face.empty())
      add_surface(region, alone, complex, polygons, facet_of_polygon);
  }
  const JointPolygons joints = add_joints(placed, input);
  count_near_planes(complex.planes, input.intent);
  add_edges(facet_of_polygon, std::move(polygons), joints, complex);
  complex.facets_by_plane = ByPlane::sort(complex.facets, complex.planes.size());
  complex.joints_by_plane = ByPlane::sort(complex.joints, complex.planes.size());
  return input;
}

}  // namespace rockfold
