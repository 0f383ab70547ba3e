#include "host/keyblock/water/drainage.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

Real distance_to_edge(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const Real length2 = dot(along, along);
  const Real t = length2 > 0 ? std::clamp(dot(x - a, along) / length2, 0.0, 1.0) : 0;
  return norm(x - a - t * along);
}

}  // namespace

void Outlets::add(const std::vector<Vec3>& loop, Real share, const LinearPressure& pond) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    edges_.push_back({loop[i], loop[(i + 1) % loop.size()], share, pond});
    slack_ = std::max(slack_, relative_slack * norm(loop[i]));
  }
}

/// Of an edge, by length: what lies on edges of free faces.
Real Outlets::drained_share(const Vec3& a, const Vec3& b) const {
  const Real length = norm(b - a);
  if (!(length > slack_)) return 0;
  const Vec3 along = (1 / length) * (b - a);
  Real drained = 0;
  for (const Edge& edge : edges_) {
    const Real from = dot(edge.a - a, along), to = dot(edge.b - a, along);
    const Real off_a = norm(edge.a - a - from * along), off_b = norm(edge.b - a - to * along);
    if (std::max(off_a, off_b) > slack_) continue;
    const Real low = std::max(0.0, std::min(from, to)), high = std::min(length, std::max(from, to));
    drained += edge.share * std::max(0.0, high - low);
  }
  return std::min(1.0, drained / length);
}

DrainedCorner Outlets::drained_corner(const Vec3& x) const {
  DrainedCorner corner{.at = x};
  Real lowest = 0;
  bool found = false;
  for (const Edge& edge : edges_) {
    if (!(edge.share > 0) || distance_to_edge(x, edge.a, edge.b) > slack_) continue;
    corner.share = std::max(corner.share, edge.share);
    const Real pond = std::max(0.0, edge.pond.unclipped(x));
    lowest = found ? std::min(lowest, pond) : pond;  // it flows where least holds it back
    found = true;
  }
  corner.pond = lowest;
  return corner;
}

DrainedLoop Outlets::drained(const std::vector<Vec3>& loop) const {
  DrainedLoop drained;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    drained.push_back(drained_corner(loop[i]));
    drained.back().edge_share = drained_share(loop[i], loop[(i + 1) % loop.size()]);
  }
  return drained;
}

}  // namespace rockfold
