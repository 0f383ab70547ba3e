// The Q-system of rock mass classification. N. Barton, R. Lien & J. Lunde, "Engineering classification of rock masses for
// the design of tunnel support", Rock Mechanics 6 (1974); docs/support_design.md, "Q-system".
#pragma once

#include "src/base/types.hpp"

namespace rockfold {

struct QParameters {
  Real rqd = 100;  ///< %
  Real jn = 1, jr = 1, ja = 1, jw = 1, srf = 1;
};

/// Q = (RQD / Jn) (Jr / Ja) (Jw / SRF). An RQD below 10 % counts as 10 %.
Real q_value(const QParameters& p);

/// "exceptionally_poor" … "exceptionally_good": the nine classes of the 1974 paper, limits 0.01, 0.1, 1, 4, 10, 40, 100, 400.
const char* q_class(Real q);

/// 3 Jn at intersections, 2 Jn at portals are the caller's: these take Jn as it is.
/// m: the widest opening that needs no support, 2 ESR Q^0.4 (Barton et al. 1974).
Real unsupported_span(Real q, Real esr);

/// m: length of bolts in the roof, 2 + 0.15 B / ESR, with the span B; of bolts in the walls with their height.
Real q_bolt_length(Real extent, Real esr);

/// Pa: pressure on permanent support of the roof, 2 √Jn Q^(−1/3) / (3 Jr) kg/cm². With fewer than three joint sets; for three
/// and more it is nearly 2 / Jr Q^(−1/3) kg/cm², see q_roof_pressure_simple.
Real q_roof_pressure(const QParameters& p);
Real q_roof_pressure_simple(const QParameters& p);

/// Joint set number for so many sets (0 … ), with random joints or without (Barton et al. 1974, table 2). 0 sets: 1, the
/// upper end of "massive, no or few joints"; 1: 2 or 3; 2: 4 or 6; 3: 9 or 12; 4 and more: 15.
Real joint_set_number(Index sets, bool random_joints);

}  // namespace rockfold
