// What any cutting must conserve, whatever the model: checks on the arrays alone, and on a model's joints where its rock
// is one convex solid.
#pragma once

#include <string>
#include <vector>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

/// One line for each rule broken (at most 20). `size` is the model's size in m.
///   Σ volumes = solid volume to `relative`; each block's surface is closed: every edge of its loops is run through once in
///   each sense, vector areas add up to nothing, and it encloses the block's volume; dead-end areas add up to the total;
///   the two sides of the separating joints have the same area, that of the interfaces, which is what is left of the
///   joints' area.
std::vector<std::string> losses(const Blocks& blocks, Real size, Real relative = 1e-12);

/// The area, m², of a simple polygon inside the convex solid { x : normal·(x − point) ≤ 0 for all }. In doubles, by clipping.
struct HalfSpaceOutside {
  Vec3 normal, point;
};
Real clipped_area(const std::vector<Vec3>& polygon, const std::vector<HalfSpaceOutside>& solid);

/// Whether two cuttings made the same blocks: equal counts, and numbers but for rounding, of blocks, of their faces (by origin)
/// and of their dead ends. The first difference, or "".
std::string block_difference(const BlockArrays& a, const BlockArrays& b, Real size);

/// Whether 1, 2 and 4 threads give the same arrays and totals, bit for bit, and three shufflings of the joints the same
/// blocks; one line for each difference.
std::vector<std::string> dependences(const Model& model, Real size, bool shuffle_joints = true);

}  // namespace rockfold::test
