#include "host/flatten/lost_contact.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// Share of a joint's area.
constexpr Real explained = 1e-6;
constexpr Real rounding = 1e-9;  // of a face's area

bool is_joint(const BlockArrays& blocks, Index face) {
  const Index origin = blocks.face_origin[face];
  return origin != none && blocks.origins[origin].kind == FaceOrigin::Kind::joint;
}

// A joint leans on a joint's face that looks at it. A free face, or one that looks away, belongs to another place.
bool is_contact(const BlockArrays& blocks, const BlockArrays::Interface& shared) {
  const auto is_free = [&](Index face) {
    const Index origin = blocks.face_origin[face];
    return origin != none && blocks.origins[origin].kind == FaceOrigin::Kind::solid_face;
  };
  return !is_free(shared.face[0]) && !is_free(shared.face[1]) &&
         dot(blocks.face_normal[shared.face[0]], blocks.face_normal[shared.face[1]]) < 0;
}

/// m: the mean of its outer corners.
Vec3 middle_of(const BlockArrays& blocks, Index face) {
  const Index loop = blocks.loop_begin[face], begin = blocks.corner_begin[loop],
              end = blocks.corner_begin[loop + 1];
  Vec3 sum{};
  for (Index c = begin; c < end; ++c) sum += blocks.vertex[blocks.corner_vertex[c]];
  return (1.0 / static_cast<Real>(end - begin)) * sum;
}

}  // namespace

std::vector<LostContact> lost_contact(const BlockArrays& blocks) {
  std::vector<Real> missing = blocks.face_area;  // [faces] m²
  for (const auto& shared : blocks.interfaces)
    if (is_contact(blocks, shared))
      for (const Index face : shared.face) missing[face] -= shared.area;
  std::vector<Real> whole(blocks.origins.size(), 0);  // [origins] m², of one side
  for (Index f = 0; f < blocks.face_begin.back(); ++f)
    if (is_joint(blocks, f)) whole[blocks.face_origin[f]] += blocks.face_area[f] / 2;
  std::vector<LostContact> list;
  std::vector<std::size_t> entry(blocks.origins.size(), 0);  // [origins] of the block, from 1
  for (Index b = 0; b < blocks.block_count(); ++b) {
    std::vector<LostContact> of_block;
    std::vector<Real> most;
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f) {
      if (!is_joint(blocks, f)) continue;
      std::size_t& at = entry[blocks.face_origin[f]];
      if (at == 0) {
        of_block.push_back({.block = b, .origin = blocks.face_origin[f]});
        most.push_back(0);
        at = of_block.size();
      }
      LostContact& sum = of_block[at - 1];
      sum.area += blocks.face_area[f];
      if (std::abs(missing[f]) <= rounding * blocks.face_area[f]) continue;
      if (missing[f] > 0)
        sum.lost += missing[f];
      else
        sum.surplus -= missing[f];
      if (std::abs(missing[f]) > most[at - 1]) {
        most[at - 1] = std::abs(missing[f]);
        sum.place = middle_of(blocks, f);
      }
    }
    for (const LostContact& sum : of_block) {
      entry[sum.origin] = 0;
      if (std::max(sum.lost, sum.surplus) > explained * whole[sum.origin]) list.push_back(sum);
    }
  }
  return list;
}

}  // namespace rockfold
