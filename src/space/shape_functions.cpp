#include "src/space/shape_functions.hpp"

#include <string>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// What the monomials of a cover are taken of.
Vec3 argument(const CoverArrays& covers, Index cover, const Vec3& xi) {
  return covers.middle.empty() ? xi : (1 / covers.reach) * (xi - covers.middle[cover]);
}

/// Value and gradient of the monomials, as cover_functions has them. `reciprocal`: gradients of ξ.
void monomials(const Vec3& xi, const Mat3& reciprocal, int functions, FunctionValue* f) {
  const auto value = cover_functions(xi, functions);
  for (int k = 0; k < functions; ++k) f[k] = {value[k], {}};
  for (int d = 0; d < 3; ++d) {
    if (functions > 1) f[1 + d].gradient = reciprocal[d];
    if (functions <= 4) continue;
    const int e = (d + 1) % 3;
    f[4 + d].gradient = 2 * xi[d] * reciprocal[d];
    f[7 + d].gradient = xi[e] * reciprocal[d] + xi[d] * reciprocal[e];
  }
}

/// The weights of a part's nodes with their gradients.
std::array<FunctionValue, 8> weights_with_gradients(const CellPart& part, const Vec3& eta,
                                                    const Mat3& reciprocal) {
  const auto value = part_weights(part, eta);
  std::array<FunctionValue, 8> weight{};
  for (int a = 0; a < part.nodes; ++a) {
    weight[a].value = value[a];
    for (int d = 0; d < 3; ++d) {
      Real slope = 0;  // ∂N_a/∂η_d
      for (int m = 0; m < 8; ++m) {
        if ((m >> d & 1) == 0) continue;
        Real lower = part.weight[a][m];
        for (int e = 0; e < 3; ++e)
          if (e != d && (m >> e & 1) != 0) lower *= eta[e];
        slope += lower;
      }
      weight[a].gradient += slope * reciprocal[d];
    }
  }
  return weight;
}

/// η of a node from its cell's centre.
Vec3 node_place(const CellSplit& split, int node) {
  const HalfSteps& at = split.node[node];
  return {0.5 * at[0] - 0.5, 0.5 * at[1] - 0.5, 0.5 * at[2] - 0.5};
}

}  // namespace

std::array<Real, most_functions> cover_functions(const Vec3& xi, int functions) {
  std::array<Real, most_functions> m{1};
  if (functions > 1)
    for (int d = 0; d < 3; ++d) m[1 + d] = xi[d];
  if (functions > 4)
    for (int d = 0; d < 3; ++d) m[4 + d] = xi[d] * xi[d], m[7 + d] = xi[d] * xi[(d + 1) % 3];
  return m;
}

std::array<Real, most_functions> cover_functions(const CoverArrays& covers, Index cover,
                                                 const Vec3& xi) {
  return cover_functions(argument(covers, cover, xi), covers.functions());
}

Vec3 function_origin(const CoverArrays& covers, Index cover) {
  Vec3 x = covers.lattice.node_position(covers.cover_node[cover]);
  for (int d = 0; d < 3 && !covers.middle.empty(); ++d)
    x += covers.middle[cover][d] * covers.lattice.edge[d];
  return x;
}

int sampling_degree(const CoverArrays& covers) {
  const int nodes = covers.nodes_per_part();
  return covers.order + (nodes == 8 ? 3 : nodes == 4 ? 1 : 0);
}

std::array<Real, 8> part_weights(const CellPart& part, const Vec3& eta) {
  std::array<Real, 8> weight{};
  for (int a = 0; a < part.nodes; ++a) {
    const auto& of = part.weight[a];
    if (part.nodes == 8) {
      // Products: beside the faces across from a node its weight is far below the rounding of a sum of monomials.
      weight[a] = 1;
      for (int d = 0; d < 3; ++d) weight[a] *= 0.5 + 4 * of[1 << d] * eta[d];
    } else {
      weight[a] = of[0] + of[1] * eta[0] + of[2] * eta[1] + of[4] * eta[2];
    }
  }
  return weight;
}

int form_of_cell(const Lattice& lattice, Index cell) {
  return lattice.kind == LatticeKind::tet5 &&
                 &lattice.split(cell) == &cell_split(LatticeKind::tet5, true)
             ? 1
             : 0;
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

Index block_of(const CoverArrays& covers, Index element) {
  const Index parts = covers.parts_per_cell(), whole = parts * covers.regular_count();
  return element < whole ? covers.regular_block[element / parts]
                         : covers.piece_block[covers.piece_begin[element - whole]];
}

Index material_of(const CoverArrays& covers, Index element) {
  const Index parts = covers.parts_per_cell(), whole = parts * covers.regular_count();
  return element < whole ? covers.regular_material[element / parts]
                         : covers.element_material[element - whole];
}

ElementFunctions::ElementFunctions(const CoverArrays& covers)
    : covers_(covers),
      reciprocal_(covers.lattice.reciprocal()),
      of_argument_(reciprocal_),
      functions_(covers.functions()),
      width_(covers.nodes_per_part() * functions_) {
  for (Vec3& row : of_argument_) row = (1 / covers.reach) * row;
}

void ElementFunctions::at(const ElementNodes& element, const Vec3& eta,
                          FunctionValue* function) const {
  const CellSplit& split = covers_.lattice.split(element.cell);
  const CellPart& part = split.part[element.part];
  const auto weight = weights_with_gradients(part, eta, reciprocal_);
  for (int a = 0; a < part.nodes; ++a, function += functions_) {
    const Vec3 xi = eta - node_place(split, part.node[a]);
    monomials(argument(covers_, element.cover[a], xi), of_argument_, functions_, function);
    for (int k = 0; k < functions_; ++k) {
      const FunctionValue of_cover = function[k];
      function[k].value = weight[a].value * of_cover.value;
      function[k].gradient =
          weight[a].value * of_cover.gradient + of_cover.value * weight[a].gradient;
    }
  }
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
    const Vec3 xi = eta - node_place(split, part.node[a]);
    const auto function = cover_functions(covers, nodes.cover[a], xi);
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
