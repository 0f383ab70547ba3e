// What data files may hold and is hardly meant.
#pragma once

#include <optional>

#include "host/files/meshes/polygon_soup.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Of a mesh that was stored in single precision: where numbers as large as its coordinates are so far apart that its
/// triangles are others than those that were written. `place` names the file and the key that names it.
std::optional<Diagnostic> coarse_coordinates(const TriangleSurface& mesh, bool is_solid,
                                             const Place& place);

/// Of a ground above `base` (m) whose x and y are longitude and latitude in degrees: a metre high is then 1e-5 wide.
std::optional<Diagnostic> geographic_coordinates(const TriangleSurface& ground, Real base,
                                                 const Place& place);

}  // namespace rockfold
