// Solids as CAD programs write them: closed triangle meshes with coordinates rounded to 0.001 … 1, turned by odd angles.
#pragma once

#include <memory>
#include <string>

#include "tests/cut/models/draw.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

struct RoundedMesh {
  std::string kind;  ///< "tunnel", "sphere", "extrusion"
  std::shared_ptr<const TriangleSurface> surface;
  long double volume = 0;  ///< m³, exact
};

/// About 10 to 30 m wide about the origin; a tunnel 80 m long. Facets are far larger than the rounding.
RoundedMesh rounded_mesh(Draw& draw);

/// The mesh as a shape of one face.
Solid mesh_solid(std::string name, std::shared_ptr<const TriangleSurface> surface, bool add = true);

/// Two or three joint sets, 6 to 15 m apart, and now and then a few discs.
void add_joint_sets(Model& model, Draw& draw);

/// Two bodies on the two sides of a bumpy surface of triangles, and the body of both. Turned by an odd angle and rounded.
struct TwoBodies {
  std::shared_ptr<const TriangleSurface> lower, upper, both;
};
/// Corners of `upper` on the shared surface are off by up to `noise`, m.
TwoBodies bodies_that_share_faces(Draw& draw, Real noise);

/// A surface of m × m squares of two triangles over [−edge/4, 5/4 edge]², of which the corners inside include the square's own
/// boundary: it cuts the cube [0, edge]³ in two.
struct BumpySurface {
  std::shared_ptr<const TriangleSurface> surface;
  long double volume_below = 0;  ///< m³, in the cube
};
BumpySurface bumpy_surface(Draw& draw, Real edge, Real bumps);
/// m × m squares of two triangles each on a tilted plane through the middle of a cube of edge `edge` about the origin, beyond its
/// faces: coordinates as single precision rounds them, as in most files of triangles.
std::shared_ptr<TriangleSurface> planar_surface_in_floats(Draw& draw, Real edge);

}  // namespace rockfold::test
