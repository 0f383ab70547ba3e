// Stresses of elements on the device.
#pragma once

#include "kernels/solve/element_kernel.hpp"

namespace rockfold::update {

using device::Array;
using device::Field;

/// Which covers and which material each element has; see CoverArrays for the numbering.
struct ElementTable {
  Index regular = 0, cut = 0;
  Array<Index> regular_cover, regular_material, element_cover, element_material;
  Array<std::uint8_t> element_part;
  Array<solve::TetTable> tets;
  Array<solve::Elastic> elastic;
  Index count() const { return 6 * regular + cut; }
};
ElementTable make_element_table(const CoverArrays& covers,
                                const std::vector<ElasticMaterial>& materials);

/// Stress of element e (xx yy zz xy yz zx) under the displacement d of the covers.
KOKKOS_INLINE_FUNCTION void stress_of_element(const ElementTable& table, const Field& d, Index e,
                                              Real* stress) {
  const solve::TetTable& tets = table.tets(0);
  Real moved[4][3];
  int tet;
  Index material;
  if (e < 6 * table.regular) {
    tet = e % 6;
    material = table.regular_material(e / 6);
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i)
        moved[a][i] = d(table.regular_cover(8 * (e / 6) + tets.corner[tet][a]), i);
  } else {
    const Index c = e - 6 * table.regular;
    tet = table.element_part(c);
    material = table.element_material(c);
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) moved[a][i] = d(table.element_cover(4 * c + a), i);
  }
  solve::element_stress(table.elastic(material), tets.gradient[tet], moved, stress);
}

}  // namespace rockfold::update
