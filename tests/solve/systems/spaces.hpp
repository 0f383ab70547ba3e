// Lattices and cover orders as parameters of tests.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/arrays/lattice.hpp"

namespace rockfold {

struct Space {
  LatticeKind kind;
  int order;
};

inline std::string space_name(const testing::TestParamInfo<Space>& info) {
  const char* names[] = {"tet5", "tet5_mixed", "tet6", "tet6_kuhn", "tet24", "hex8", "block"};
  return std::string(names[static_cast<int>(info.param.kind)]) + "_order" +
         std::to_string(info.param.order);
}

/// All lattices with covers of all orders; `blocks`: also the block lattice with covers of order 1 and 2.
inline std::vector<Space> spaces(bool blocks) {
  std::vector<Space> all;
  for (const LatticeKind kind :
       {LatticeKind::tet5, LatticeKind::tet5_mixed, LatticeKind::tet6, LatticeKind::tet6_kuhn,
        LatticeKind::tet24, LatticeKind::hex8, LatticeKind::block})
    for (int order = 0; order < 3; ++order)
      if (kind != LatticeKind::block || (blocks && order > 0)) all.push_back({kind, order});
  return all;
}

}  // namespace rockfold
