#include "host/classification/q_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rockfold {
namespace {

constexpr Real kilogram_per_square_centimetre = 98066.5;  // Pa

}  // namespace

Real q_value(const QParameters& p) {
  return std::max(p.rqd, Real{10}) / p.jn * (p.jr / p.ja) * (p.jw / p.srf);
}

const char* q_class(Real q) {
  struct Class {
    Real below;
    const char* name;
  };
  constexpr std::array<Class, 8> classes{{{0.01, "exceptionally_poor"},
                                          {0.1, "extremely_poor"},
                                          {1, "very_poor"},
                                          {4, "poor"},
                                          {10, "fair"},
                                          {40, "good"},
                                          {100, "very_good"},
                                          {400, "extremely_good"}}};
  for (const Class& c : classes)
    if (q < c.below) return c.name;
  return "exceptionally_good";
}

Real unsupported_span(Real q, Real esr) {
  return 2 * esr * std::pow(q, 0.4);
}

Real q_bolt_length(Real extent, Real esr) {
  return 2 + 0.15 * extent / esr;
}

Real q_roof_pressure(const QParameters& p) {
  return 2 * std::sqrt(p.jn) / (3 * p.jr) / std::cbrt(q_value(p)) * kilogram_per_square_centimetre;
}

Real q_roof_pressure_simple(const QParameters& p) {
  return 2 / p.jr / std::cbrt(q_value(p)) * kilogram_per_square_centimetre;
}

Real joint_set_number(Index sets, bool random_joints) {
  switch (sets) {
    case 0:
      return 1;
    case 1:
      return random_joints ? 3 : 2;
    case 2:
      return random_joints ? 6 : 4;
    case 3:
      return random_joints ? 12 : 9;
    default:
      return 15;
  }
}

}  // namespace rockfold
