#include "src/run/records/nodal_stress.hpp"

#include <algorithm>
#include <array>

#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

/// Shares that are worked on together: some 10 MB.
constexpr std::size_t chunk = 1 << 17;

/// A point of an element, and the volume of the element's tetrahedra about it.
struct Share {
  Index point = none, element = none;
  Real volume = 0;  ///< m³
};

Real volume(const ElementMesh& mesh, std::size_t t) {
  const auto& corner = mesh.tetrahedron[t];
  const Vec3& x = mesh.point[corner[0]];
  return dot(mesh.point[corner[1]] - x,
             cross(mesh.point[corner[2]] - x, mesh.point[corner[3]] - x)) /
         6;
}

/// Those of the element that tetrahedron t is the first of; moves t on to the next element.
void add_shares(const ElementMesh& mesh, std::size_t& t, std::vector<Share>& shares) {
  const std::size_t begin = shares.size();
  const Index element = mesh.element[t];
  for (; t < mesh.tetrahedron.size() && mesh.element[t] == element; ++t)
    for (const Index k : mesh.tetrahedron[t]) shares.push_back({k, element, volume(mesh, t)});
  const auto first = shares.begin() + static_cast<std::ptrdiff_t>(begin);
  std::stable_sort(first, shares.end(),
                   [](const Share& a, const Share& b) { return a.point < b.point; });
  std::size_t last = begin;
  for (std::size_t i = begin + 1; i < shares.size(); ++i)
    if (shares[i].point == shares[last].point)
      shares[last].volume += shares[i].volume;
    else
      shares[++last] = shares[i];
  shares.resize(last + 1);
}

/// `stress_of` gives the stress of each of some shares.
template <typename StressOf>
std::vector<Stress> average(const ElementMesh& mesh, const StressOf& stress_of) {
  std::vector<Stress> mean(mesh.point_count());
  std::vector<Real> weight(mesh.point_count(), 0.0);
  std::vector<Share> shares;
  for (std::size_t t = 0; t < mesh.tetrahedron.size();) {
    shares.clear();
    while (t < mesh.tetrahedron.size() && shares.size() < chunk) add_shares(mesh, t, shares);
    const std::vector<Stress> stress = stress_of(shares);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const Index k = shares[i].point;
      weight[k] += shares[i].volume;
      for (int c = 0; c < 6; ++c) mean[k][c] += shares[i].volume * stress[i][c];
    }
  }
  for (std::size_t k = 0; k < mean.size(); ++k)
    for (int c = 0; c < 6 && weight[k] > 0; ++c) mean[k][c] /= weight[k];
  return mean;
}

}  // namespace

std::vector<Stress> average_nodal_stress(const CoverArrays& covers, const ElementMesh& mesh,
                                         const Motion& motion) {
  std::vector<Index> element;
  std::vector<Vec3> local;
  return average(mesh, [&](const std::vector<Share>& shares) {
    element.clear();
    local.clear();
    for (const Share& share : shares) {
      element.push_back(share.element);
      const Index cell = element_nodes(covers, share.element).cell;
      local.push_back(mesh.point[share.point] - covers.lattice.cell_centre(cell));
    }
    return motion.stress_at(element, local);
  });
}

std::vector<Stress> average_nodal_stress(const ElementMesh& mesh,
                                         const std::vector<Stress>& element_stress) {
  return average(mesh, [&](const std::vector<Share>& shares) {
    std::vector<Stress> stress;
    stress.reserve(shares.size());
    for (const Share& share : shares) stress.push_back(element_stress[share.element]);
    return stress;
  });
}

bool stress_is_uniform(const CoverArrays& covers, const InitialStress& initial) {
  return covers.functions() == 1 && covers.nodes_per_part() == 4 &&
         initial.gradient == std::array<Real, 6>{};
}

}  // namespace rockfold
