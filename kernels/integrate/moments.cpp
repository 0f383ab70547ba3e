#include "kernels/integrate/moments.hpp"

#include <cmath>
#include <string>

#include "kernels/integrate/moments_kernel.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using device::Array;
using integrate::BodyIntegral;

struct Boundary {
  Array<Index> triangle_begin, triangle_vertex;
  Array<Real> xyz;
};

Real cell_volume(const Lattice& lattice) {
  return std::abs(dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2])));
}

/// A piece that rounding has flattened: a point of the least volume at the mean of its boundary's corners.
KOKKOS_INLINE_FUNCTION void point_moments(const Boundary& piece, Index begin, Index end,
                                          Real volume, Real* moments) {
  Real mean[3] = {0, 0, 0};
  for (Index c = 3 * begin; c < 3 * end; ++c)
    for (int d = 0; d < 3; ++d)
      mean[d] += piece.xyz(3 * piece.triangle_vertex(c) + d) / (3 * (end - begin));
  moments[integrate::index_of(0, 0, 0)] = volume;
  moments[integrate::index_of(1, 0, 0)] = volume * mean[0];
  moments[integrate::index_of(0, 1, 0)] = volume * mean[1];
  moments[integrate::index_of(0, 0, 1)] = volume * mean[2];
  moments[integrate::index_of(2, 0, 0)] = volume * mean[0] * mean[0];
  moments[integrate::index_of(0, 2, 0)] = volume * mean[1] * mean[1];
  moments[integrate::index_of(0, 0, 2)] = volume * mean[2] * mean[2];
  moments[integrate::index_of(1, 1, 0)] = volume * mean[0] * mean[1];
  moments[integrate::index_of(0, 1, 1)] = volume * mean[1] * mean[2];
  moments[integrate::index_of(1, 0, 1)] = volume * mean[0] * mean[2];
}

/// [Q][10] moments up to degree 2; returns the first piece that is inside out, or `pieces` if none is.
Index integrate_pieces(const Boundary& piece, Index pieces, Real cell, const Array<Real>& moments) {
  Index first_bad = pieces;
  const Real rounding = integrate::volume_rounding * cell, floor = integrate::volume_floor * cell;
  Kokkos::parallel_reduce(
      "rockfold::integrate::piece_moments", device::Range(0, pieces),
      KOKKOS_LAMBDA(const Index q, Index& bad) {
        const Index begin = piece.triangle_begin(q), end = piece.triangle_begin(q + 1);
        Real about[3];
        BodyIntegral<2> body =
            integrate::integrate_body<2>(begin, end, piece.triangle_vertex, piece.xyz, about);
        // `!(… > …)` also catches NaN. The kept index is the smallest, whatever the order of threads.
        if (!(body.sum[0] > -rounding) && q < bad) bad = q;
        if (body.sum[0] > floor)
          body.shift(about);
        else
          point_moments(piece, begin, end, floor, body.sum);
        for (int m = 0; m < 10; ++m) moments(10 * q + m) = body.sum[m];
      },
      Kokkos::Min<Index>(first_bad));
  return first_bad < pieces ? first_bad : pieces;
}

void report_bad_piece(const CoverArrays& covers, Index q, Real volume) {
  Index e = 0;
  while (e < covers.cut_count() && covers.piece_begin[e + 1] <= q) ++e;
  throw Error(ErrorKind::analysis, "piece " + std::to_string(q) + " of manifold element " +
                                       std::to_string(6 * covers.regular_count() + e) +
                                       " is inside out: its volume is " + std::to_string(volume) +
                                       " m3, expected > 0");
}

}  // namespace

PieceMoments piece_moments(const CoverArrays& covers) {
  const Index pieces = covers.piece_count();
  const Boundary boundary{
      device::to_device("integrate::triangle_begin", covers.triangle_begin),
      device::to_device("integrate::triangle_vertex", covers.triangle_vertex),
      device::to_device("integrate::vertex_xyz", covers.vertex_xyz),
  };
  const auto moments =
      device::allocate<Real>("integrate::moments", 10 * static_cast<std::size_t>(pieces));
  const Index bad = integrate_pieces(boundary, pieces, cell_volume(covers.lattice), moments);
  const std::vector<Real> host = device::to_host(moments);
  if (bad < pieces) report_bad_piece(covers, bad, host[10 * static_cast<std::size_t>(bad)]);

  PieceMoments result;
  result.volume.resize(pieces);
  result.first.resize(pieces);
  result.second.resize(pieces);
  for (std::size_t q = 0; q < result.volume.size(); ++q) {
    const Real* m = &host[10 * q];
    auto at = [&](int a, int b, int c) { return m[monomial_index(a, b, c)]; };
    result.volume[q] = at(0, 0, 0);
    result.first[q] = {at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)};
    result.second[q] = {at(2, 0, 0), at(0, 2, 0), at(0, 0, 2),
                        at(1, 1, 0), at(0, 1, 1), at(1, 0, 1)};
  }
  return result;
}

std::vector<Real> integrate_monomials(const ClosedSurfaces& surfaces) {
  const Index bodies = static_cast<Index>(surfaces.triangle_begin.size()) - 1;
  const auto begin = device::to_device("integrate::triangle_begin", surfaces.triangle_begin);
  const auto vertex = device::to_device("integrate::triangle_vertex", surfaces.triangle_vertex);
  const auto xyz = device::to_device("integrate::vertex_xyz", surfaces.vertex_xyz);
  const auto result = device::allocate<Real>("integrate::monomials",
                                             monomial_count * static_cast<std::size_t>(bodies));
  device::for_each(
      "rockfold::integrate::monomials", bodies, KOKKOS_LAMBDA(const Index s) {
        Real about[3];
        auto body =
            integrate::integrate_body<max_degree>(begin(s), begin(s + 1), vertex, xyz, about);
        body.shift(about);
        for (int m = 0; m < monomial_count; ++m) result(monomial_count * s + m) = body.sum[m];
      });
  return device::to_host(result);
}

}  // namespace rockfold
