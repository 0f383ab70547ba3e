#include "host/bolting/shotcrete.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

bool is_sprayed(const FaceOrigin& origin, const std::vector<WallFaces>& walls) {
  if (origin.kind == FaceOrigin::Kind::joint || origin.continues) return false;
  return std::any_of(walls.begin(), walls.end(),
                     [&](const WallFaces& wall) { return wall.hold(origin); });
}

}  // namespace

ShotcreteCover::ShotcreteCover(const BlockArrays& blocks, const Shotcrete& shotcrete)
    : blocks_(blocks),
      interfaces_(blocks),
      strength_(shotcrete.shear_strength * shotcrete.thickness) {
  if (shotcrete.adhesion_strength)
    strength_ = std::min(strength_, *shotcrete.adhesion_strength * shotcrete.bond_width);
  for (const FaceOrigin& origin : blocks.origins)
    sprayed_.push_back(is_sprayed(origin, shotcrete.on));
}

bool ShotcreteCover::is_inside(Index face, const std::vector<Index>& members) const {
  const auto neighbours = interfaces_.of_face(face);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const FaceInterfaces::Neighbour& c) {
    return std::find(members.begin(), members.end(), c.block) != members.end();
  });
}

void ShotcreteCover::add(Index block, const std::vector<Index>& members, ShotcreteHold& sum) const {
  // Each edge of a sprayed face once, with that face; none where two sprayed faces share it, or one and a joint inside.
  std::map<std::pair<Index, Index>, Index> edges;
  std::vector<std::pair<Index, Index>> closed;
  for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f) {
    const bool sprayed = sprayed_[blocks_.face_origin[f]];
    if (!sprayed && (members.size() < 2 || !is_inside(f, members))) continue;
    for (Index loop = blocks_.loop_begin[f]; loop < blocks_.loop_begin[f + 1]; ++loop) {
      const Index first = blocks_.corner_begin[loop], end = blocks_.corner_begin[loop + 1];
      for (Index c = first, before = end - 1; c < end; before = c++) {
        const auto key = std::minmax(blocks_.corner_vertex[c], blocks_.corner_vertex[before]);
        if (!sprayed || !edges.emplace(key, f).second) closed.emplace_back(key);
      }
    }
  }
  for (const auto& ends : closed) edges.erase(ends);
  for (const auto& [ends, face] : edges) {
    const Vec3 &from = blocks_.vertex[ends.first], &to = blocks_.vertex[ends.second];
    const Real length = norm(to - from);
    sum.edge += length;
    sum.force -= (strength_ * length) * blocks_.face_normal[face];
    sum.point += (0.5 * length) * (from + to);
  }
}

std::vector<ShotcreteCover::Edge> ShotcreteCover::edges_of(Index block) const {
  std::vector<Edge> edges;
  for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f) {
    if (!sprayed_[blocks_.face_origin[f]]) continue;
    for (Index loop = blocks_.loop_begin[f]; loop < blocks_.loop_begin[f + 1]; ++loop) {
      const Index first = blocks_.corner_begin[loop], end = blocks_.corner_begin[loop + 1];
      for (Index c = first, before = end - 1; c < end; before = c++)
        edges.push_back({blocks_.vertex[blocks_.corner_vertex[before]],
                         blocks_.vertex[blocks_.corner_vertex[c]], f});
    }
  }
  return edges;
}

void ShotcreteCover::add_traces(Index block, std::vector<ShotcreteTrace>& traces) const {
  constexpr Real rounding = 1e-9;  // of an edge's length
  std::vector<Index> neighbours;
  for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f)
    for (const FaceInterfaces::Neighbour& n : interfaces_.of_face(f))
      if (n.block > block) neighbours.push_back(n.block);
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  const std::vector<Edge> own = edges_of(block);
  for (const Index other : neighbours)
    for (const Edge& theirs : edges_of(other))
      for (const Edge& edge : own) {
        const Real length = norm(edge.to - edge.from);
        const Vec3 along = (1 / length) * (edge.to - edge.from);
        const auto off = [&](const Vec3& x) { return norm(cross(x - edge.from, along)); };
        if (off(theirs.from) > rounding * length || off(theirs.to) > rounding * length) continue;
        const auto [low, high] =
            std::minmax({dot(theirs.from - edge.from, along), dot(theirs.to - edge.from, along)});
        const Real from = std::max(low, Real{0}), to = std::min(high, length);
        if (to - from <= rounding * length) continue;
        const Vec3 inward = -(blocks_.face_normal[edge.face] + blocks_.face_normal[theirs.face]);
        if (!(norm(inward) > rounding)) continue;  // the edge of a plate, sprayed on both faces
        traces.push_back(
            {edge.from + from * along, edge.from + to * along, {block, other}, normalized(inward)});
      }
}

std::vector<ShotcreteTrace> ShotcreteCover::traces() const {
  std::vector<ShotcreteTrace> traces;
  for (Index b = 0; b < blocks_.block_count(); ++b) add_traces(b, traces);
  return traces;
}

ShotcreteHold ShotcreteCover::hold(const std::vector<Index>& members) const {
  ShotcreteHold sum;
  for (const Index block : members) add(block, members, sum);
  if (sum.edge > 0) sum.point = (1 / sum.edge) * sum.point;
  return sum;
}

}  // namespace rockfold
