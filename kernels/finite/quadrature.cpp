#include "kernels/finite/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/device/device_kernel.hpp"
#include "kernels/finite/point_rule.hpp"
#include "kernels/integrate/moments_kernel.hpp"
#include "kernels/solve/part_functions.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/vector.hpp"

namespace rockfold::finite {

namespace {

/// Exact for the strain energy of small strain: twice the degree of the functions' gradients; or as a local series asks for.
int quadrature_degree(const CoverArrays& covers, const LatticeFunctions& functions) {
  if (covers.series) return std::min(covers.series->degree(), most_series_degree);
  return 2 * std::max(0, functions.degree - 1);
}

/// The point of the unit tetrahedron, seen in another one.
Vec3 in_tetrahedron(const std::array<Vec3, 4>& corner, const Vec3& x) {
  Vec3 y = corner[0];
  for (int d = 0; d < 3; ++d) y += x[d] * (corner[d + 1] - corner[0]);
  return y;
}

/// Points of a whole part, η; weights sum to 1.
PointRule part_rule(const CellSplit& split, const CellPart& part, int degree) {
  if (part.nodes != 4) return cell_rule(degree);
  std::array<Vec3, 4> corner;
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 3; ++d) corner[a][d] = 0.5 * split.node[part.node[a]][d] - 0.5;
  PointRule rule = tetrahedron_rule(degree);
  for (Vec3& x : rule.point) x = in_tetrahedron(corner, x);
  return rule;
}

/// A rule for cut elements, from the tetrahedra of their pieces.
class CutRules {
 public:
  CutRules(const CoverArrays& covers, const PieceMoments& moments, const Mat3& reciprocal,
           int degree)
      : covers_(covers),
        moments_(moments),
        reciprocal_(reciprocal),
        degree_(degree),
        tetrahedron_(tetrahedron_rule(degree)) {}

  /// Points η, weights m³.
  PointRule rule(Index e) const {
    const Box box = box_about(e);
    PointRule all;
    for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q)
      add_piece(q, box, all);
    PointRule few = reduce(all, degree_);
    for (Vec3& x : few.point)
      for (int d = 0; d < 3; ++d) x[d] = box.eta[d] + box.edge[d] * x[d];
    return few;
  }

 private:
  struct Box {
    Vec3 centre, eta, edge;  ///< m; η of the centre; η
  };

  Vec3 vertex(Index corner) const {
    const Real* x = &covers_.vertex_xyz[3 * covers_.triangle_vertex[corner]];
    return {x[0], x[1], x[2]};
  }
  Vec3 to_eta(const Vec3& x) const {
    return {dot(reciprocal_[0], x), dot(reciprocal_[1], x), dot(reciprocal_[2], x)};
  }
  Vec3 mean_of_corners(Index first, Index last) const {
    Vec3 sum{};
    for (Index c = first; c < last; ++c) sum += vertex(c);
    return (1.0 / std::max<Index>(1, last - first)) * sum;
  }

  /// Differences to the centre are taken in metres: of a sliver in a corner of its cell they keep their digits.
  Box box_about(Index e) const {
    const Index first = 3 * covers_.triangle_begin[covers_.piece_begin[e]],
                last = 3 * covers_.triangle_begin[covers_.piece_begin[e + 1]];
    Box box;
    box.centre = mean_of_corners(first, last);
    box.eta = to_eta(box.centre);
    Vec3 half{1e-15, 1e-15, 1e-15};  // of a piece that rounding has flattened
    for (Index c = first; c < last; ++c) {
      const Vec3 eta = to_eta(vertex(c) - box.centre);
      for (int d = 0; d < 3; ++d) half[d] = std::max(half[d], std::abs(eta[d]));
    }
    box.edge = 2.0 * half;
    return box;
  }

  /// Pieces are convex: tetrahedra from a point inside to all triangles.
  void add_piece(Index q, const Box& box, PointRule& all) const {
    const auto to_box = [&](const Vec3& x) {
      Vec3 y = to_eta(x - box.centre);
      for (int d = 0; d < 3; ++d) y[d] /= box.edge[d];
      return y;
    };
    const Index first = 3 * covers_.triangle_begin[q], last = 3 * covers_.triangle_begin[q + 1];
    const Vec3 inside = mean_of_corners(first, last);
    const std::size_t before = all.size();
    Real total = 0;
    for (Index c = first; c < last; c += 3) {
      const Vec3 a = vertex(c), b = vertex(c + 1), d = vertex(c + 2);
      const Real volume = dot(a - inside, cross(b - inside, d - inside)) / 6;
      if (!(volume > 0)) continue;
      total += volume;
      const std::array<Vec3, 4> corner{to_box(inside), to_box(a), to_box(b), to_box(d)};
      for (std::size_t i = 0; i < tetrahedron_.size(); ++i)
        all.add(in_tetrahedron(corner, tetrahedron_.point[i]), volume * tetrahedron_.weight[i]);
    }
    if (total > 0.5 * moments_.volume[q]) return;
    // So thin that its volume is rounding: that of the moments, in one point.
    all.point.resize(before);
    all.weight.resize(before);
    all.add(to_box(inside), moments_.volume[q]);
  }

  const CoverArrays& covers_;
  const PieceMoments& moments_;
  const Mat3& reciprocal_;
  const int degree_;
  const PointRule tetrahedron_;
};

class Builder {
 public:
  Builder(const CoverArrays& covers, const PieceMoments& moments)
      : covers_(covers), moments_(moments), functions_(lattice_functions(covers)) {}

  Quadrature run() {
    for (int form = 0; form < functions_.forms; ++form) {
      const CellSplit& split = cell_split(covers_.lattice.kind, form == 1);
      for (const CellPart& part : split.part) rules_.push_back(part_rule(split, part, degree_));
    }
    const bool own = degree_ > 0;  // points of their own for cut elements
    if (covers_.series) return sample();
    result_.functions = functions_.nodes * functions_.functions;
    result_.points = static_cast<int>(rules_.front().size());
    if (own && covers_.cut_count() > 0)
      result_.points = std::max(result_.points, integrate::count_to(degree_));
    const Index whole = static_cast<Index>(rules_.size());
    result_.kinds = whole + (own ? covers_.cut_count() : 0);
    const std::size_t points = static_cast<std::size_t>(result_.kinds) * result_.points;
    result_.place.resize(points);
    result_.gradient.resize(points * result_.functions);
    result_.weight.resize(static_cast<std::size_t>(covers_.element_count()) * result_.points, 0);
    for (Index kind = 0; kind < whole; ++kind) place_points(kind, kind, rules_[kind].point);
    add_regular();
    if (own)
      add_cut();
    else
      add_cut_volumes();
    return std::move(result_);
  }

 private:
  /// With a local series no two elements are alike: each is a kind of its own.
  Quadrature sample() {
    const ElementFunctions all(covers_);
    const CutRules rules(covers_, moments_, functions_.reciprocal, degree_);
    const Index elements = covers_.element_count(),
                whole = functions_.parts * covers_.regular_count();
    for (PointRule& rule : rules_) rule = reduce(rule, degree_);
    result_.functions = all.width();
    result_.points = integrate::count_to(degree_);
    result_.kinds = elements;
    const std::size_t points = static_cast<std::size_t>(elements) * result_.points;
    result_.place.resize(points);
    result_.gradient.resize(points * result_.functions);
    result_.weight.resize(points, 0);
    for (Index e = 0; e < elements; ++e) result_.kind.push_back(e);
    using Host = Kokkos::DefaultHostExecutionSpace;
    Kokkos::parallel_for(
        "rockfold::finite::sample",
        Kokkos::RangePolicy<Host, Kokkos::Schedule<Kokkos::Dynamic>>(0, elements),
        [&](const Index e) {
          const ElementNodes nodes = element_nodes(covers_, e);
          const int part = kind_of(nodes.cell, nodes.part);
          const PointRule rule = e < whole ? rules_[part] : rules.rule(e - whole);
          set_weights(e, rule.weight,
                      e < whole ? functions_.part[part].moment[0] : functions_.share);
          std::vector<FunctionValue> value(all.width());
          for (int q = 0; q < result_.points; ++q) {
            const std::size_t at = static_cast<std::size_t>(e) * result_.points + q;
            result_.place[at] = rule.point[q < static_cast<int>(rule.size()) ? q : 0];
            all.at(nodes, result_.place[at], value.data());
            for (int f = 0; f < all.width(); ++f)
              result_.gradient[at * result_.functions + f] = value[f].gradient;
          }
        });
    return std::move(result_);
  }

  /// What is left of a kind's points repeats the first, and gets no weight.
  void place_points(Index kind, int part, const std::vector<Vec3>& points) {
    for (int q = 0; q < result_.points; ++q) {
      const std::size_t at = static_cast<std::size_t>(kind) * result_.points + q;
      result_.place[at] = points[q < static_cast<int>(points.size()) ? q : 0];
      const auto gradients = functions_.gradients(part, result_.place[at]);
      std::copy(gradients.begin(), gradients.end(), &result_.gradient[at * result_.functions]);
    }
  }

  int kind_of(Index cell, int part) const {
    return functions_.parts * LatticeFunctions::form(covers_.lattice, cell) + part;
  }

  void set_weights(Index e, const std::vector<Real>& weight, Real share) {
    for (std::size_t q = 0; q < weight.size(); ++q)
      result_.weight[static_cast<std::size_t>(e) * result_.points + q] = share * weight[q];
  }

  void add_regular() {
    for (Index r = 0; r < covers_.regular_count(); ++r)
      for (int t = 0; t < functions_.parts; ++t) {
        const int kind = kind_of(covers_.regular_cell[r], t);
        set_weights(static_cast<Index>(result_.kind.size()), rules_[kind].weight,
                    functions_.part[kind].moment[0]);
        result_.kind.push_back(kind);
      }
  }

  void add_cut() {
    const CutRules rules(covers_, moments_, functions_.reciprocal, degree_);
    const Index first = static_cast<Index>(result_.kind.size());
    for (Index e = 0; e < covers_.cut_count(); ++e)
      result_.kind.push_back(static_cast<int>(rules_.size()) + e);
    using Host = Kokkos::DefaultHostExecutionSpace;
    Kokkos::parallel_for(
        "rockfold::finite::cut_rules",
        Kokkos::RangePolicy<Host, Kokkos::Schedule<Kokkos::Dynamic>>(0, covers_.cut_count()),
        [&](const Index e) {
          const PointRule rule = rules.rule(e);
          set_weights(first + e, rule.weight, functions_.share);
          place_points(static_cast<Index>(rules_.size()) + e,
                       kind_of(covers_.element_cell[e], covers_.element_part[e]), rule.point);
        });
  }

  /// One point serves: slopes are constant.
  void add_cut_volumes() {
    for (Index e = 0; e < covers_.cut_count(); ++e) {
      Real volume = 0;
      for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q)
        volume += moments_.volume[q];
      set_weights(static_cast<Index>(result_.kind.size()), {volume}, functions_.share);
      result_.kind.push_back(kind_of(covers_.element_cell[e], covers_.element_part[e]));
    }
  }

  const CoverArrays& covers_;
  const PieceMoments& moments_;
  const LatticeFunctions functions_;
  const int degree_ = quadrature_degree(covers_, functions_);
  std::vector<PointRule> rules_;  // of whole parts
  Quadrature result_;
};

}  // namespace

Quadrature make_quadrature(const CoverArrays& covers, const PieceMoments& moments) {
  return Builder(covers, moments).run();
}

}  // namespace rockfold::finite
