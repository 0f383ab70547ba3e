// The pressure of water in a joint whose edges drain in part, and its force on a face.
//
// With the depth d below the level (γ d is the hydrostatic pressure), the pressure at a point of the face is
//
//     p = min(γ d, e)        no less than zero
//
// where e is the least concave function over the outline's hull that is no less than these values:
//
//   * at a corner that drains, what a pond before it presses with (none: 0); at one that does not, γ d;
//   * on an edge that does not drain, γ d₁/2 where the depth is half of what it is at the edge's deeper end, d₁; if the edge is wet up
//     to an upper end that drains, half way up it;
//   * of a face that drains all round, γ d₁/2 at the middle of its wet part, d₁ the depth of its lowest corner.
//
// e is the upper side of the convex hull of these values as points over the plane, linear in pieces: so is p, and integrals are exact.
// A plane that daylights at both ends thus has the tent of Hoek & Bray (1981), U = γ H²/(4 sin ψ); a wedge that daylights in a face
// and the ground behind it the pyramid whose apex is γ H/2 half way up the line of intersection, γ H/6 in the mean. Law `drained`
// leaves the values inside edges out that do not drain at both ends: a plane below a tension crack then has the triangle from
// γ z_w at the crack's foot to zero where it daylights, U = γ z_w A/2 (Wyllie & Mah 2004).
// All values rise with the level, and so does p everywhere.
#pragma once

#include <vector>

#include "host/keyblock/face_shape.hpp"
#include "host/keyblock/water/outline.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Linear functions whose least is the pressure, Pa: the hydrostatic one first. Cost: some c³ for c corners.
std::vector<LinearPressure> joint_pressures(const Water& water, const Vec3& gravity,
                                            const JointOutline& outline);

/// ∫ p dA and ∫ p x dA over a face given by its loops, the outer one first; p is the least of `pressures`, no less than zero. Exact.
PressureForce least_pressure_force(const std::vector<std::vector<Vec3>>& loops, const Vec3& normal,
                                   const std::vector<LinearPressure>& pressures);

}  // namespace rockfold
