#include <algorithm>
#include <string>

#include "kernels/operator/elements/element_table_kernel.hpp"
#include "src/base/error.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::solve {
namespace {

using device::to_device;

void require_degree(const CoverArrays& covers, const PieceMoments& moments, int degree) {
  if (covers.cut_count() == 0) return;
  if (moments.degree >= degree &&
      moments.local.size() == integrate::count_to(moments.degree) * covers.piece_block.size())
    return;
  throw Error(ErrorKind::analysis, "moments of " + std::to_string(moments.volume.size()) +
                                       " pieces up to degree " + std::to_string(moments.degree) +
                                       " were given, expected " +
                                       std::to_string(covers.piece_count()) +
                                       " pieces up to degree " + std::to_string(degree));
}

/// [E][count_to(degree)]: `moment` of pieces, known up to degree `given`, summed, times the share of the split.
std::vector<Real> sum_pieces(const CoverArrays& covers, const std::vector<Real>& moment, int given,
                             int degree, Real share) {
  const std::size_t terms = integrate::count_to(degree), stride = integrate::count_to(given);
  std::vector<Real> sums(terms * covers.element_cell.size(), 0.0);
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      for (std::size_t m = 0; m < terms; ++m) sums[terms * e + m] += share * moment[stride * q + m];
  return sums;
}

}  // namespace

Elastic make_elastic(const ElasticMaterial& m) {
  const Real e = m.young_modulus, nu = m.poisson_ratio;
  return {e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu)), m.density};
}

std::vector<Elastic> make_elastic(const std::vector<ElasticMaterial>& materials) {
  std::vector<Elastic> result;
  for (const auto& m : materials) result.push_back(make_elastic(m));
  return result;
}

ElementTable make_element_table(const CoverArrays& covers, const PieceMoments& moments,
                                const std::vector<ElasticMaterial>& materials) {
  const LatticeFunctions functions = lattice_functions(covers);
  ElementTable table;
  table.parts = make_part_table(functions);
  table.functions = functions.functions;
  table.covers = covers.cover_count();
  table.regular = covers.regular_count();
  table.cut = covers.cut_count();
  table.regular_cover = to_device("solve::regular_cover", covers.regular_cover);
  table.regular_material = to_device("solve::regular_material", covers.regular_material);
  table.element_cover = to_device("solve::element_cover", covers.element_cover);
  table.element_material = to_device("solve::element_material", covers.element_material);
  std::vector<std::uint8_t> form(covers.regular_cell.size(), 0), part = covers.element_part;
  if (functions.forms > 1) {
    const auto form_of = [&](Index cell) {
      return static_cast<std::uint8_t>(form_of_cell(covers.lattice, cell));
    };
    std::transform(covers.regular_cell.begin(), covers.regular_cell.end(), form.begin(), form_of);
    for (std::size_t e = 0; e < part.size(); ++e)
      part[e] =
          static_cast<std::uint8_t>(part[e] + functions.parts * form_of(covers.element_cell[e]));
  }
  table.regular_form = to_device("solve::regular_form", form);
  table.element_part = to_device("solve::element_part", part);
  const int degree = functions.moment_degree();
  require_degree(covers, moments, degree);
  table.cut_moment =
      to_device("solve::cut_moment",
                sum_pieces(covers, moments.local, moments.degree, degree, functions.share));
  if (degree > 2 && !moments.amid.empty()) {
    table.amid_moment =
        to_device("solve::amid_moment",
                  sum_pieces(covers, moments.amid, moments.degree, degree, functions.share));
    std::vector<Real> origin;
    for (const Vec3& eta : moments.origin) origin.insert(origin.end(), eta.begin(), eta.end());
    table.origin = to_device("solve::element_origin", origin);
  }
  if (!covers.middle.empty()) {
    std::vector<Real> middle;
    for (const Vec3& xi : covers.middle) middle.insert(middle.end(), xi.begin(), xi.end());
    table.middle = to_device("solve::cover_middle", middle);
    table.reach = covers.reach;
  }
  table.elastic = to_device("solve::elastic", make_elastic(materials));
  return table;
}

}  // namespace rockfold::solve
