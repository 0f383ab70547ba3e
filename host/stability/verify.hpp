// The check of a certificate: by sums in rational arithmetic, from its own numbers alone. It shares nothing with the code that finds
// certificates; points of contacts are derived anew.
#pragma once

#include "host/stability/certificate.hpp"

namespace rockfold {

/// Whether a certificate proves its factors. Never fails, whatever stands in it.
///
/// - Its areas are plane, convex and across their normals, and all numbers are finite.
/// - `below`: the forces on each body and its load cancel to 1e-9 of the sum of their sizes (and to 1e-6 of its load with 1e-12 of all
///   loads, so that large forces which press on each other hide no load), and break no strength, to 1e-12 of each.
/// - `above`: slips dilate by their friction to 1e-7 of the fastest, and the loads do more work than the strength can take up, by more
///   than those 1e-7 could hide.
/// - `below` is not over `above`.
/// - A state of sliding, where there is one: its forces balance and break no strength, no area overlaps by more than 1e-6 of the fastest
///   slip, and its forces do all the work on its slips that the strength can, to 1e-3 of the power of the loads.
///
/// Doubles are taken as they are, roots are rounded to the safe side.
Verdict verify(const Certificate& certificate);

/// Of the same, the state of sliding alone; its sizes are those of the mass.
Verdict verify_sliding(const RigidMass& mass, const Balance& balance, const Mechanism& mechanism);

}  // namespace rockfold
