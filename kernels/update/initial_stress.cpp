#include "kernels/update/initial_stress.hpp"

#include "kernels/solve/tet_weights.hpp"

namespace rockfold::update {
namespace {

/// Volume and ∫ z dV of an element.
struct HeightMoments {
  Real volume = 0, height = 0;
};

HeightMoments whole_part(const CoverArrays& covers, const TetWeights& tet, Index regular) {
  const Real cell = covers.lattice.cell_centre(covers.regular_cell[regular])[2];
  return {tet.volume, cell * tet.volume + tet.first[2]};
}

HeightMoments cut_element(const CoverArrays& covers, const PieceMoments& moments, Index e) {
  const Real cell = covers.lattice.cell_centre(covers.element_cell[e])[2];
  HeightMoments sum;
  for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
    sum.volume += moments.volume[q];
    sum.height += cell * moments.volume[q] + moments.first[q][2];
  }
  return sum;
}

/// ∫ σ0 dV, J.
std::array<Real, 6> integral(const InitialStress& stress, const HeightMoments& m) {
  std::array<Real, 6> sum;
  for (int k = 0; k < 6; ++k)
    sum[k] =
        m.volume * stress.at[k] + (stress.reference_z * m.volume - m.height) * stress.gradient[k];
  return sum;
}

void pull(const std::array<Real, 6>& s, const Vec3& gradient, Vec3& force) {
  const Real rows[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) force[i] += rows[i][j] * gradient[j];
}

}  // namespace

std::array<Real, 6> stress_at(const InitialStress& stress, Real z) {
  std::array<Real, 6> s;
  for (int k = 0; k < 6; ++k) s[k] = stress.at[k] + (stress.reference_z - z) * stress.gradient[k];
  return s;
}

ElementHeights element_heights(const CoverArrays& covers, const PieceMoments& moments) {
  const auto tets = tet_weights(covers.lattice);
  ElementHeights heights;
  const auto add = [&](Index cell, const HeightMoments& m) {
    heights.cell.push_back(covers.lattice.cell_centre(cell)[2]);
    heights.centroid.push_back(m.volume > 0 ? m.height / m.volume : heights.cell.back());
  };
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int t = 0; t < 6; ++t) add(covers.regular_cell[r], whole_part(covers, tets[t], r));
  for (Index e = 0; e < covers.cut_count(); ++e)
    add(covers.element_cell[e], cut_element(covers, moments, e));
  return heights;
}

std::vector<Vec3> initial_stress_force(const CoverArrays& covers, const PieceMoments& moments,
                                       const InitialStress& stress) {
  const auto tets = tet_weights(covers.lattice);
  std::vector<Vec3> force(covers.unknown_count());
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int t = 0; t < 6; ++t) {
      const auto sum = integral(stress, whole_part(covers, tets[t], r));
      for (int a = 0; a < 4; ++a)
        pull(sum, tets[t].gradient[a], force[covers.regular_cover[8 * r + tet6_corner[t][a]]]);
    }
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const auto sum = integral(stress, cut_element(covers, moments, e));
    const TetWeights& tet = tets[covers.element_part[e]];
    for (int a = 0; a < 4; ++a) pull(sum, tet.gradient[a], force[covers.element_cover[4 * e + a]]);
  }
  return force;
}

}  // namespace rockfold::update
