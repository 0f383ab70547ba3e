// What the readers of mesh files hand on: polygons as they stand in the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/files/faults.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Example: one square is 4 vertices, corner_begin = {0, 4}, corner = {0, 1, 2, 3}.
struct PolygonSoup {
  std::vector<Vec3> vertices;          ///< m, finite, at most 1e9 in size
  std::vector<Index> corner_begin{0};  ///< [polygons + 1]
  std::vector<Index> corner;           ///< into vertices; 3+ a polygon
  std::vector<int> line;               ///< [polygons] of the file; 0 in binary files
  bool single_precision = false;       ///< coordinates were floats, not decimals or doubles
  /// What the file calls its parts: of polygons from `first` on.
  struct Label {
    Index first = 0;
    Index object = 0;  ///< how many objects ("o") begin before it
    std::string object_name = {}, group_name = {};
  };
  std::vector<Label> labels = {};  ///< by `first`

  Index polygon_count() const { return static_cast<Index>(line.size()); }
};

/// Each of these is strict: it throws Error(model) with all faults of the file (see Faults), never
/// allocates more than a small multiple of the text, and reads nothing twice. (CGAL's own readers
/// answer with a bare "false", without a line, allocate what a header claims, stop silently at
/// words they do not know, and those of OFF and OBJ read outside their arrays on wrong files.)
PolygonSoup read_obj(std::string_view text, Faults& faults);
PolygonSoup read_off(std::string_view text, Faults& faults);
PolygonSoup read_stl(std::string_view bytes, Faults& faults);
PolygonSoup read_ply(std::string_view bytes, Faults& faults);

/// Ends the polygon whose corners have been appended to soup.corner: fails if it has fewer than 3
/// (then its corners are taken away again).
void end_polygon(PolygonSoup& soup, int line, Faults& faults);

/// Fails where vertices or corners are more than Index can count.
void check_size(const PolygonSoup& soup, Faults& faults);

}  // namespace rockfold
