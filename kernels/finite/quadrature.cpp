#include "kernels/finite/quadrature.hpp"

#include <algorithm>

#include "kernels/device/device_kernel.hpp"
#include "kernels/finite/point_rule.hpp"
#include "kernels/integrate/moments_kernel.hpp"
#include "kernels/operator/elements/part_functions.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::finite {

namespace {

/// Exact for the strain energy of small strain: twice the degree of the functions' gradients.
int quadrature_degree(const LatticeFunctions& functions) {
  return 2 * std::max(0, functions.degree - 1);
}

class Builder {
 public:
  Builder(const CoverArrays& covers, const PieceMoments& moments)
      : covers_(covers), moments_(moments), functions_(lattice_functions(covers)) {}

  Quadrature run() {
    const Index elements = covers_.element_count();
    number_kinds();
    const int most = integrate::count_to(degree_);
    std::vector<std::vector<RockPoint>> parts;
    for (int form = 0; form < functions_.forms; ++form) {
      const CellSplit& split = cell_split(covers_.lattice.kind, form == 1);
      for (const CellPart& part : split.part) {
        std::vector<RockPoint> all;
        points_.add_part(split, part, all);
        parts.push_back(reduce(all, degree_));
        result_.points = std::max(result_.points, static_cast<int>(parts.back().size()));
      }
    }
    if (own_kinds_ > 0) result_.points = most;
    result_.functions = all_.width();
    const std::size_t points = static_cast<std::size_t>(result_.kinds) * result_.points;
    result_.place.resize(points);
    result_.gradient.resize(points * result_.functions);
    result_.weight.resize(static_cast<std::size_t>(elements) * result_.points, 0);
    for (int kind = 0; kind < static_cast<int>(parts.size()); ++kind)
      place_points(kind, parts[kind], [&](const Vec3& eta, Vec3* to) {
        const auto gradients = functions_.gradients(kind, eta);
        std::copy(gradients.begin(), gradients.end(), to);
      });
    using Host = Kokkos::DefaultHostExecutionSpace;
    Kokkos::parallel_for("rockfold::finite::element_rules",
                         Kokkos::RangePolicy<Host, Kokkos::Schedule<Kokkos::Dynamic>>(0, elements),
                         [&](const Index e) { add_element(e, parts); });
    return std::move(result_);
  }

 private:
  bool whole(Index e) const { return e < functions_.parts * covers_.regular_count(); }
  /// Whether an element has points that no other has.
  bool own(Index e) const { return degree_ > 0 && !whole(e); }

  void number_kinds() {
    result_.kinds = functions_.forms * functions_.parts;
    for (Index e = 0; e < covers_.element_count(); ++e) {
      const bool alone = own(e);
      result_.kind.push_back(alone ? result_.kinds++ : kind_of(e));
      own_kinds_ += alone ? 1 : 0;
    }
  }

  int kind_of(Index e) const {
    const ElementNodes nodes = element_nodes(covers_, e);
    return functions_.parts * form_of_cell(covers_.lattice, nodes.cell) + nodes.part;
  }

  void add_element(Index e, const std::vector<std::vector<RockPoint>>& parts) {
    Real* weight = &result_.weight[static_cast<std::size_t>(e) * result_.points];
    if (!own(e) && !whole(e)) {  // slopes are constant: one point serves
      *weight = functions_.share * cut_volume(e);
      return;
    }
    std::vector<RockPoint> points;
    if (whole(e)) {
      points = parts[kind_of(e)];
    } else {
      points_.add_element(e, points);
      points = reduce(points, degree_);
    }
    for (std::size_t q = 0; q < points.size(); ++q) weight[q] = points[q].weight;
    if (!own(e)) return;
    const ElementNodes nodes = element_nodes(covers_, e);
    std::vector<FunctionValue> value(all_.width());
    place_points(result_.kind[e], points, [&](const Vec3& eta, Vec3* to) {
      all_.at(nodes, eta, value.data());
      for (const FunctionValue& f : value) *to++ = f.gradient;
    });
  }

  Real cut_volume(Index e) const {
    const Index cut = e - functions_.parts * covers_.regular_count();
    Real volume = 0;
    for (Index q = covers_.piece_begin[cut]; q < covers_.piece_begin[cut + 1]; ++q)
      volume += moments_.volume[q];
    return volume;
  }

  /// What is left of a kind's points repeats the first, and gets no weight.
  template <class Gradients>
  void place_points(int kind, const std::vector<RockPoint>& points, const Gradients& gradients) {
    for (int q = 0; q < result_.points; ++q) {
      const std::size_t at = static_cast<std::size_t>(kind) * result_.points + q;
      result_.place[at] = points[q < static_cast<int>(points.size()) ? q : 0].eta;
      gradients(result_.place[at], &result_.gradient[at * result_.functions]);
    }
  }

  const CoverArrays& covers_;
  const PieceMoments& moments_;
  const LatticeFunctions functions_;
  const ElementFunctions all_{covers_};
  const int degree_ = quadrature_degree(functions_);
  const ElementPoints points_{covers_, degree_};
  int own_kinds_ = 0;
  Quadrature result_;
};

}  // namespace

Quadrature make_quadrature(const CoverArrays& covers, const PieceMoments& moments) {
  return Builder(covers, moments).run();
}

}  // namespace rockfold::finite
