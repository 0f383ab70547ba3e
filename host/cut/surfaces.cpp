#include "host/cut/surfaces.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "host/exact/plane_exact.hpp"
#include "host/joints/place_joints_exact.hpp"
#include "host/refuse.hpp"
#include "host/shapes/shape_geometry_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

std::string solid_key(const Model& model, std::size_t solid) {
  return fmt::format("solid[{}] \"{}\"", solid + 1, model.solids[solid].name);
}

struct Corners {
  std::vector<Vec3> all;
  Vec3 min{}, max{};
};

Corners model_corners(const Model& model, const std::vector<ShapeGeometry>& shapes) {
  Corners corners;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    if (!model.solids[s].add) continue;
    const auto& more = shapes[s].corners;
    corners.all.insert(corners.all.end(), more.begin(), more.end());
  }
  if (corners.all.empty())
    refuse({model.path, 0, 0, {}}, "solid", "no solid is added: there is no rock to cut");
  corners.min = corners.max = corners.all.front();
  for (const Vec3& p : corners.all)
    for (int d = 0; d < 3; ++d) {
      corners.min[d] = std::min(corners.min[d], p[d]);
      corners.max[d] = std::max(corners.max[d], p[d]);
    }
  return corners;
}

void add_origins(const Model& model, const PlacedJoints& joints, Complex& complex) {
  for (const JointOrigin& joint : joints.origins) {
    FaceOrigin origin;
    origin.name = joint.name;
    origin.joint_material = joint.material;
    complex.origins.push_back(origin);
  }
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    const Solid& solid = model.solids[s];
    complex.bodies.push_back({{}, static_cast<Index>(complex.origins.size())});
    const auto names = face_names(solid.shape);
    for (std::size_t f = 0; f < names.size(); ++f) {
      FaceOrigin origin;
      origin.kind = FaceOrigin::Kind::solid_face;
      origin.name = solid.name + "." + names[f];
      origin.solid = static_cast<Index>(s);
      origin.solid_face = static_cast<Index>(f);
      origin.continues = f < solid.continues.size() && solid.continues[f];
      complex.origins.push_back(origin);
    }
  }
}

HalfSpaceId find_or_add(PlaneTable& planes, const ExactPlane& plane) {
  const HalfSpaceId found = planes.find(plane);
  return found != none ? found : half_space(planes.add(plane), true);
}

void add_solids(const std::vector<ShapeGeometry>& shapes, CuttingInput& input) {
  Complex& complex = input.complex;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    auto& inside = complex.bodies[s].inside;
    for (const FacePlane& f : shapes[s].parts.front().faces) {
      const HalfSpaceId up = find_or_add(complex.planes, f.plane);
      inside.push_back(f.inside_above ? up : up ^ 1);
    }
    for (const HalfSpaceId h : inside) {
      CuttingSurface surface{plane_of(h), {}};
      for (const HalfSpaceId edge : inside)
        if (plane_of(edge) != plane_of(h)) surface.edges.push_back(edge);
      input.solid_faces.push_back(std::move(surface));
    }
  }
}

// 0, n/2, n/4, 3n/4, …: parallel planes next to each other in the list halve what is left.
std::vector<Index> bisecting_order(Index n) {
  std::vector<Index> order;
  order.reserve(n);
  const auto bits = static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(n)));
  for (std::uint32_t i = 0; i < (1u << bits); ++i) {
    std::uint32_t reversed = 0;
    for (unsigned b = 0; b < bits; ++b) reversed |= (i >> b & 1u) << (bits - 1 - b);
    if (reversed < static_cast<std::uint32_t>(n)) order.push_back(static_cast<Index>(reversed));
  }
  return order;
}

struct JointPlane {
  ExactPlane plane;
  // Unit normal with the upward sense, and offset: an order that the model's own does not enter.
  std::array<Real, 4> key;
  Index origin;
};

JointPlane joint_plane(ExactPlane plane, const Vec3& centre, Index origin) {
  if (plane.n[2] < 0 ||
      (plane.n[2] == 0 && (plane.n[1] < 0 || (plane.n[1] == 0 && plane.n[0] < 0))))
    plane = opposite(plane);
  PlaneTable rounding(centre, 1);
  const Index id = rounding.add(plane);
  const Vec3& n = rounding.normal(id);
  return {std::move(plane), {n[0], n[1], n[2], rounding.offset(id)}, origin};
}

void add_joints(const PlacedJoints& placed, CuttingInput& input) {
  Complex& complex = input.complex;
  std::vector<JointPlane> joints;
  for (const PlacedJoint& joint : placed.joints)
    joints.push_back(joint_plane(joint.plane, complex.planes.centre(), joint.origin));
  std::sort(joints.begin(), joints.end(), [](const JointPlane& a, const JointPlane& b) {
    return a.key != b.key ? a.key < b.key : a.origin < b.origin;
  });
  std::vector<Index> planes;  // each once
  for (const JointPlane& joint : joints) {
    const HalfSpaceId found = complex.planes.find(joint.plane);
    if (found != none) ++input.planes_identified;
    const Index plane = found != none ? plane_of(found) : complex.planes.add(joint.plane);
    complex.joint_of_plane.resize(complex.planes.size(), none);
    Index& origin = complex.joint_of_plane[plane];
    if (origin == none) planes.push_back(plane);
    if (origin == none || joint.origin < origin) origin = joint.origin;
  }
  complex.joint_of_plane.resize(complex.planes.size(), none);
  for (const Index i : bisecting_order(static_cast<Index>(planes.size())))
    input.joints.push_back({planes[i], {}});
}

}  // namespace

CuttingInput make_surfaces(const Model& model) {
  std::vector<ShapeGeometry> shapes;
  RockBounds rock;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    Place place = model.solids[s].place;
    place.key = solid_key(model, s);
    shapes.push_back(shape_geometry(model.solids[s].shape, model.solids[s].add, place));
    rock.solid_corners.push_back(shapes.back().corners);
  }
  const Corners corners = model_corners(model, shapes);
  const Vec3 centre = 0.5 * (corners.min + corners.max);
  rock.corners = corners.all;
  const PlacedJoints joints = place_joints(model, rock);

  CuttingInput input{Complex(PlaneTable(centre, norm(corners.max - corners.min))),
                     corners.min - centre,
                     corners.max - centre,
                     {},
                     {},
                     0};
  add_origins(model, joints, input.complex);
  add_solids(shapes, input);
  add_joints(joints, input);
  return input;
}

}  // namespace rockfold
