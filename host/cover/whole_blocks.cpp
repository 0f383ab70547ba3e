#include "host/cover/whole_blocks.hpp"

#include <array>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "host/cut/bodies/union_find.hpp"
#include "src/base/error.hpp"
#include "src/base/place_text.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

// The first split has the even form in every second lattice cell, the odd form in those between.
bool is_of_second_split(const CoverArrays& covers, const ElementNodes& at) {
  const auto [i, j, k] = covers.lattice.cell_ijk(at.cell);
  return (at.part >= covers.first_split_parts()) != (((i + j + k) & 1) != 0);
}

/// Covers that elements join.
UnionFind join_covers(const CoverArrays& covers) {
  UnionFind bodies(covers.cover_count());
  for (Index e = 0; e < covers.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(covers, e);
    for (int a = 1; a < covers.nodes_per_part(); ++a) bodies.join(nodes.cover[0], nodes.cover[a]);
  }
  return bodies;
}

}  // namespace

// Within one split all elements of a body are connected. Those of both are, if they share a cover.
void refuse_halved_blocks(const CoverSpec& cover, const CoverArrays& covers) {
  if (covers.first_split_parts() == covers.parts_per_cell()) return;
  UnionFind bodies = join_covers(covers);
  std::vector<std::array<bool, 2>> has(covers.cover_count());  // elements of each split, by body
  for (Index e = 0; e < covers.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(covers, e);
    has[bodies.find(nodes.cover[0])][is_of_second_split(covers, nodes) ? 1 : 0] = true;
  }
  const Index whole = covers.parts_per_cell() * covers.regular_count();
  for (Index e = whole; e < covers.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(covers, e);
    const auto& [first, second] = has[bodies.find(nodes.cover[0])];
    if (first && second) continue;
    const Index block = block_of(covers, e);
    const Vec3 at = covers.lattice.cell_centre(nodes.cell);
    throw Error(
        ErrorKind::model,
        fmt::format(
            "block {} lies in the middle of the lattice cell about {}, "
            "where the two forms of \"tet5\" have no node in common: each would "
            "move half of the block; use mixed = false, another lattice or a smaller spacing",
            block + 1, place_text(at)),
        Place{cover.place.file, cover.place.line, cover.place.column, "cover.mixed"});
  }
}

void refuse_parted_blocks(const CoverSpec& cover, const CoverArrays& covers) {
  if (cover.joints == JointTreatment::welded || cover.joint_tips == JointTips::extend) return;
  UnionFind bodies = join_covers(covers);
  std::vector<Index> body_of;  // [blocks] that of its first element
  for (Index e = 0; e < covers.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(covers, e);
    const Index block = block_of(covers, e), body = bodies.find(nodes.cover[0]);
    if (block >= std::ssize(body_of)) body_of.resize(static_cast<std::size_t>(block) + 1, none);
    if (body_of[block] == none) body_of[block] = body;
    if (body_of[block] == body) continue;
    const Vec3 at = covers.lattice.cell_centre(nodes.cell);
    throw Error(
        ErrorKind::model,
        fmt::format("block {} would come apart in its covers about {}: "
                    "joints that all but coincide, or surfaces that miss each other by next to "
                    "nothing, leave rock of no width between its parts; move one of them, or leave "
                    "it out",
                    block + 1, place_text(at)),
        Place{cover.place.file, cover.place.line, cover.place.column, "cover"});
  }
}

}  // namespace rockfold
