// The rock mass rating of 1989. Z. T. Bieniawski, Engineering Rock Mass Classifications (Wiley, 1989);
// docs/support_design.md, "RMR89".
#pragma once

#include <array>

#include "src/base/types.hpp"
#include "src/model/classification_spec.hpp"

namespace rockfold {

// The ratings of the tables; a value on a limit has the better rating.
Real strength_rating(Real uniaxial_strength);   ///< Pa
Real point_load_rating(Real point_load_index);  ///< Pa, ≥ 1 MPa
Real rqd_rating(Real rqd);                      ///< %
Real spacing_rating(Real spacing);              ///< m
/// Rows 0 … 4: very rough, slightly rough, highly weathered, slickensided or thin gouge, soft gouge over 5 mm.
Real condition_rating(Index row);
/// Rows 0 … 4: dry, damp, wet, dripping, flowing.
Real water_rating(Index row);
/// Rows 0 … 4: very favourable … very unfavourable. Slopes very unfavourable: −60, of the 1979 edition.
Real orientation_rating(Index row, RmrUse use);

/// How favourable a joint's orientation is for a tunnel (Wickham et al. 1972; Bieniawski 1989, table 4.4): the row of
/// orientation_rating. `drive` is the azimuth in which the tunnel advances, deg.
Index tunnel_orientation(Real dip, Real dip_direction, Real drive);

/// 1 … 5: rating over 80, 60, 40, 20, and the rest.
int rmr_class(Real rmr);

/// What the class means (Bieniawski 1989, tables 4.1C and D): for an unsupported span.
struct StandUp {
  Real span = 0;  ///< m
  Real time = 0;  ///< s
  const char* text = "";
};
StandUp stand_up_time(int rmr_class);

/// Support of a tunnel 10 m wide, drill and blast, at a vertical stress below 25 MPa (Bieniawski 1989, table 4.5).
struct RmrSupport {
  std::array<Real, 2> bolt_length{};                         ///< m; 0 = none
  std::array<Real, 2> bolt_spacing{};                        ///< m; 0 = none
  std::array<Real, 2> shotcrete_crown{}, shotcrete_walls{};  ///< m; 0 = none
  Real shotcrete_face = 0;                                   ///< m
  Real rib_spacing = 0;                                      ///< m; 0 = none
  const char* excavation = "";
  const char* bolts = "";
};
RmrSupport rmr_support(int rmr_class);

/// Pa: (100 − RMR) / 100 γ B, the support pressure of Unal (1983); unit weight N/m³, span m.
Real unal_pressure(Real rmr, Real unit_weight, Real span);

/// 9 ln Q + 44 (Bieniawski 1976) and 15 log Q + 50 (Barton 1995).
Real rmr_from_q_bieniawski(Real q);
Real rmr_from_q_barton(Real q);

/// Pa: 10^((RMR − 10) / 40) GPa, the modulus of deformation of Serafim & Pereira (1983).
Real deformation_modulus(Real rmr);

}  // namespace rockfold
