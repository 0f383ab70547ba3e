#include "kernels/integrate/moments.hpp"
#include "kernels/operator/elements/part_functions.hpp"
#include "kernels/time/forces/initial_stress_kernel.hpp"
#include "src/base/vector.hpp"
#include "src/space/element_points.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::motion {
namespace {

/// A whole or cut element with its moments, m³, those of the share of the rock that it stands for.
struct Element {
  ElementNodes nodes;
  int part = 0;  ///< counted through all forms
  std::vector<Real> moment;
};

/// Calls visit(element) for all, in the element numbering of CoverArrays.
template <class Visit>
void for_each_element(const CoverArrays& covers, const LatticeFunctions& functions,
                      const PieceMoments& moments, Visit visit) {
  const Index regular = functions.parts * covers.regular_count();
  const std::size_t terms =
      moments.volume.empty() ? 0 : moments.local.size() / moments.volume.size();
  for (Index e = 0; e < covers.element_count(); ++e) {
    Element element{element_nodes(covers, e), 0, {}};
    element.part =
        element.nodes.part + functions.parts * form_of_cell(covers.lattice, element.nodes.cell);
    if (e < regular) {
      element.moment = functions.part[element.part].moment;
    } else {
      element.moment.assign(terms, 0.0);
      for (Index q = covers.piece_begin[e - regular]; q < covers.piece_begin[e - regular + 1]; ++q)
        for (std::size_t m = 0; m < terms; ++m)
          element.moment[m] += functions.share * moments.local[terms * q + m];
    }
    visit(element);
  }
}

/// Σ σ_ij g_j.
Vec3 pull(const std::array<Real, 6>& s, const Vec3& g) {
  return {s[0] * g[0] + s[3] * g[1] + s[5] * g[2], s[3] * g[0] + s[1] * g[1] + s[4] * g[2],
          s[5] * g[0] + s[4] * g[1] + s[2] * g[2]};
}

/// ∫ p dV and ∫ η_d p dV of a polynomial of `degree`.
std::array<Real, 4> integrals(const Real* p, int degree, const Real* moment) {
  std::array<Real, 4> sum{};
  for (int n = 0, m = 0; n <= degree; ++n)
    for (int a = n; a >= 0; --a)
      for (int b = n - a; b >= 0; --b, ++m) {
        const int c = n - a - b;
        sum[0] += p[m] * moment[monomial_index(a, b, c)];
        sum[1] += p[m] * moment[monomial_index(a + 1, b, c)];
        sum[2] += p[m] * moment[monomial_index(a, b + 1, c)];
        sum[3] += p[m] * moment[monomial_index(a, b, c + 1)];
      }
  return sum;
}

/// Where functions are known at points alone.
std::vector<Vec3> sampled_initial_stress_force(const CoverArrays& covers,
                                               const InitialStress& stress) {
  const ElementPoints rule(covers, sampling_degree(covers));
  const ElementFunctions functions(covers);
  const int n = covers.functions();
  std::vector<Vec3> force(covers.unknown_count());
  std::vector<RockPoint> points;
  std::vector<FunctionValue> value(functions.width());
  for (Index e = 0; e < covers.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(covers, e);
    points.clear();
    rule.add_element(e, points);
    for (const RockPoint& p : points) {
      Real z = covers.lattice.cell_centre(nodes.cell)[2];
      for (int d = 0; d < 3; ++d) z += p.eta[d] * covers.lattice.edge[d][2];
      functions.at(nodes, p.eta, value.data());
      for (int f = 0; f < functions.width(); ++f)
        force[f % n * covers.cover_count() + nodes.cover[f / n]] +=
            p.weight * pull(stress_at(stress, z), value[f].gradient);
    }
  }
  return force;
}

}  // namespace

std::array<Real, 6> stress_at(const InitialStress& stress, Real z) {
  std::array<Real, 6> s;
  for (int k = 0; k < 6; ++k) s[k] = stress.at[k] + (stress.reference_z - z) * stress.gradient[k];
  return s;
}

ElementHeights element_heights(const CoverArrays& covers, const PieceMoments& moments) {
  ElementHeights heights;
  for_each_element(covers, lattice_functions(covers), moments, [&](const Element& e) {
    const Real z = covers.lattice.cell_centre(e.nodes.cell)[2];
    Real above = 0;
    for (int d = 0; d < 3; ++d) above += covers.lattice.edge[d][2] * e.moment[1 + d];
    heights.cell.push_back(z);
    heights.centroid.push_back(e.moment[0] > 0 ? z + above / e.moment[0] : z);
  });
  return heights;
}

std::vector<Vec3> initial_stress_force(const CoverArrays& covers, const PieceMoments& moments,
                                       const InitialStress& stress) {
  if (covers.sampled()) return sampled_initial_stress_force(covers, stress);
  const LatticeFunctions all = lattice_functions(covers);
  std::vector<Vec3> force(covers.unknown_count());
  if (all.degree == 0) return force;  // nothing strains
  for_each_element(covers, all, moments, [&](const Element& e) {
    const auto here = stress_at(stress, covers.lattice.cell_centre(e.nodes.cell)[2]);
    for (int f = 0; f < all.nodes * all.functions; ++f) {
      Vec3 slope{}, slope_times_height{};  // ∫ ∇φ dV, ∫ (z − the cell's z) ∇φ dV
      for (int i = 0; i < 3; ++i) {
        const auto sum = integrals(
            &all.part[e.part].slope[static_cast<std::size_t>(3 * f + i) * all.slope_terms()],
            all.degree - 1, e.moment.data());
        slope[i] = sum[0];
        for (int d = 0; d < 3; ++d) slope_times_height[i] += covers.lattice.edge[d][2] * sum[1 + d];
      }
      force[f % all.functions * covers.cover_count() + e.nodes.cover[f / all.functions]] +=
          pull(here, slope) - pull(stress.gradient, slope_times_height);
    }
  });
  return force;
}

StressBefore make_stress_before(const MotionSetup& setup) {
  const InitialStress& given = setup.initial_stress;
  if (!given.any) return {};
  const ElementHeights heights = element_heights(setup.covers, setup.moments);
  std::vector<Real> law(given.at.begin(), given.at.end());
  law.insert(law.end(), given.gradient.begin(), given.gradient.end());
  law.push_back(given.reference_z);
  return {device::to_device("motion::cell_z", heights.cell),
          device::to_device("motion::centroid_z", heights.centroid),
          device::to_device("motion::stress_law", law)};
}

}  // namespace rockfold::motion
