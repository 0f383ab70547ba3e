#include "host/cover/points/held_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "host/cover/points/triangle_rule.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

constexpr Real patch_width = 2.5;  // spacings
constexpr Real least_share = 0.4;  // of a patch's area: smaller ones join their neighbours
// A polynomial that differs less than this from those of lower degree, in the mean over a patch, says nothing new there: [degree]
constexpr Real least_residual[] = {0, 2e-2, 2e-3, 5e-4};
constexpr Real narrow = 0.1;     // spacings: strips of less may need functions of their own
constexpr Real rounding = 1e-9;  // spacings: no nearer are places told apart

using Points = std::vector<SurfacePoint>;

/// Exponents of the monomials in x, y, z up to a degree, by degree.
std::vector<std::array<int, 3>> exponents(int degree) {
  std::vector<std::array<int, 3>> list;
  for (int d = 0; d <= degree; ++d)
    for (int i = d; i >= 0; --i)
      for (int j = d - i; j >= 0; --j) list.push_back({i, j, d - i - j});
  return list;
}

Real monomial(const Vec3& x, const std::array<int, 3>& exponent) {
  Real value = 1;
  for (int d = 0; d < 3; ++d)
    for (int i = 0; i < exponent[d]; ++i) value *= x[d];
  return value;
}

struct Extent {
  Vec3 centre{};
  Real area = 0;
};
Extent extent(const Points& points) {
  Extent e;
  for (const auto& p : points) e.centre += p.area * p.x, e.area += p.area;
  e.centre = (1 / e.area) * e.centre;
  return e;
}

/// m, of a ball about the centre that holds all points.
Real width(const Points& points) {
  const Vec3 centre = extent(points).centre;
  Real farthest = 0;
  for (const auto& p : points) farthest = std::max(farthest, norm(p.x - centre));
  return 2 * farthest;
}

/// Some direction across a unit vector.
Vec3 any_across(const Vec3& normal) {
  Vec3 axis{};
  int least = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) < std::abs(normal[least])) least = d;
  axis[least] = 1;
  return cross(normal, axis);
}

/// Principal axes of the points in their plane, the longer first, each as long as the points' root mean square along it.
std::array<Vec3, 2> principal_axes(const Points& points, const Vec3& centre, const Vec3& normal) {
  const Vec3 e = normalized(any_across(normal)), f = cross(normal, e);
  Real area = 0, ee = 0, ef = 0, ff = 0;
  for (const auto& p : points) {
    const Real x = dot(e, p.x - centre), y = dot(f, p.x - centre);
    area += p.area, ee += p.area * x * x, ef += p.area * x * y, ff += p.area * y * y;
  }
  const Real angle = 0.5 * std::atan2(2 * ef, ee - ff), c = std::cos(angle), s = std::sin(angle);
  const auto along = [&](Real a, Real b) {
    Real square = 0;
    const Vec3 axis = a * e + b * f;
    for (const auto& p : points) square += p.area * std::pow(dot(axis, p.x - centre), 2);
    return std::sqrt(square / area) * axis;
  };
  return {along(c, s), along(-s, c)};
}

/// A function by its values at points, 1 in the mean square over them.
struct Function {
  std::vector<Real> value;
  /// What a row of it counts times: 1, or what makes it the displacement at one spacing of a turn about a line that the points lie along.
  Real scale = 1;

  /// A share of the area, for a row times `scale` to store the same energy.
  Real area(Real all) const { return all / (scale * scale); }
  Real reach() const { return std::min<Real>(1, 1 / scale); }
};

/// Polynomials made orthonormal in the mean over points of a plane (Gram & Schmidt, twice); the first is 1. What the
/// points cannot tell apart (across their plane, along a line) is left out. In a strip that is narrow beside the spacing functions across it are
/// small, but those that are linear hold the rock against turning about the strip: up to the power `across` they count by what they are beside the
/// strip's width.
class OrthonormalFunctions {
 public:
  OrthonormalFunctions(const Points& points, Real spacing)
      : points_(points), spacing_(spacing), extent_(extent(points)) {}

  std::vector<Function> find(const Vec3& normal, int degree, int across) && {
    for (const auto& exponent : exponents(degree)) {
      std::vector<Real> value(points_.size());
      for (std::size_t n = 0; n < points_.size(); ++n)
        value[n] = monomial((1 / spacing_) * (points_[n].x - extent_.centre), exponent);
      add(std::move(value), least_residual[exponent[0] + exponent[1] + exponent[2]]);
    }
    if (degree > 0) add_across(normal, degree, across);
    return std::move(found_);
  }

 private:
  Real mean(const std::vector<Real>& a, const std::vector<Real>& b) const {
    Real sum = 0;
    for (std::size_t n = 0; n < points_.size(); ++n) sum += points_[n].area * a[n] * b[n];
    return sum / extent_.area;
  }

  /// `unit`: by which values of functions across a narrow strip are divided; 0: no such function.
  void add(std::vector<Real> value, Real least, Real unit = 0) {
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& known : found_) {
        const Real share = mean(known.value, value);
        for (std::size_t n = 0; n < value.size(); ++n) value[n] -= share * known.value[n];
      }
    const Real size = std::sqrt(mean(value, value));
    if (!(size > least)) return;
    for (Real& v : value) v /= size;
    found_.push_back({std::move(value), unit > 0 ? 1 / (size * unit) : 1});
  }

  /// Powers of the way across a narrow strip up to `across`, times powers of that along it.
  void add_across(const Vec3& normal, int degree, int across) {
    const auto axes = principal_axes(points_, extent_.centre, normal);
    const Real vague = rounding * spacing_ + 100 * std::numeric_limits<Real>::epsilon() *
                                                 norm(extent_.centre);  // of the points' places
    for (int d = 0; d < 2; ++d) {
      const Real width = norm(axes[d]), length = norm(axes[1 - d]);
      if (width > narrow * spacing_ || !(width > vague)) continue;
      const bool both = length <= narrow * spacing_;
      for (int q = 1; q <= across; ++q)
        for (int p = 0; p + q <= (both ? across : degree); ++p) {
          const Real unit = std::pow(width / spacing_, q) * std::pow(length / spacing_, p);
          if ((p + q > 1 && unit < rounding) || (p > 0 && length < width)) continue;
          std::vector<Real> value(points_.size());
          for (std::size_t n = 0; n < points_.size(); ++n) {
            const Vec3 x = points_[n].x - extent_.centre;
            value[n] = std::pow(dot(axes[d], x) / (width * width), q);
            if (p > 0) value[n] *= std::pow(dot(axes[1 - d], x) / (length * length), p);
          }
          add(std::move(value), least_residual[p + q], unit);
        }
    }
  }

  const Points& points_;
  const Real spacing_;
  const Extent extent_;
  std::vector<Function> found_;
};

/// The covers of an element with the weights of their nodes at x.
std::vector<std::pair<Index, Real>> node_weights(const CoverArrays& covers, Index element,
                                                 const Vec3& x) {
  const ElementNodes nodes = element_nodes(covers, element);
  const CellPart& part = covers.lattice.split(nodes.cell).part[nodes.part];
  const auto weight =
      part_weights(part, covers.lattice.to_local(x - covers.lattice.cell_centre(nodes.cell)));
  std::vector<std::pair<Index, Real>> found;
  for (int a = 0; a < part.nodes; ++a) found.emplace_back(nodes.cover[a], weight[a]);
  return found;
}

/// The rows of all polynomials up to a degree over the points. `unit`: m, in which polynomials
/// that differ too little from others are told.
void add_moments(const CoverArrays& covers, const Points& points, const Vec3& normal, Real unit,
                 int degree, std::vector<HeldRow>& rows) {
  MaterialPoints at;
  Real area = 0;
  for (const auto& p : points) {
    add_material_point(covers, p.x, p.element, at);
    area += p.area;
  }
  const auto functions = OrthonormalFunctions(points, unit).find(normal, degree, 1);
  for (const Function& function : functions) {
    std::map<Index, Real> weight;
    for (std::size_t n = 0; n < points.size(); ++n)
      for (Index i = at.begin[n]; i < at.begin[n + 1]; ++i)
        weight[at.unknown[i]] +=
            function.scale * points[n].area / area * function.value[n] * at.weight[i];
    HeldRow row{
        points[0].element, points[0].x, {}, {}, function.area(area), &function != functions.data(),
        function.reach()};
    for (const auto& [unknown, w] : weight) {
      row.unknown.push_back(unknown);
      row.weight.push_back(w);
    }
    rows.push_back(std::move(row));
  }
}

/// Points that integrate polynomials up to a degree over the surface.
Points surface_points(const std::vector<FacePolygon>& surface, int degree) {
  const auto rule = triangle_rule(degree);
  Points points;
  for (const FacePolygon& polygon : surface) {
    const auto& corner = polygon.corner;
    for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
      const Real area =
          0.5 * polygon.share * norm(cross(corner[k] - corner[0], corner[k + 1] - corner[0]));
      if (!(area > 0)) continue;
      for (const auto& [at, weight] : rule)
        points.push_back({polygon.element,
                          at[0] * corner[0] + at[1] * corner[k] + at[2] * corner[k + 1],
                          weight * area});
    }
  }
  return points;
}

/// Whether the node of a cover lies in the plane of a polygon.
bool in_plane(const CoverArrays& covers, Index cover, const FacePolygon& polygon, Real slack) {
  const Vec3 node = covers.lattice.node_position(covers.cover_node[cover]);
  return std::abs(dot(polygon.normal, node - polygon.corner[0])) <= slack;
}

/// Whether only covers whose nodes lie in its plane move the surface.
bool runs_through_nodes(const CoverArrays& covers, const std::vector<FacePolygon>& surface,
                        Real spacing, Real slack) {
  for (const FacePolygon& polygon : surface)
    for (const Vec3& x : polygon.corner)
      for (const auto& [cover, weight] : node_weights(covers, polygon.element, x))
        if (std::abs(weight) * spacing > slack && !in_plane(covers, cover, polygon, slack))
          return false;
  return true;
}

/// On nodes: what the functions of each cover are on the surface, as polynomials, is held by itself. With m the functions of
/// cover a and q_j orthonormal in the mean over its share of the area, which N_a weighs, row j is that mean of q_j Σ_k m_k d_ak.
/// All rows at rest, the surface is; and no fewer would do, but for displacements that the other covers bring about too.
/// `polygon`: one of the surface; `unit`: as of add_moments. However small the surface is in an element, all of its nodes there count.
void hold_covers(const CoverArrays& covers, const Points& points, const FacePolygon& polygon,
                 Real slack, Real unit, std::vector<HeldRow>& rows) {
  std::map<Index, Points> of_cover;
  std::map<Index, Real> most_weight;
  for (const auto& p : points)
    for (const auto& [cover, weight] : node_weights(covers, p.element, p.x))
      if (weight > 0 && in_plane(covers, cover, polygon, slack)) {
        of_cover[cover].push_back({p.element, p.x, weight * p.area});
        most_weight[cover] = std::max(most_weight[cover], weight);
      }
  for (const auto& [cover, share] : of_cover) {
    const Vec3 node = covers.lattice.node_position(covers.cover_node[cover]);
    Real area = 0;
    for (const auto& p : share) area += p.area;
    const auto held =
        OrthonormalFunctions(share, unit).find(polygon.normal, covers.order, covers.order);
    for (const Function& one : held) {
      HeldRow row{share[0].element,
                  share[0].x,
                  {},
                  {},
                  one.area(area),
                  &one != held.data(),
                  one.reach() * most_weight[cover]};
      row.weight.assign(covers.functions(), 0);
      for (int k = 0; k < covers.functions(); ++k)
        row.unknown.push_back(k * covers.cover_count() + cover);
      for (std::size_t n = 0; n < share.size(); ++n) {
        // In the node's plane, however far rounding has put the surface off it: functions across would else enter with next to
        // nothing, and those of the covers behind, whose sums with them move no rock, not at all.
        const Vec3 arm = share[n].x - node;
        const auto function = cover_functions(
            covers, cover,
            covers.lattice.to_local(arm - dot(arm, polygon.normal) * polygon.normal));
        for (int k = 0; k < covers.functions(); ++k)
          row.weight[k] += one.scale * share[n].area / area * one.value[n] * function[k];
      }
      rows.push_back(std::move(row));
    }
  }
}

using Polygons = std::vector<FacePolygon>;

/// The part of a convex polygon where axis · x lies between low and high.
std::vector<Vec3> strip_of(std::vector<Vec3> corner, const Vec3& axis, Real low, Real high) {
  for (const Real side : {1.0, -1.0}) {
    const Real bound = side > 0 ? low : -high;
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec3 &a = corner[k], &b = corner[(k + 1) % corner.size()];
      const Real of_a = side * dot(axis, a) - bound, of_b = side * dot(axis, b) - bound;
      if (of_a >= 0) kept.push_back(a);
      if ((of_a < 0) != (of_b < 0)) kept.push_back(a + (of_a / (of_a - of_b)) * (b - a));
    }
    corner = std::move(kept);
  }
  return corner;
}

/// Rectangles of nearly the same width that cover a plane surface, the first side along the projection of a lattice edge.
class PatchGrid {
 public:
  PatchGrid(const CoverArrays& covers, const Polygons& surface, Real width) {
    const Vec3& normal = surface[0].normal;
    for (const Vec3& edge : covers.lattice.edge) {
      const Vec3 across = edge - dot(edge, normal) * normal;
      if (norm(across) > norm(axis_[0])) axis_[0] = across;
    }
    axis_[0] = normalized(axis_[0]);
    axis_[1] = cross(normal, axis_[0]);
    for (int d = 0; d < 2; ++d) {
      const auto [low, high] = range(surface, d);
      low_[d] = low;
      count_[d] = std::max<Index>(1, static_cast<Index>(std::lround((high - low) / width)));
      step_[d] = (high - low) / count_[d];
    }
  }

  /// What of the surface lies in each. Polygons are cut at their sides, so that the rows do not depend on how the surface was divided.
  std::vector<Polygons> divide(const Polygons& surface) const {
    std::map<std::array<Index, 2>, Polygons> found;
    for (const FacePolygon& polygon : surface) {
      const auto [first, last] = places(polygon);
      for (Index i = first[0]; i <= last[0]; ++i)
        for (Index j = first[1]; j <= last[1]; ++j) {
          FacePolygon part = polygon;
          part.corner = strip_of(strip_of(polygon.corner, axis_[0], side(0, i), side(0, i + 1)),
                                 axis_[1], side(1, j), side(1, j + 1));
          if (part.corner.size() > 2) found[{i, j}].push_back(std::move(part));
        }
    }
    std::vector<Polygons> list;
    for (auto& [at, patch] : found) list.push_back(std::move(patch));
    return list;
  }

 private:
  std::array<Real, 2> range(const Polygons& surface, int d) const {
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (const FacePolygon& polygon : surface)
      for (const Vec3& x : polygon.corner) {
        low = std::min(low, dot(axis_[d], x));
        high = std::max(high, dot(axis_[d], x));
      }
    return {low, high};
  }

  /// Where a row of patches begins; the first and the last have no end.
  Real side(int d, Index i) const {
    constexpr Real far = std::numeric_limits<Real>::max();
    return i == 0 ? -far : i == count_[d] ? far : low_[d] + i * step_[d];
  }

  /// The first and the last patch that a polygon may lie in.
  std::array<std::array<Index, 2>, 2> places(const FacePolygon& polygon) const {
    std::array<std::array<Index, 2>, 2> found{};
    for (int d = 0; d < 2; ++d) {
      const auto range_of = range({polygon}, d);
      for (int end = 0; end < 2; ++end) {
        const Real at = step_[d] > 0 ? (range_of[end] - low_[d]) / step_[d] : 0;
        found[end][d] = std::clamp<Index>(static_cast<Index>(std::floor(at)), 0, count_[d] - 1);
      }
    }
    return found;
  }

  std::array<Vec3, 2> axis_{};
  std::array<Real, 2> low_{}, step_{};
  std::array<Index, 2> count_{};
};

Extent extent(const Polygons& surface) {
  Extent e;
  for (const FacePolygon& polygon : surface) {
    const Points points = surface_points({polygon}, 1);
    for (const auto& p : points) e.centre += p.area * p.x, e.area += p.area;
  }
  if (e.area > 0) e.centre = (1 / e.area) * e.centre;
  return e;
}

/// Patches that are small beside the largest go to the nearest one that is not.
std::vector<Polygons> join_small(std::vector<Polygons> all) {
  std::vector<Extent> of;
  Real largest = 0;
  for (const auto& patch : all) {
    of.push_back(extent(patch));
    largest = std::max(largest, of.back().area);
  }
  std::vector<Polygons> joined(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::size_t to = i;
    Real nearest = std::numeric_limits<Real>::infinity();
    if (of[i].area < least_share * largest)
      for (std::size_t j = 0; j < all.size(); ++j) {
        const Real distance = norm(of[j].centre - of[i].centre);
        if (of[j].area >= least_share * largest && distance < nearest) to = j, nearest = distance;
      }
    joined[to].insert(joined[to].end(), all[i].begin(), all[i].end());
  }
  joined.erase(
      std::remove_if(joined.begin(), joined.end(), [](const Polygons& p) { return p.empty(); }),
      joined.end());
  return joined;
}

}  // namespace

void hold_surface(const CoverArrays& covers, const std::vector<FacePolygon>& surface, Real spacing,
                  Real slack, std::vector<HeldRow>& rows) {
  slack = std::max(slack, rounding * spacing);
  const bool block = covers.lattice.kind == LatticeKind::block;
  const int of_weights = covers.lattice.kind == LatticeKind::hex8 ? 3 : block ? 0 : 1;
  const int of_functions = of_weights + covers.order;
  // Rock that is smaller than a lattice cell bends as its functions do, which are in units of its own size. A block is its own cell.
  const Real unit = covers.middle.empty() ? spacing : 2 * covers.reach * spacing;
  if (!block && runs_through_nodes(covers, surface, spacing, slack)) {
    hold_covers(covers, surface_points(surface, of_weights + 2 * covers.order), surface[0], slack,
                unit, rows);
    return;
  }
  const int degree = block ? covers.order : covers.order + 1;
  const std::vector<Polygons> all =
      block ? std::vector<Polygons>{surface}
            : join_small(PatchGrid(covers, surface, patch_width * spacing).divide(surface));
  for (const Polygons& patch : all) {
    const Points points = surface_points(patch, of_functions + degree);
    if (points.empty()) continue;
    add_moments(covers, points, surface[0].normal, block ? width(points) : unit, degree, rows);
  }
}

}  // namespace rockfold
