// The closed bodies that one mesh file holds.
#pragma once

#include <string>
#include <vector>

#include "host/files/meshes/polygon_soup.hpp"

namespace rockfold {

struct SoupBody {
  std::string
      name;  ///< as the file's objects are called, or its groups where these tell more apart; empty: it has none
  PolygonSoup soup;
};

/// Polygons that share vertices, of one object ("o") where the file has objects, are one surface; so are those of equal coordinates
/// where `by_place` (STL, whose triangles have vertices of their own). A surface that is inside out is a cavity of the smallest one around
/// it. In the order of the file. Nothing is checked: check_solid says what is no body.
std::vector<SoupBody> separate_bodies(const PolygonSoup& soup, bool by_place);

}  // namespace rockfold
