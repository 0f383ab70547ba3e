#include "host/classification/rmr.hpp"

#include <array>
#include <cmath>
#include <span>

namespace rockfold {
namespace {

/// A row of a table: the rating of values from `from` on.
struct Row {
  Real from;
  Real rating;
};

/// What is measured or converted from other units may miss a boundary by its last digits.
constexpr Real rounding = 1e-9;

Real rating_of(Real value, std::span<const Row> rows) {
  for (const Row& row : rows)
    if (value >= (1 - rounding) * row.from) return row.rating;
  return rows.back().rating;
}

/// A table whose first row reads "> from", beyond what rounding may add.
Real rating_above_or(Real first, Real above, Real value, std::span<const Row> rows) {
  return value > (1 + rounding) * above ? first : rating_of(value, rows);
}

constexpr Real hour = 3600, day = 24 * hour, year = 365.25 * day;  // s

}  // namespace

Real strength_rating(Real uniaxial_strength) {
  constexpr std::array<Row, 6> rows{
      {{100e6, 12}, {50e6, 7}, {25e6, 4}, {5e6, 2}, {1e6, 1}, {0, 0}}};
  return rating_above_or(15, 250e6, uniaxial_strength, rows);
}

Real point_load_rating(Real point_load_index) {
  constexpr std::array<Row, 3> rows{{{4e6, 12}, {2e6, 7}, {1e6, 4}}};
  return rating_above_or(15, 10e6, point_load_index, rows);
}

Real rqd_rating(Real rqd) {
  constexpr std::array<Row, 5> rows{{{90, 20}, {75, 17}, {50, 13}, {25, 8}, {0, 3}}};
  return rating_of(rqd, rows);
}

Real spacing_rating(Real spacing) {
  constexpr std::array<Row, 4> rows{{{0.6, 15}, {0.2, 10}, {0.06, 8}, {0, 5}}};
  return rating_above_or(20, 2, spacing, rows);
}

Real condition_rating(Index row) {
  constexpr std::array<Real, 5> ratings{30, 25, 20, 10, 0};
  return ratings.at(static_cast<std::size_t>(row));
}

Real water_rating(Index row) {
  constexpr std::array<Real, 5> ratings{15, 10, 7, 4, 0};
  return ratings.at(static_cast<std::size_t>(row));
}

Real orientation_rating(Index row, RmrUse use) {
  constexpr std::array<std::array<Real, 5>, 3> ratings{
      {{0, -2, -5, -10, -12}, {0, -2, -7, -15, -25}, {0, -5, -25, -50, -60}}};
  return ratings.at(static_cast<std::size_t>(use)).at(static_cast<std::size_t>(row));
}

Index tunnel_orientation(Real dip, Real dip_direction, Real drive) {
  constexpr Index very_favourable = 0, favourable = 1, fair = 2, unfavourable = 3,
                  very_unfavourable = 4;
  constexpr Real gentle = 20, steep = 45;  // deg
  if (dip < gentle) return fair;           // whatever the strike
  // 0: the joint dips along the drive, 180: against it, 90: it strikes along the tunnel.
  Real turn = std::fmod(std::abs(dip_direction - drive), 360.0);
  if (turn > 180) turn = 360 - turn;
  const bool strikes_along = turn > 45 && turn < 135;
  if (strikes_along) return dip >= steep ? very_unfavourable : fair;
  if (turn <= 45) return dip >= steep ? very_favourable : favourable;
  return dip >= steep ? fair : unfavourable;
}

int rmr_class(Real rmr) {
  if (rmr > 80) return 1;
  if (rmr > 60) return 2;
  if (rmr > 40) return 3;
  return rmr > 20 ? 4 : 5;
}

StandUp stand_up_time(int rmr_class) {
  constexpr std::array<StandUp, 5> times{{{15, 20 * year, "20 years for 15 m span"},
                                          {10, year, "1 year for 10 m span"},
                                          {5, 7 * day, "1 week for 5 m span"},
                                          {2.5, 10 * hour, "10 hours for 2.5 m span"},
                                          {1, hour / 2, "30 minutes for 1 m span"}}};
  return times.at(static_cast<std::size_t>(rmr_class - 1));
}

RmrSupport rmr_support(int rmr_class) {
  switch (rmr_class) {
    case 1:
      return {.excavation = "full face, 3 m advance", .bolts = "none but occasional spot bolts"};
    case 2:
      return {.bolt_length = {3, 3},
              .bolt_spacing = {2.5, 2.5},
              .shotcrete_crown = {0.05, 0.05},
              .excavation = "full face, 1 to 1.5 m advance, complete support 20 m from the face",
              .bolts = "locally in the crown, with occasional mesh"};
    case 3:
      return {.bolt_length = {4, 4},
              .bolt_spacing = {1.5, 2},
              .shotcrete_crown = {0.05, 0.1},
              .shotcrete_walls = {0.03, 0.03},
              .excavation =
                  "top heading and bench, 1.5 to 3 m advance in the heading, support "
                  "after each blast, complete 10 m from the face",
              .bolts = "systematic in crown and walls, with mesh in the crown"};
    case 4:
      return {.bolt_length = {4, 5},
              .bolt_spacing = {1, 1.5},
              .shotcrete_crown = {0.1, 0.15},
              .shotcrete_walls = {0.1, 0.1},
              .rib_spacing = 1.5,
              .excavation =
                  "top heading and bench, 1 to 1.5 m advance in the heading, support "
                  "10 m from the face while excavating",
              .bolts = "systematic in crown and walls, with mesh"};
    default:
      return {.bolt_length = {5, 6},
              .bolt_spacing = {1, 1.5},
              .shotcrete_crown = {0.15, 0.2},
              .shotcrete_walls = {0.15, 0.15},
              .shotcrete_face = 0.05,
              .rib_spacing = 0.75,
              .excavation =
                  "multiple drifts, 0.5 to 1.5 m advance in the heading, support while "
                  "excavating, shotcrete at once",
              .bolts = "systematic in crown and walls, with mesh; bolt the invert"};
  }
}

Real unal_pressure(Real rmr, Real unit_weight, Real span) {
  return (100 - rmr) / 100 * unit_weight * span;
}

Real rmr_from_q_bieniawski(Real q) {
  return 9 * std::log(q) + 44;
}

Real rmr_from_q_barton(Real q) {
  return 15 * std::log10(q) + 50;
}

Real deformation_modulus(Real rmr) {
  return std::pow(10.0, (rmr - 10) / 40) * 1e9;
}

}  // namespace rockfold
