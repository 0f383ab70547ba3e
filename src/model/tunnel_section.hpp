// Cross-sections of tunnels as polygons.
#pragma once

#include <array>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// m; counter-clockwise seen along the path, x to the right, y up. Points that mirror each other in
/// the section's vertical axis have exactly mirrored coordinates.
using Section = std::vector<std::array<Real, 2>>;

/// A regular polygon inscribed in the circle about (0, 0), one edge at the bottom, horizontal.
Section circle_section(Real radius, Index sides);

/// About the path, which runs along the middle of the floor.
Section rectangle_section(Real width, Real height);

/// Flat floor, vertical walls and a roof of half a circle over the whole width, whose arc has `sides`
/// equal chords; without walls if height = width / 2 (less is wrong).
Section d_shape_section(Real width, Real height, Index sides);

/// The roof as above; from its springing line the walls go on as arcs of radius `width`, each about
/// the opposite springing point (so that they continue the roof without a kink), down to a flat floor
/// that is narrower than the springing line. Chords of the walls are about as long as the roof's.
/// width / 2 <= height < horseshoe_height_limit(width). Standard is height = width.
Section horseshoe_section(Real width, Real height, Index sides);

/// The height at which the walls of a horseshoe would meet: (1 + √3) / 2 of its width.
Real horseshoe_height_limit(Real width);

}  // namespace rockfold
