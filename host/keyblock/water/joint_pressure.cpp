#include "host/keyblock/water/joint_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "host/keyblock/water/water.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Triangles with less area than this share of the square of the outline's size have no plane of their own: three points of one edge.
/// Corners are off the straight by 10⁻⁹, 1000 times as much.
constexpr Real least_area = 1e-12;

/// Values that differ by less than this share of the largest are the rounding of corners.
constexpr Real value_rounding = 1e-9;

/// What e is at least, at a point: from the outline's first corner, so that points of an edge lie on it to the last digits wherever
/// the outline is.
struct LeastValue {
  Vec3 at;
  Real value;  ///< Pa
};

Real depth_pressure(const LinearPressure& p, const Vec3& x) {
  return std::max(0.0, p.unclipped(x));
}

/// The part of a convex polygon where f ≥ 0 (`sign` 1), or the rest of it (−1). Values up to `rounding` count as 0: the signs of rounding
/// errors belong to no line across the polygon.
std::vector<Vec3> side_of(const std::vector<Vec3>& polygon, const LinearPressure& f, Real sign,
                          Real rounding) {
  const auto value = [&](const Vec3& x) {
    const Real v = f.unclipped(x);
    return std::abs(v) <= rounding ? 0 : v;
  };
  std::vector<Vec3> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Real fa = value(a), fb = value(b);
    if ((fa >= 0) == (sign > 0)) part.push_back(a);
    if ((fa >= 0) != (fb >= 0)) part.push_back(a + (fa / (fa - fb)) * (b - a));
  }
  return part;
}

/// Area, and its first moment, of the part of a convex polygon where f ≥ 0.
PressureForce area_where_positive(const std::vector<Vec3>& polygon, const Vec3& normal,
                                  const LinearPressure& f) {
  return pressure_on_polygon(side_of(polygon, f, 1, 0), normal, {.at_origin = 1, .gradient = {}});
}

void add(PressureForce& sum, const PressureForce& part) {
  sum.force += part.force;
  sum.first_moment += part.first_moment;
}

/// The values that a face's water has at least.
class LeastValues {
 public:
  LeastValues(const Water& water, const LinearPressure& hydrostatic, const JointOutline& outline)
      : hydrostatic_(hydrostatic),
        outline_(outline.corners),
        first_(outline.corners.front().at),
        needs_both_ends_(law_of(water) == WaterLaw::drained),
        peak_(std::holds_alternative<WaterPressure>(water.level) ? 1 : 0.5) {
    for (const DrainedCorner& corner : outline_) add_corner(corner);
    for (std::size_t i = 0; i < outline_.size(); ++i) add_edge(i);
    add_middle(outline.normal);
  }

  const std::vector<LeastValue>& values() const { return values_; }

 private:
  void add_corner(const DrainedCorner& corner) {
    const Real full = depth_pressure(hydrostatic_, corner.at);
    values_.push_back({corner.at - first_,
                       (1 - corner.share) * full + corner.share * std::min(full, corner.pond)});
  }

  /// Of the edge from corner i: the peak between its ends.
  void add_edge(std::size_t i) {
    const DrainedCorner *deep = &outline_[i], *high = &outline_[(i + 1) % outline_.size()];
    const Real held = 1 - deep->edge_share;
    Real below = hydrostatic_.unclipped(deep->at), above = hydrostatic_.unclipped(high->at);
    if (below < above) {
      std::swap(deep, high);
      std::swap(below, above);
    }
    if (!(held > 0 && below > 0)) return;
    const Real weight = held * (needs_both_ends_ ? deep->share * high->share : 1);
    const Vec3 from = deep->at - first_, along = (high->at - first_) - from;
    if (above > 0)  // wet to its upper end, which lets water out
      values_.push_back({from + 0.5 * along, weight * high->share * peak_ * below});
    if (above <= 0.5 * below)
      values_.push_back({from + (0.5 * below / (below - above)) * along,
                         weight * (above > 0 ? 1 - high->share : 1) * 0.5 * below});
  }

  /// Of a face that drains all round: the peak in the middle of its wet part.
  void add_middle(const Vec3& normal) {
    Real drained = 1, deepest = 0;
    for (const DrainedCorner& corner : outline_) {
      drained = std::min(drained, corner.edge_share);
      deepest = std::max(deepest, hydrostatic_.unclipped(corner.at));
    }
    if (!(drained > 0 && deepest > 0)) return;
    std::vector<Vec3> corners;
    for (const DrainedCorner& corner : outline_) corners.push_back(corner.at);
    const Vec3 middle = wet_middle(corners, normal);
    values_.push_back({middle - first_,
                       drained * std::min(depth_pressure(hydrostatic_, middle), peak_ * deepest)});
  }

  Vec3 wet_middle(const std::vector<Vec3>& corners, const Vec3& normal) const {
    PressureForce wet;
    for (std::size_t k = 2; k < corners.size(); ++k)
      add(wet, area_where_positive({corners[0], corners[k - 1], corners[k]}, normal, hydrostatic_));
    return wet.force > 0 ? (1 / wet.force) * wet.first_moment : corners[0];
  }

  LinearPressure hydrostatic_;
  const DrainedLoop& outline_;
  Vec3 first_;
  bool needs_both_ends_;
  Real peak_;  ///< of the pressure at the deeper end; of a constant pressure all of it
  std::vector<LeastValue> values_;
};

/// The linear function in a plane with these values at three points, if they span one.
std::optional<LinearPressure> plane_through(const LeastValue& a, const LeastValue& b,
                                            const LeastValue& c, Real smallest) {
  const Vec3 e = b.at - a.at, f = c.at - a.at, n = cross(e, f);  // twice the triangle's area
  if (!(norm(n) > smallest)) return {};
  const Real along_e = b.value - a.value, along_f = c.value - a.value;
  const Vec3 gradient = (1 / dot(n, n)) * (along_e * cross(f, n) + along_f * cross(n, e));
  return LinearPressure{.at_origin = a.value - dot(gradient, a.at), .gradient = gradient};
}

/// The pieces of the least concave function above the values: planes through three that no other is above.
std::vector<LinearPressure> concave_pieces(const std::vector<LeastValue>& values) {
  Real size = 0, largest = 0;
  for (const LeastValue& v : values) {
    size = std::max(size, norm(v.at - values[0].at));
    largest = std::max(largest, v.value);
  }
  const Real rounding = value_rounding * largest;
  std::vector<LinearPressure> pieces;
  const auto is_new = [&](const LinearPressure& piece) {
    return std::none_of(pieces.begin(), pieces.end(), [&](const LinearPressure& known) {
      return std::all_of(values.begin(), values.end(), [&](const LeastValue& v) {
        return std::abs(known.unclipped(v.at) - piece.unclipped(v.at)) <= rounding;
      });
    });
  };
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = i + 1; j < values.size(); ++j)
      for (std::size_t k = j + 1; k < values.size(); ++k) {
        const auto piece = plane_through(values[i], values[j], values[k], least_area * size * size);
        if (!piece) continue;
        const bool above = std::all_of(values.begin(), values.end(), [&](const LeastValue& v) {
          return piece->unclipped(v.at) >= v.value - rounding;
        });
        if (above && is_new(*piece)) pieces.push_back(*piece);
      }
  return pieces;
}

LinearPressure difference(const LinearPressure& a, const LinearPressure& b) {
  return {.at_origin = a.at_origin - b.at_origin, .gradient = a.gradient - b.gradient};
}

/// The integrals over convex parts of a face.
class LeastPressure {
 public:
  LeastPressure(const std::vector<LinearPressure>& pressures, const Vec3& normal,
                const std::vector<Vec3>& corners)
      : pressures_(pressures), normal_(normal) {
    for (const Vec3& x : corners)
      rounding_ = std::max(rounding_, value_rounding * std::abs(pressures[0].unclipped(x)));
  }

  void add_part(const std::vector<Vec3>& part) { add_part(part, 0, 1); }
  const PressureForce& sum() const { return sum_; }

 private:
  /// On the part `pressures[least]` is the least of those before `next`. Each of the others parts what is left in two, so that no area
  /// is taken twice or not at all.
  void add_part(const std::vector<Vec3>& part, std::size_t least, std::size_t next) {
    if (part.size() < 3) return;
    if (next == pressures_.size()) {
      add(sum_, pressure_on_polygon(part, normal_, pressures_[least]));
      return;
    }
    const LinearPressure more = difference(pressures_[next], pressures_[least]);
    add_part(side_of(part, more, 1, rounding_), least, next + 1);
    add_part(side_of(part, more, -1, rounding_), next, next + 1);
  }

  const std::vector<LinearPressure>& pressures_;
  Vec3 normal_;
  Real rounding_ = 0;  ///< Pa
  PressureForce sum_;
};

bool drains(const DrainedLoop& outline) {
  return std::any_of(outline.begin(), outline.end(), [](const DrainedCorner& corner) {
    return corner.share > 0 || corner.edge_share > 0;
  });
}

}  // namespace

std::vector<LinearPressure> joint_pressures(const Water& water, const Vec3& gravity,
                                            const JointOutline& outline) {
  std::vector<LinearPressure> pressures{linear_pressure(water, gravity)};
  if (!is_drained(water) || !drains(outline.corners)) return pressures;
  const LeastValues values(water, pressures[0], outline);
  const Vec3& first = outline.corners.front().at;
  for (const LinearPressure& p : concave_pieces(values.values()))
    pressures.push_back(
        {.at_origin = p.at_origin - dot(p.gradient, first), .gradient = p.gradient});
  return pressures;
}

PressureForce least_pressure_force(const std::vector<std::vector<Vec3>>& loops, const Vec3& normal,
                                   const std::vector<LinearPressure>& pressures) {
  if (loops.empty() || loops[0].empty()) return {};
  const Vec3& apex = loops[0][0];
  LeastPressure least(pressures, normal, loops[0]);
  for (const auto& loop : loops)
    for (std::size_t c = 0; c < loop.size(); ++c)
      least.add_part({apex, loop[c], loop[(c + 1) % loop.size()]});
  return least.sum();
}

}  // namespace rockfold
