#include <algorithm>
#include <string>

#include "kernels/solve/element_table_kernel.hpp"
#include "src/base/error.hpp"

namespace rockfold::solve {
namespace {

using device::to_device;

/// [E][terms]: pieces summed, times the share of the split.
std::vector<Real> sum_pieces(const CoverArrays& covers, const PieceMoments& moments, int degree,
                             Real share) {
  const std::size_t terms = integrate::count_to(degree),
                    given = integrate::count_to(moments.degree);
  if (covers.cut_count() > 0 &&
      (given < terms || moments.local.size() != given * covers.piece_block.size()))
    throw Error(ErrorKind::analysis, "moments of " + std::to_string(moments.volume.size()) +
                                         " pieces up to degree " + std::to_string(moments.degree) +
                                         " were given, expected " +
                                         std::to_string(covers.piece_count()) +
                                         " pieces up to degree " + std::to_string(degree));
  std::vector<Real> sums(terms * covers.element_cell.size(), 0.0);
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      for (std::size_t m = 0; m < terms; ++m)
        sums[terms * e + m] += share * moments.local[given * q + m];
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
                                const std::vector<ElasticMaterial>& materials,
                                const CoverSeries& series) {
  const LatticeFunctions functions = lattice_functions(covers.lattice, series);
  ElementTable table;
  table.parts = make_part_table(functions);
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
      return static_cast<std::uint8_t>(LatticeFunctions::form(covers.lattice, cell));
    };
    std::transform(covers.regular_cell.begin(), covers.regular_cell.end(), form.begin(), form_of);
    for (std::size_t e = 0; e < part.size(); ++e)
      part[e] =
          static_cast<std::uint8_t>(part[e] + functions.parts * form_of(covers.element_cell[e]));
  }
  table.regular_form = to_device("solve::regular_form", form);
  table.element_part = to_device("solve::element_part", part);
  table.cut_moment = to_device(
      "solve::cut_moment", sum_pieces(covers, moments, functions.moment_degree(), functions.share));
  table.elastic = to_device("solve::elastic", make_elastic(materials));
  return table;
}

ElementTable make_element_table(const CoverArrays& covers, const PieceMoments& moments,
                                const std::vector<ElasticMaterial>& materials) {
  return make_element_table(covers, moments, materials, cover_series(covers.order));
}

}  // namespace rockfold::solve
