// Terrain files in memory: posts of a ground surface.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

/// ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize (or dx and
/// dy), NODATA_value (default −9999) in any order and case, then the values row by row from north to
/// south. Posts stand at the cells' centres.
/// `place` names the file and the key that names it. Throws Error(model) with all that is wrong.
TriangleSurface read_ascii_grid(std::string_view text, const Place& place);

/// A post a line, columns separated by blanks, commas or semicolons. Without a heading x, y and z stand first. A heading, which may stand
/// behind "//" or '#', names the columns in any order (columns.hpp); a row of units and CloudCompare's count of the posts may follow.
/// `columns`, unless it is empty, says what the columns are, whatever the file says. Comments behind '#' are passed over, and so are
/// other columns: `warnings` says so, unless it is null. A heading that names no x, y and z, and a first column that numbers the
/// posts, are refused. Posts of a full grid are joined as such, others by Delaunay's triangulation.
TriangleSurface read_xyz(std::string_view text, const Place& place,
                         std::vector<Diagnostic>* warnings = nullptr,
                         const std::vector<std::string>& columns = {});

/// Why `columns` cannot say where x, y and z are; "" if it can, or is empty.
std::string columns_fault(const std::vector<std::string>& columns);

/// Chooses between the two by the first word of the text.
TriangleSurface read_terrain(std::string_view text, const Place& place,
                             std::vector<Diagnostic>* warnings = nullptr,
                             const std::vector<std::string>& columns = {});

/// Throws Error(model), with the lowest post, if the ground is not above `base` (m) everywhere.
void check_above(const TriangleSurface& ground, Real base, const Place& place);

/// Throws Error(model), with two posts, if neighbours are too near in plan beside the height above `base` (m), of which
/// the readers do not know.
void check_fine_posts(const TriangleSurface& ground, Real base, const Place& place);

}  // namespace rockfold
