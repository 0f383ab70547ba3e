// Certificates made by hand, of masses whose factors are known.
#pragma once

#include "host/stability/certificate.hpp"

namespace rockfold::test {

/// A block of 1 m³ and 27 kN on a plane of dip 30° that falls to −x, tan φ 0.7. Factor: 0.7 / tan 30°.
Certificate block_on_plane();

/// The same block on a bond of 5 kPa that bears 2 kPa of tension too. Factor: (0.7 W cos 30° + 5 kPa·1 m²) / (W sin 30°).
Certificate bonded_block();

/// A block of 1 m³ and 27 kN that a bond of 40 kPa of tensile strength holds to the roof. Factor: 40 / 27.
Certificate hanging_block();

/// Two slabs of 1 m × 1 m × 0.5 m on that plane, tan φ 0.7 below and 0.9 between them: both go together. Factor as of the first.
Certificate two_slabs();

/// Relative distance of the bounds from the factor.
constexpr Real gap = 1e-8;

/// The blocks on the plane go down it and dilate by what is left of 0.7 at that factor.
Mechanism slips_at(const Certificate& certificate, Real factor);

/// Of those on the plane.
Real known_factor(const Certificate& certificate);

}  // namespace rockfold::test
