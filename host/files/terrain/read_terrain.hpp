// Terrain files in memory: posts of a ground surface.
#pragma once

#include <string_view>

#include "src/model/model.hpp"

namespace rockfold {

/// ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize (or dx and
/// dy), NODATA_value (default −9999) in any order and case, then the values row by row from north to
/// south. Posts stand at the cells' centres.
/// `place` names the file and the key that names it. Throws Error(model) with all that is wrong.
TriangleSurface read_ascii_grid(std::string_view text, const Place& place);

/// Three numbers a line, separated by blanks, commas or semicolons; a heading and '#' comments are
/// passed over. Posts of a full grid are joined as such, others by Delaunay's triangulation. More columns are passed over
/// too: `warnings` says so, unless it is null.
TriangleSurface read_xyz(std::string_view text, const Place& place,
                         std::vector<Diagnostic>* warnings = nullptr);

/// Chooses between the two by the first word of the text.
TriangleSurface read_terrain(std::string_view text, const Place& place,
                             std::vector<Diagnostic>* warnings = nullptr);

/// Throws Error(model), with the lowest post, if the ground is not above `base` (m) everywhere.
void check_above(const TriangleSurface& ground, Real base, const Place& place);

/// Throws Error(model), with two posts, if neighbours are too near in plan beside the height above `base` (m), of which
/// the readers do not know.
void check_fine_posts(const TriangleSurface& ground, Real base, const Place& place);

}  // namespace rockfold
