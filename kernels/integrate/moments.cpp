#include "kernels/integrate/moments.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/integrate/moments_kernel.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using device::Array;
using integrate::BodyIntegral;

/// Vertices in units of the cell's edges from its centre.
struct Boundary {
  Array<Index> triangle_begin, triangle_vertex;
  Array<Real> eta;
  Array<Real> origin;  ///< [Q][3] of each piece's element; empty: not wanted
};

Real cell_volume(const Lattice& lattice) {
  return std::abs(dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2])));
}

/// A piece that rounding has flattened: a point of the least volume at the mean of its boundary's corners.
KOKKOS_INLINE_FUNCTION void point_moments(const Boundary& piece, Index begin, Index end,
                                          const Real* origin, int degree, Real* moments) {
  Real mean[3] = {-origin[0], -origin[1], -origin[2]};
  for (Index c = 3 * begin; c < 3 * end; ++c)
    for (int d = 0; d < 3; ++d)
      mean[d] += piece.eta(3 * piece.triangle_vertex(c) + d) / (3 * (end - begin));
  integrate::fill_monomials(mean, degree, moments);
  for (int m = 0; m < integrate::count_to(degree); ++m) moments[m] *= integrate::volume_floor;
}

/// [Q][count_to(Degree)] in units of the cell, about its centre and `amid` the piece's element; returns the first piece that is
/// inside out, or `pieces` if none is.
template <int Degree>
Index integrate_pieces(const Boundary& piece, Index pieces, const Array<Real>& moments,
                       const Array<Real>& amid) {
  constexpr int terms = integrate::count_to(Degree);
  const bool centred = amid.extent(0) > 0;
  Index first_bad = pieces;
  Kokkos::parallel_reduce(
      "rockfold::integrate::piece_moments", device::Range(0, pieces),
      KOKKOS_LAMBDA(const Index q, Index& bad) {
        const Index begin = piece.triangle_begin(q), end = piece.triangle_begin(q + 1);
        Real about[3];
        BodyIntegral<Degree> body =
            integrate::integrate_body<Degree>(begin, end, piece.triangle_vertex, piece.eta, about);
        // `!(… > …)` also catches NaN. The kept index is the smallest, whatever the order of threads.
        if (!(body.sum[0] > -integrate::volume_rounding) && q < bad) bad = q;
        const bool flat = !(body.sum[0] > integrate::volume_floor);
        if (centred) {
          BodyIntegral<Degree> shifted = body;
          Real origin[3], by[3];
          for (int d = 0; d < 3; ++d) {
            origin[d] = piece.origin(3 * static_cast<std::size_t>(q) + d);
            by[d] = about[d] - origin[d];
          }
          if (flat)
            point_moments(piece, begin, end, origin, Degree, shifted.sum);
          else
            shifted.shift(by);
          for (int m = 0; m < terms; ++m)
            amid(static_cast<std::size_t>(terms) * q + m) = shifted.sum[m];
        }
        const Real centre[3] = {0, 0, 0};
        if (flat)
          point_moments(piece, begin, end, centre, Degree, body.sum);
        else
          body.shift(about);
        for (int m = 0; m < terms; ++m)
          moments(static_cast<std::size_t>(terms) * q + m) = body.sum[m];
      },
      Kokkos::Min<Index>(first_bad));
  return first_bad < pieces ? first_bad : pieces;
}

Index integrate_pieces(const Boundary& piece, Index pieces, int degree, const Array<Real>& moments,
                       const Array<Real>& amid) {
  switch (degree) {
    case 2:
      return integrate_pieces<2>(piece, pieces, moments, amid);
    case 4:
      return integrate_pieces<4>(piece, pieces, moments, amid);
    case 6:
      return integrate_pieces<6>(piece, pieces, moments, amid);
    case 8:
      return integrate_pieces<8>(piece, pieces, moments, amid);
    case 10:
      return integrate_pieces<10>(piece, pieces, moments, amid);
    default:
      throw Error(ErrorKind::analysis, "moments of degree " + std::to_string(degree) +
                                           " were asked for, expected 2, 4, 6, 8 or 10");
  }
}

/// η of vertices given in metres.
Array<Real> local_vertices(const CoverArrays& covers) {
  const auto xyz = device::to_device("integrate::vertex_xyz", covers.vertex_xyz);
  const Mat3 rows = covers.lattice.reciprocal();
  Kokkos::Array<Real, 9> reciprocal;
  for (int d = 0; d < 3; ++d)
    for (int e = 0; e < 3; ++e) reciprocal[3 * d + e] = rows[d][e];
  auto eta = device::allocate<Real>("integrate::vertex_eta", covers.vertex_xyz.size());
  device::for_each(
      "rockfold::integrate::local_vertices", static_cast<Index>(covers.vertex_xyz.size() / 3),
      KOKKOS_LAMBDA(const Index v) {
        for (int d = 0; d < 3; ++d)
          eta(3 * v + d) = reciprocal[3 * d] * xyz(3 * v) + reciprocal[3 * d + 1] * xyz(3 * v + 1) +
                           reciprocal[3 * d + 2] * xyz(3 * v + 2);
      });
  return eta;
}

/// The mean of the corners of each cut element's boundary, η.
std::vector<Vec3> element_origins(const CoverArrays& covers, const std::vector<Real>& eta) {
  std::vector<Vec3> origins;
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const Index first = 3 * covers.triangle_begin[covers.piece_begin[e]],
                last = 3 * covers.triangle_begin[covers.piece_begin[e + 1]];
    Vec3 sum{};
    for (Index c = first; c < last; ++c)
      for (int d = 0; d < 3; ++d) sum[d] += eta[3 * covers.triangle_vertex[c] + d];
    origins.push_back(1.0 / std::max(last - first, Index{1}) * sum);
  }
  return origins;
}

/// [Q][3] of the element of each piece.
std::vector<Real> of_pieces(const CoverArrays& covers, const std::vector<Vec3>& origins) {
  std::vector<Real> result;
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      result.insert(result.end(), origins[e].begin(), origins[e].end());
  return result;
}

void report_bad_piece(const CoverArrays& covers, Index q, Real volume) {
  Index e = 0;
  while (e < covers.cut_count() && covers.piece_begin[e + 1] <= q) ++e;
  throw Error(ErrorKind::analysis,
              "piece " + std::to_string(q) + " of manifold element " +
                  std::to_string(covers.parts_per_cell() * covers.regular_count() + e) +
                  " is inside out: its volume is " + std::to_string(volume) + " m3, expected > 0");
}

}  // namespace

int moment_degree(const CoverArrays& covers) {
  const int weights = covers.lattice.kind == LatticeKind::block  ? 0
                      : covers.lattice.kind == LatticeKind::hex8 ? 3
                                                                 : 1;
  return std::max(2 * (weights + covers.order), 2);
}

PieceMoments piece_moments(const CoverArrays& covers) {
  return piece_moments(covers, moment_degree(covers));
}

PieceMoments piece_moments(const CoverArrays& covers, int degree) {
  const Index pieces = covers.piece_count();
  const std::size_t terms = integrate::count_to(degree);
  PieceMoments result;
  result.degree = degree;
  Boundary boundary{device::to_device("integrate::triangle_begin", covers.triangle_begin),
                    device::to_device("integrate::triangle_vertex", covers.triangle_vertex),
                    local_vertices(covers),
                    {}};
  const auto moments = device::allocate<Real>("integrate::moments", terms * pieces);
  Array<Real> amid;
  if (degree > 2) {  // slopes of the functions below are constant
    result.origin = element_origins(covers, device::to_host(boundary.eta));
    boundary.origin =
        device::to_device("integrate::piece_origin", of_pieces(covers, result.origin));
    amid = device::allocate<Real>("integrate::amid", terms * pieces);
  }
  const Index bad = integrate_pieces(boundary, pieces, degree, moments, amid);

  result.local = device::to_host(moments);
  if (degree > 2) result.amid = device::to_host(amid);
  const Real cell = cell_volume(covers.lattice);
  for (Real& m : result.local) m *= cell;
  for (Real& m : result.amid) m *= cell;
  result.volume.resize(pieces);
  result.first.resize(pieces);
  for (std::size_t q = 0; q < result.volume.size(); ++q) {
    const Real* m = &result.local[terms * q];
    result.volume[q] = m[0];
    for (int d = 0; d < 3; ++d) result.first[q] += m[1 + d] * covers.lattice.edge[d];
  }
  if (bad < pieces) report_bad_piece(covers, bad, result.volume[bad]);
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
