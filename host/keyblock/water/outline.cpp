#include "host/keyblock/water/outline.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

Real distance_to_chord(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const Real length2 = dot(along, along);
  const Real t = length2 > 0 ? std::clamp(dot(x - a, along) / length2, 0.0, 1.0) : 0;
  return norm(x - a - t * along);
}

Real signed_area(const std::vector<Vec3>& loop, const Vec3& normal) {
  Vec3 twice{};
  for (std::size_t i = 2; i < loop.size(); ++i)
    twice += cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  return 0.5 * dot(normal, twice);
}

/// Edges of faces between welded corners; those that two faces share join them.
class Joining {
 public:
  Joining(const std::vector<std::vector<std::vector<Vec3>>>& loops, Real slack)
      : slack_(slack), part_(loops.size()) {
    std::iota(part_.begin(), part_.end(), Index{0});
    std::vector<std::pair<Index, std::vector<Index>>> welded;
    for (std::size_t f = 0; f < loops.size(); ++f)
      for (const auto& loop : loops[f]) {
        welded.push_back({static_cast<Index>(f), {}});
        for (const Vec3& x : loop) welded.back().second.push_back(corner(x));
      }
    for (const auto& [face, loop] : welded)
      for (std::size_t i = 0; i < loop.size(); ++i)
        add_edge(face, loop[i], loop[(i + 1) % loop.size()]);
    join();
  }

  Index part(Index face) const {
    while (part_[at(face)] != face) face = part_[at(face)];
    return face;
  }

  /// The boundary loops of a part.
  std::vector<std::vector<Vec3>> boundary(Index which) const {
    std::multimap<Index, Index> next;
    for (const auto& [edge, face] : edges_)
      if (part(face) == which && !edges_.contains({edge.second, edge.first})) next.insert(edge);
    std::vector<std::vector<Vec3>> loops;
    while (!next.empty()) {
      loops.emplace_back();
      for (auto step = next.begin(); step != next.end();) {
        const Index to = step->second;
        loops.back().push_back(corners_[at(step->first)]);
        next.erase(step);
        step = next.find(to);
      }
    }
    return loops;
  }

 private:
  Index corner(const Vec3& x) {
    for (std::size_t k = 0; k < corners_.size(); ++k)
      if (norm(corners_[k] - x) <= slack_) return static_cast<Index>(k);
    corners_.push_back(x);
    return static_cast<Index>(corners_.size()) - 1;
  }

  /// In parts between the corners that lie on it.
  void add_edge(Index face, Index from, Index to) {
    if (from == to) return;
    const Vec3 &a = corners_[at(from)], &b = corners_[at(to)];
    std::vector<std::pair<Real, Index>> on{{0, from}, {1, to}};
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Real t = dot(corners_[k] - a, b - a) / dot(b - a, b - a);
      const auto id = static_cast<Index>(k);
      if (id != from && id != to && t > 0 && t < 1 &&
          distance_to_chord(corners_[k], a, b) <= slack_)
        on.emplace_back(t, id);
    }
    std::sort(on.begin(), on.end());
    for (std::size_t k = 1; k < on.size(); ++k) edges_[{on[k - 1].second, on[k].second}] = face;
  }

  void join() {
    for (const auto& [edge, face] : edges_) {
      const auto other = edges_.find({edge.second, edge.first});
      if (other == edges_.end()) continue;
      const Index a = part(face), b = part(other->second);
      part_[at(std::max(a, b))] = std::min(a, b);
    }
  }

  Real slack_;
  std::vector<Index> part_;  ///< [faces] towards the first face of its part
  std::vector<Vec3> corners_;
  std::map<std::pair<Index, Index>, Index> edges_;  ///< between corners, to the face left of it
};

/// Keeps of the corners between two kept ones those that are no rounding of a straight line.
void keep_corners(const DrainedLoop& loop, std::size_t from, std::size_t to, Real tolerance,
                  std::vector<bool>& kept) {
  const auto x = [&](std::size_t i) { return loop[i % loop.size()].at; };
  std::size_t farthest = from;
  Real distance = tolerance * norm(x(to) - x(from));
  for (std::size_t i = from + 1; i < to; ++i)
    if (const Real d = distance_to_chord(x(i), x(from), x(to)); d > distance)
      farthest = i, distance = d;
  if (farthest == from) return;
  kept[farthest % loop.size()] = true;
  keep_corners(loop, from, farthest, tolerance, kept);
  keep_corners(loop, farthest, to, tolerance, kept);
}

/// Whether what drains changes at a corner.
bool is_end(const DrainedLoop& loop, std::size_t i) {
  const DrainedCorner &here = loop[i], &before = loop[(i + loop.size() - 1) % loop.size()];
  return here.edge_share != before.edge_share || here.share != here.edge_share || here.pond > 0;
}

}  // namespace

FaceOutlines joined_outlines(const std::vector<std::vector<std::vector<Vec3>>>& loops,
                             const Vec3& normal, Real slack) {
  FaceOutlines joined;
  const bool alone = loops.size() == 1;
  const Joining joining(alone ? std::vector<std::vector<std::vector<Vec3>>>{} : loops, slack);
  std::map<Index, Index> known;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const Index part = alone ? 0 : joining.part(static_cast<Index>(f));
    const auto [entry, is_new] = known.try_emplace(part, static_cast<Index>(joined.outline.size()));
    joined.of_face.push_back(entry->second);
    if (!is_new) continue;
    auto boundary = alone ? loops[f] : joining.boundary(part);
    const auto outer =
        std::max_element(boundary.begin(), boundary.end(), [&](const auto& a, const auto& b) {
          return signed_area(a, normal) < signed_area(b, normal);
        });
    joined.outline.push_back(outer == boundary.end() ? std::vector<Vec3>{} : *outer);
  }
  return joined;
}

JointOutline joint_outline(const Outlets& outlets, const std::vector<Vec3>& outline,
                           const Vec3& normal, Real tolerance) {
  DrainedLoop corners = simplified(outlets.drained(outline), tolerance);
  for (DrainedCorner& corner : corners)
    corner.at -= dot(normal, corner.at - corners.front().at) * normal;
  return {std::move(corners), normal};
}

DrainedLoop simplified(const DrainedLoop& outline, Real tolerance) {
  const std::size_t n = outline.size();
  std::vector<bool> kept(n, false);
  for (std::size_t i = 0; i < n; ++i) kept[i] = is_end(outline, i);
  if (n < 4) return outline;
  if (std::find(kept.begin(), kept.end(), true) == kept.end()) {  // two corners far apart
    const auto from = [&](const Vec3& x) {
      return std::max_element(
                 outline.begin(), outline.end(),
                 [&](const auto& a, const auto& b) { return norm(a.at - x) < norm(b.at - x); }) -
             outline.begin();
    };
    const auto first = from(outline[0].at);
    kept[static_cast<std::size_t>(first)] = true;
    kept[static_cast<std::size_t>(from(outline[static_cast<std::size_t>(first)].at))] = true;
  }
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < n; ++i)
    if (kept[i]) ends.push_back(i);
  for (std::size_t k = 0; k < ends.size(); ++k)
    keep_corners(outline, ends[k], k + 1 < ends.size() ? ends[k + 1] : ends[0] + n, tolerance,
                 kept);
  DrainedLoop few;
  for (std::size_t i = 0; i < n; ++i)
    if (kept[i]) few.push_back(outline[i]);
  return few;
}

}  // namespace rockfold
