// What a ShapeGeometry encloses, measured apart from the code that made it.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/shapes/shape_geometry_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

struct Measured {
  Real volume = 0;             // m³
  Real overlap = 0;            // m³, of two parts, summed over pairs
  std::map<Index, Real> area;  // m², by face; none = between parts, counted on both sides
  Vec3 boundary{};  // Σ area · outward normal of all faces but none: 0 for what is closed
  int empty_parts = 0;
};

/// Each part is clipped out of a cube by its half-spaces; planes that coincide to 1e-10 are one, as for the cutter.
Measured measure_parts(const ShapeGeometry& geometry);

/// Polygons are triangulated about their first corner.
Measured measure_surface(const ClosedSurface& surface);

/// The directed edges that have no opposite one.
std::size_t open_edges(const ClosedSurface& surface);

/// No polygon of the surface has corners off the plane of its first three, or turns inward, beyond `tolerance` (m).
bool polygons_are_convex(const ClosedSurface& surface, Real tolerance);

/// The message of the Error that shape_geometry throws, "" if it throws none.
inline std::string refusal(const Shape& shape, bool bounded = true) {
  try {
    shape_geometry(shape, bounded, {"model.toml", 3, 1, "solid[1]"});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::model);
    EXPECT_EQ(error.diagnostics().front().place.key, "solid[1]");
    return error.what();
  }
  return "";
}

inline ShapeGeometry geometry_of(const Shape& shape) {
  return shape_geometry(shape, true, {"model.toml", 3, 1, "solid[1]"});
}

inline bool on_exactly(const ExactPlane& plane, const Vec3& p) {
  return dot(plane.n, exact(p)) == plane.d;
}

}  // namespace rockfold::test
