// A kind of bolt as an element of an analysis.
#pragma once

#include "src/arrays/bolt_arrays.hpp"
#include "src/model/bolting_spec.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// m: that of the section, or that which bears the capacity at 500 MPa, as reinforcing steel does.
Real diameter_of(const BoltType& type);

/// What stands for what is not given: steel of 200 GPa; a section of `diameter_of`; yield at the capacity; a bond that makes a long
/// bolt as stiff across a joint as `stiffness`: √(k EA)/2, two lengths of bar in a bond in series (Farmer, Int. J. Rock Mech. Min. Sci. 12, 1975,
/// 347). Of a bolt held at its ends alone, EA is that which makes all of it as stiff as `stiffness`; its anchor then does not give. Active
/// ones are tensioned to their capacity.
BoltLaw bolt_law(const BoltType& type, Real length);

/// A bolt across a joint as a beam in rock of this material on either side, bent like an S.
struct Dowel {
  Real stiffness = 0;  ///< N/m across
  Real length = 0;     ///< m between the hinges, where it bends most
};
/// A beam on an elastic foundation (Hetényi 1946) of the modulus K = 0.65 (E d⁴/E_s I)^(1/12) E/(1 − ν²) that Vesić (1961) has: with β⁴ = K/(4 E_s I)
/// each half gives way by 2Qβ/K, and bends most at π/(4β).
Dowel dowel_of(const BoltType& type, const Material& rock);

}  // namespace rockfold
