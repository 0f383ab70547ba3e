// Boxes with finite joints (rectangles on the integer grid) and dug boxes, with the exact answers of an enumeration
// independent of this program and of voxel_oracle.
#pragma once

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "tests/cut/oracles/voxel_oracle.hpp"

namespace rockfold::test {

struct FiniteJointCase {
  /// `count` blocks. Here a dead-end joint is an open slit, part of the block's boundary: euler of the open block, genus
  /// and cavities count it.
  struct Block {
    int count, volume, euler, genus, cavities;
  };
  std::string name, title;
  std::array<int, 3> size;
  std::vector<GridJoint> joints;
  std::vector<GridBox> voids;
  std::vector<Block> blocks;
  int separating, dead_ends;  ///< unit squares
};

inline std::ostream& operator<<(std::ostream& out, const FiniteJointCase& c) {
  return out << c.title;
}

const std::vector<FiniteJointCase>& finite_joint_cases();

GridModel grid_model(const FiniteJointCase& c);

}  // namespace rockfold::test
