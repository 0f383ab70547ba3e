#include "src/arrays/shape_functions.hpp"

#include "src/base/vector.hpp"

namespace rockfold {

std::array<Real, most_functions> cover_functions(const Vec3& xi, int functions) {
  std::array<Real, most_functions> m{1};
  if (functions > 1)
    for (int d = 0; d < 3; ++d) m[1 + d] = xi[d];
  if (functions > 4)
    for (int d = 0; d < 3; ++d) m[4 + d] = xi[d] * xi[d], m[7 + d] = xi[d] * xi[(d + 1) % 3];
  return m;
}

std::array<Real, 8> part_weights(const CellPart& part, const Vec3& eta) {
  std::array<Real, 8> monomial{1};
  for (int m = 1; m < 8; ++m) {
    const int d = (m & 1) != 0 ? 0 : (m & 2) != 0 ? 1 : 2;
    monomial[m] = eta[d] * monomial[m & ~(1 << d)];
  }
  std::array<Real, 8> weight{};
  for (int a = 0; a < part.nodes; ++a)
    for (int m = 0; m < 8; ++m) weight[a] += part.weight[a][m] * monomial[m];
  return weight;
}

ElementNodes element_nodes(const CoverArrays& covers, Index element) {
  const int parts = covers.parts_per_cell(), per_part = covers.nodes_per_part();
  ElementNodes nodes;
  if (element < parts * covers.regular_count()) {
    const Index r = element / parts;
    nodes.cell = covers.regular_cell[r];
    nodes.part = element % parts;
    const CellPart& part = covers.lattice.split(nodes.cell).part[nodes.part];
    for (int a = 0; a < per_part; ++a)
      nodes.cover[a] = covers.regular_cover[covers.nodes_per_cell() * r + part.node[a]];
  } else {
    const Index e = element - parts * covers.regular_count();
    nodes.cell = covers.element_cell[e];
    nodes.part = covers.element_part[e];
    for (int a = 0; a < per_part; ++a) nodes.cover[a] = covers.element_cover[per_part * e + a];
  }
  return nodes;
}

namespace {

void add_unknowns(const CoverArrays& covers, const Vec3& local, Index element, Real share,
                  MaterialPoints& points) {
  const ElementNodes nodes = element_nodes(covers, element);
  const CellSplit& split = covers.lattice.split(nodes.cell);
  const CellPart& part = split.part[nodes.part];
  const Vec3 eta = covers.lattice.to_local(local);
  const auto weight = part_weights(part, eta);
  for (int a = 0; a < part.nodes; ++a) {
    const HalfSteps& at = split.node[part.node[a]];
    Vec3 xi;
    for (int d = 0; d < 3; ++d) xi[d] = eta[d] - (0.5 * at[d] - 0.5);
    const auto function = cover_functions(xi, covers.functions());
    for (int k = 0; k < covers.functions(); ++k) {
      points.unknown.push_back(k * covers.cover_count() + nodes.cover[a]);
      points.weight.push_back(share * weight[a] * function[k]);
    }
  }
}

}  // namespace

void add_material_point(const CoverArrays& covers, const Vec3& x, Index element,
                        MaterialPoints& points, Index other) {
  points.element.push_back(element);
  if (element == none) {
    points.local.push_back({});
  } else {
    const Vec3 local = x - covers.lattice.cell_centre(element_nodes(covers, element).cell);
    points.local.push_back(local);
    add_unknowns(covers, local, element, other == none ? 1 : 0.5, points);
    if (other != none) add_unknowns(covers, local, other, 0.5, points);
  }
  points.begin.push_back(static_cast<Index>(points.unknown.size()));
}

Vec3 point_position(const CoverArrays& covers, const MaterialPoints& points, std::size_t n) {
  return covers.lattice.cell_centre(element_nodes(covers, points.element[n]).cell) +
         points.local[n];
}

}  // namespace rockfold
