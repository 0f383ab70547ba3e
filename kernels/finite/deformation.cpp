#include <cmath>

#include "kernels/device/sums_kernel.hpp"
#include "kernels/finite/cover_force_kernel.hpp"
#include "kernels/finite/strain_kernel.hpp"
#include "kernels/finite/tangent_row_kernel.hpp"
#include "kernels/operator/elements/assemble_kernel.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::finite {

namespace {

using device::to_device;

/// m above its cell's centre, of a cut element's centroid.
Real centroid_height(const CoverArrays& covers, const PieceMoments& moments, Index cut) {
  Real volume = 0, above = 0;
  for (Index q = covers.piece_begin[cut]; q < covers.piece_begin[cut + 1]; ++q) {
    volume += moments.volume[q];
    above += moments.first[q][2];
  }
  return volume > 0 ? above / volume : 0;
}

/// S₀ at the quadrature points. Before anything has moved S₀ is the Cauchy stress. One point stands for all of its element:
/// the stress there is the mean, that of the centroid.
std::vector<Real> initial_stress(const CoverArrays& covers, const PieceMoments& moments,
                                 const Quadrature& quadrature, const InitialStress& initial) {
  std::vector<Real> stress;
  if (!initial.any) return stress;
  const Index whole = covers.parts_per_cell() * covers.regular_count();
  for (Index e = 0; e < covers.element_count(); ++e) {
    const Vec3 centre = covers.lattice.cell_centre(element_nodes(covers, e).cell);
    for (int q = 0; q < quadrature.points; ++q) {
      const Vec3& eta = quadrature.place[quadrature.kind[e] * quadrature.points + q];
      Real z = centre[2];
      for (int d = 0; d < 3; ++d) z += eta[d] * covers.lattice.edge[d][2];
      if (quadrature.points == 1 && e >= whole)
        z = centre[2] + centroid_height(covers, moments, e - whole);
      for (int k = 0; k < 6; ++k)
        stress.push_back(initial.at[k] + (initial.reference_z - z) * initial.gradient[k]);
    }
  }
  return stress;
}

/// Gradients as Deformation has them.
std::vector<Real> in_columns(const Quadrature& quadrature, int stride) {
  const std::size_t points = quadrature.place.size();
  std::vector<Real> column(3 * points * stride, 0);
  for (std::size_t q = 0; q < points; ++q)
    for (int m = 0; m < quadrature.functions; ++m)
      for (int d = 0; d < 3; ++d)
        column[(3 * q + d) * stride + m] = quadrature.gradient[q * quadrature.functions + m][d];
  return column;
}

/// Covers to elements, ascending.
void add_transpose(const std::vector<Index>& cover, Deformation& body) {
  std::vector<Index> begin(static_cast<std::size_t>(body.covers) + 1, 0);
  for (const Index p : cover) ++begin[p + 1];
  for (Index p = 0; p < body.covers; ++p) begin[p + 1] += begin[p];
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  std::vector<std::int64_t> entry(cover.size());
  for (std::size_t i = 0; i < cover.size(); ++i)
    entry[end[cover[i]]++] = static_cast<std::int64_t>(i);
  body.begin = to_device("finite::begin", begin);
  body.entry = to_device("finite::entry", entry);
}

/// F and S that the rule takes at a point.
KOKKOS_INLINE_FUNCTION void state_at(const Deformation& body, const ForceRule& rule, Index e, int q,
                                     Real* h, Real* s) {
  const std::size_t at = static_cast<std::size_t>(e) * body.points + q;
  const Real *before = &body.start(9 * at), *after = &body.now(9 * at);
  const solve::Elastic& material = body.elastic(body.material(e));
  for (int k = 0; k < 6; ++k) s[k] = body.initial.extent(0) == 0 ? 0 : body.initial(6 * at + k);
  Real strain[6], old[6] = {};
  green_strain(after, strain);
  const Real viscosity = rule.viscosity_of(e);
  if (rule.middle || viscosity > 0) green_strain(before, old);
  add_elastic_stress(material, rule.middle ? 0.5 : 1, strain, s);
  if (rule.middle) add_elastic_stress(material, 0.5, old, s);
  if (viscosity > 0) {
    for (int k = 0; k < 6; ++k) strain[k] -= old[k];
    add_elastic_stress(material, viscosity, strain, s);
    if (rule.carries) add_elastic_stress(material, 1, &body.carried(6 * at), s);
  }
  for (int i = 0; i < 9; ++i) h[i] = rule.middle ? 0.5 * (before[i] + after[i]) : after[i];
}

}  // namespace

Deformation make_deformation(const CoverArrays& covers, const PieceMoments& moments,
                             const std::vector<ElasticMaterial>& materials,
                             const InitialStress& initial) {
  const Quadrature quadrature = make_quadrature(covers, moments);
  Deformation body;
  body.elements = covers.element_count();
  body.covers = covers.cover_count();
  body.nodes = covers.nodes_per_part();
  body.functions = covers.functions();
  body.points = quadrature.points;
  std::vector<Index> cover, material;
  for (Index e = 0; e < body.elements; ++e) {
    const ElementNodes nodes = element_nodes(covers, e);
    cover.insert(cover.end(), nodes.cover.begin(), nodes.cover.begin() + body.nodes);
    const Index regular = covers.parts_per_cell() * covers.regular_count();
    material.push_back(e < regular ? covers.regular_material[e / covers.parts_per_cell()]
                                   : covers.element_material[e - regular]);
  }
  body.stride = padded(body.width());
  body.gradient = to_device("finite::gradient", in_columns(quadrature, body.stride));
  body.kind = to_device("finite::kind", quadrature.kind);
  body.weight = to_device("finite::weight", quadrature.weight);
  body.cover = to_device("finite::cover", cover);
  body.material = to_device("finite::material", material);
  body.elastic = to_device("finite::elastic", solve::make_elastic(materials));
  body.initial = to_device("finite::initial", initial_stress(covers, moments, quadrature, initial));
  add_transpose(cover, body);
  const std::size_t size = 9 * static_cast<std::size_t>(body.elements) * body.points;
  body.start = Array<Real>("rockfold::finite::start", size);
  body.now = Array<Real>("rockfold::finite::now", size);
  body.force = device::allocate<Real>("finite::force", size);
  return body;
}

void deform(const Deformation& body, const Field& displacement) {
  device::for_each(
      "rockfold::finite::deform", body.elements, KOKKOS_LAMBDA(const Index e) {
        for (int q = 0; q < body.points; ++q)
          gradient_at(body, displacement, e, q,
                      &body.now(9 * (static_cast<std::size_t>(e) * body.points + q)));
      });
}

void keep(const Deformation& body) {
  Kokkos::deep_copy(body.start, body.now);
}

void carry_rate(Deformation& body, const Field& velocity, Real of_velocity,
                const Field& acceleration, Real of_acceleration) {
  const std::size_t size = 6 * static_cast<std::size_t>(body.elements) * body.points;
  if (body.carried.extent(0) == 0) body.carried = device::allocate<Real>("finite::carried", size);
  const Deformation b = body;
  device::for_each(
      "rockfold::finite::carry_rate", b.elements, KOKKOS_LAMBDA(const Index e) {
        for (int q = 0; q < b.points; ++q) {
          const std::size_t at = static_cast<std::size_t>(e) * b.points + q;
          Real v[9], a[9];
          gradient_at(b, velocity, e, q, v);
          gradient_at(b, acceleration, e, q, a);
          strain_rate(&b.start(9 * at), v, a, of_velocity, of_acceleration, &b.carried(6 * at));
        }
      });
}

Real viscous_work(const Deformation& body, Real viscosity, const Array<Real>& more,
                  const Array<Real>& partial, const Array<Real>& sums) {
  ForceRule rule;
  rule.viscosity = viscosity;
  rule.stiffening = more;
  device::sum_then<1>(
      "rockfold::finite::viscous_work", body.elements, partial,
      KOKKOS_LAMBDA(const Index e, device::Sums<1>& sum) {
        for (int q = 0; q < body.points; ++q) {
          const std::size_t at = static_cast<std::size_t>(e) * body.points + q;
          Real strain[6], old[6], s[6] = {0, 0, 0, 0, 0, 0};
          green_strain(&body.now(9 * at), strain);
          green_strain(&body.start(9 * at), old);
          for (int k = 0; k < 6; ++k) strain[k] -= old[k];
          add_elastic_stress(body.elastic(body.material(e)), rule.viscosity_of(e), strain, s);
          for (int k = 0; k < 6; ++k)
            sum.value[0] += body.weight(at) * (k < 3 ? 1 : 2) * s[k] * strain[k];
        }
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { sums(0) = sum.value[0]; });
  return device::to_host(sums)[0];
}

void internal_forces(const Deformation& body, const ForceRule& rule, const Field& f) {
  device::for_each(
      "rockfold::finite::point_forces", body.elements, KOKKOS_LAMBDA(const Index e) {
        for (int q = 0; q < body.points; ++q) {
          const std::size_t at = static_cast<std::size_t>(e) * body.points + q;
          Real h[9], s[6];
          state_at(body, rule, e, q, h, s);
          first_stress(h, s, &body.force(9 * at));
          for (int i = 0; i < 9; ++i) body.force(9 * at + i) *= body.weight(at);
        }
      });
  device::for_each(
      "rockfold::finite::row_forces", body.covers, KOKKOS_LAMBDA(const Index p) {
        for (int k = 0; k < body.functions; ++k) {
          Real sum[3] = {0, 0, 0};
          for (Index s = body.begin(p); s < body.begin(p + 1); ++s) {
            const Index e = static_cast<Index>(body.entry(s) / body.nodes);
            const int i = static_cast<int>(body.entry(s) % body.nodes) * body.functions + k;
            for (int q = 0; q < body.points; ++q) {
              const Real* g = body.gradients(e, q) + i;
              const Real* stress = &body.force(9 * (static_cast<std::size_t>(e) * body.points + q));
              for (int d = 0; d < 3; ++d)
                for (int j = 0; j < 3; ++j) sum[d] += stress[3 * d + j] * g[j * body.stride];
            }
          }
          for (int d = 0; d < 3; ++d) f(k * body.covers + p, d) = sum[d];
        }
      });
}

Real strain_energy(const Deformation& body, const Array<Real>& partial, const Array<Real>& sums) {
  device::sum_then<1>(
      "rockfold::finite::strain_energy", body.elements, partial,
      KOKKOS_LAMBDA(const Index e, device::Sums<1>& sum) {
        for (int q = 0; q < body.points; ++q) {
          const std::size_t at = static_cast<std::size_t>(e) * body.points + q;
          Real strain[6], s[6] = {0, 0, 0, 0, 0, 0};
          green_strain(&body.now(9 * at), strain);
          add_elastic_stress(body.elastic(body.material(e)), 0.5, strain, s);
          if (body.initial.extent(0) > 0)
            for (int k = 0; k < 6; ++k) s[k] += body.initial(6 * at + k);
          for (int k = 0; k < 6; ++k)
            sum.value[0] += body.weight(at) * (k < 3 ? 1 : 2) * s[k] * strain[k];
        }
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { sums(0) = sum.value[0]; });
  return device::to_host(sums)[0];
}

void mean_stress(const Deformation& body, const Array<Real>& stress) {
  device::for_each(
      "rockfold::finite::mean_stress", body.elements, KOKKOS_LAMBDA(const Index e) {
        Real sum[6] = {0, 0, 0, 0, 0, 0}, volume = 0;
        for (int q = 0; q < body.points; ++q) {
          const std::size_t at = static_cast<std::size_t>(e) * body.points + q;
          Real h[9], s[6], cauchy[6];
          state_at(body, {}, e, q, h, s);
          cauchy_stress(h, s, cauchy);
          volume += body.weight(at);
          for (int k = 0; k < 6; ++k) sum[k] += body.weight(at) * cauchy[k];
        }
        for (int k = 0; k < 6; ++k) stress(6 * static_cast<std::size_t>(e) + k) = sum[k] / volume;
      });
}

Index first_inverted(const Deformation& body, Real least) {
  const Real found = device::largest(
      "rockfold::finite::inverted", body.elements, KOKKOS_LAMBDA(const Index e) {
        const solve::Elastic& material = body.elastic(body.material(e));
        Real force = 0;
        bool inverted = false;
        for (int q = 0; q < body.points; ++q) {
          const std::size_t at = static_cast<std::size_t>(e) * body.points + q;
          if (!(body.weight(at) > 0)) continue;
          const Real* g = body.gradients(e, q);
          Real steepest = 0;
          for (int m = 0; m < 3 * body.stride; ++m)
            steepest = device::math::fmax(steepest, device::math::fabs(g[m]));
          force += body.weight(at) * (material.lambda + 2 * material.mu) * steepest;
          Real f[9];
          for (int i = 0; i < 9; ++i) f[i] = body.now(9 * at + i) + (i % 4 == 0 ? 1 : 0);
          inverted = inverted || !(determinant(f) > 0);
        }
        if (inverted && force > least) return static_cast<Real>(body.elements - e);
        return Real(0);
      });
  return found > 0 ? body.elements - static_cast<Index>(found) : none;
}

Real largest_terms(const Deformation& body, const Field& d) {
  return device::largest(
      "rockfold::finite::largest_terms", body.elements, KOKKOS_LAMBDA(const Index e) {
        const Index* cover = &body.cover(static_cast<std::size_t>(e) * body.nodes);
        const Real* g = body.gradients(e, 0);
        Real sum[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0}, most = 0;
        for (int a = 0; a < body.nodes; ++a)
          for (int k = 0; k < body.functions; ++k, ++g)
            for (int i = 0; i < 3; ++i) {
              const Real u = d(k * body.covers + cover[a], i);
              for (int j = 0; j < 3; ++j) {
                const Real term = u * g[j * body.stride];
                sum[3 * i + j] += term * term;
              }
            }
        for (const Real term : sum) most = device::math::fmax(most, term);
        return device::math::sqrt(most);
      });
}

Real rounding_force(const Deformation& body, const Array<Real>& partial, const Array<Real>& sums) {
  constexpr Real rounding = 6.4e-17;  // on average: 2⁻⁵² / √12
  device::sum_then<1>(
      "rockfold::finite::rounding_force", body.elements, partial,
      KOKKOS_LAMBDA(const Index e, device::Sums<1>& sum) {
        const solve::Elastic& material = body.elastic(body.material(e));
        for (int q = 0; q < body.points; ++q) {
          const Real* g = body.gradients(e, q);
          const Real stress = body.weight(static_cast<std::size_t>(e) * body.points + q) *
                              (material.lambda + 2 * material.mu);
          for (int m = 0; m < 3 * body.stride; ++m) sum.value[0] += stress * stress * g[m] * g[m];
        }
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { sums(0) = sum.value[0]; });
  return rounding * std::sqrt(device::to_host(sums)[0]);
}

namespace {

/// Of an element: eight nodes.
constexpr int most_width = padded(8 * most_functions);
/// So many points are taken together.
constexpr int point_batch = 16;

/// Everything at a point that entries of the stiffness need.
struct PointStiffness {
  Real f[9], left[6], stress[6];  ///< F, FFᵀ, S
  Real lambda, mu;                ///< with the point's weight
};

/// The stiffness between functions of gradients gi and gj is, with p = F g,
///   λ p_i p_jᵀ + μ p_j p_iᵀ + (g_i·g_j) μ FFᵀ + (g_i·S g_j) I
/// Entry (r, c) is term[3r + c] · g_j.
KOKKOS_INLINE_FUNCTION void stiffness_terms(const PointStiffness& at, const Real* gi, Real* term) {
  Real pi[3], geometric[3];
  for (int r = 0; r < 3; ++r) {
    pi[r] = at.f[3 * r] * gi[0] + at.f[3 * r + 1] * gi[1] + at.f[3 * r + 2] * gi[2];
    geometric[r] = 0;
    for (int m = 0; m < 3; ++m) geometric[r] += gi[m] * entry(at.stress, m, r);
  }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const Real dot = at.mu * entry(at.left, r, c);
      for (int m = 0; m < 3; ++m)
        term[3 * (3 * r + c) + m] = at.lambda * pi[r] * at.f[3 * c + m] +
                                    at.mu * pi[c] * at.f[3 * r + m] + dot * gi[m] +
                                    (r == c ? geometric[m] : 0);
    }
}

KOKKOS_INLINE_FUNCTION PointStiffness stiffness_at(const Deformation& body, const ForceRule& rule,
                                                   Index e, int q) {
  PointStiffness at;
  const Real weight = body.weight(static_cast<std::size_t>(e) * body.points + q);
  Real h[9];
  state_at(body, rule, e, q, h, at.stress);
  for (int i = 0; i < 9; ++i) at.f[i] = h[i] + (i % 4 == 0 ? 1 : 0);
  for (int k = 0; k < 6; ++k) {
    const int i = k < 3 ? k : k - 3, j = k < 3 ? k : (k - 2) % 3;
    at.left[k] = 0;
    for (int m = 0; m < 3; ++m) at.left[k] += at.f[3 * i + m] * at.f[3 * j + m];
    at.stress[k] *= rule.geometric ? weight : 0;
  }
  const solve::Elastic& material = body.elastic(body.material(e));
  const Real stiffer = weight * (1 + (rule.middle ? 2 : 1) * rule.viscosity_of(e));
  at.lambda = stiffer * material.lambda;
  at.mu = stiffer * material.mu;
  return at;
}

/// row[9][stride] = couplings of function i of an element with all of its functions.
KOKKOS_INLINE_FUNCTION void element_row(const Deformation& body, const ForceRule& rule, Index e,
                                        int i, Real* row) {
  for (int m = 0; m < 9 * body.stride; ++m) row[m] = 0;
  for (int first = 0; first < body.points; first += point_batch) {
    const int count = body.points - first < point_batch ? body.points - first : point_batch;
    Real term[27 * point_batch];
    for (int q = 0; q < count; ++q) {
      const Real* g = body.gradients(e, first + q) + i;
      const Real gi[3] = {g[0], g[body.stride], g[2 * body.stride]};
      stiffness_terms(stiffness_at(body, rule, e, first + q), gi, term + 27 * q);
    }
    const Real* gradient = body.gradients(e, first);
    if constexpr (device::on_gpu)
      add_products(count, term, gradient, body.stride, row);
    else
      add_products_on_core(count, term, gradient, body.stride, row);
  }
}

}  // namespace

void assemble_tangent(const Deformation& body, const ForceRule& rule,
                      const solve::DeviceBlocks& block) {
  device::for_each(
      "rockfold::finite::tangent", block.slots() * body.functions,
      KOKKOS_LAMBDA(const Index row_id) {
        const int k = row_id % body.functions;
        const solve::RowSink sink(block, row_id / body.functions, k);
        const Index p = sink.cover();
        if (p == none) return;
        sink.clear_stiffness();
        for (Index s = body.begin(p); s < body.begin(p + 1); ++s) {
          const Index e = static_cast<Index>(body.entry(s) / body.nodes);
          const int i = static_cast<int>(body.entry(s) % body.nodes) * body.functions + k;
          Real row[9 * most_width];
          element_row(body, rule, e, i, row);
          for (int b = 0; b < body.nodes; ++b) {
            const Index at = sink.find(body.cover(static_cast<std::size_t>(e) * body.nodes + b));
            for (int l = 0; l < body.functions; ++l) {
              Real entry[9];
              for (int m = 0; m < 9; ++m) entry[m] = row[m * body.stride + b * body.functions + l];
              sink.add(at, l, entry, 9);
            }
          }
        }
      },
      body.points * body.functions);
}

namespace {

/// Mean of F end · (F middle)⁻¹ over the elements of a cover, as a rotation; false: none to be had.
KOKKOS_INLINE_FUNCTION bool turn_of_cover(const Deformation& body, Index p, Real* turn) {
  for (int i = 0; i < 9; ++i) turn[i] = 0;
  for (Index s = body.begin(p); s < body.begin(p + 1); ++s)
    for (int q = 0; q < body.points; ++q) {
      const std::size_t at = static_cast<std::size_t>(body.entry(s) / body.nodes) * body.points + q;
      Real middle[9], inverse[9], end[9];
      for (int i = 0; i < 9; ++i) {
        const Real one = i % 4 == 0 ? 1 : 0;
        end[i] = body.now(9 * at + i) + one;
        middle[i] = 0.5 * (body.now(9 * at + i) + body.start(9 * at + i)) + one;
      }
      if (!(invert(middle, inverse) > 0)) continue;
      const Real share = device::math::fabs(body.weight(at));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int m = 0; m < 3; ++m)
            turn[3 * i + j] += share * end[3 * i + m] * inverse[3 * m + j];
    }
  const Real size = device::math::cbrt(determinant(turn));
  if (!(size > 0)) return false;
  for (int i = 0; i < 9; ++i) turn[i] /= size;
  return make_rotation(turn);
}

}  // namespace

void turn_from_middle(const Deformation& body, const Field& x) {
  device::for_each(
      "rockfold::finite::turn", body.covers, KOKKOS_LAMBDA(const Index p) {
        Real turn[9];
        if (!turn_of_cover(body, p, turn)) return;
        for (int k = 0; k < body.functions; ++k) {
          const Index row = k * body.covers + p;
          const Real given[3] = {x(row, 0), x(row, 1), x(row, 2)};
          for (int i = 0; i < 3; ++i)
            x(row, i) =
                turn[3 * i] * given[0] + turn[3 * i + 1] * given[1] + turn[3 * i + 2] * given[2];
        }
      });
}

}  // namespace rockfold::finite
