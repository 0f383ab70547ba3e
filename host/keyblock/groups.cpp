#include "host/keyblock/groups.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "host/keyblock/motions/pyramid.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

void add_direction(std::vector<Vec3>& directions, const Vec3& u) {
  const Real length = norm(u);
  if (!(length > 0)) return;
  const Vec3 s = (1 / length) * u;
  const bool known = std::any_of(directions.begin(), directions.end(), [&](const Vec3& d) {
    return norm(d - s) <= 2 * direction_tolerance;
  });
  if (!known) directions.push_back(s);
}

void add_driven(std::vector<Vec3>& directions, const Vec3& u, const Vec3& load) {
  if (dot(u, load) > direction_tolerance * norm(u) * norm(load)) add_direction(directions, u);
}

/// A plane that facets of a mesh are on a block.
struct MeshPlane {
  Index origin = none;
  Vec3 normal{};
};

std::vector<MeshPlane> mesh_planes_of(const RockBody& body, const Bodies& bodies) {
  std::vector<MeshPlane> found;
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const Index origin = bodies.blocks().face_origin[static_cast<std::size_t>(body.face_id[f])];
    const Vec3& n = body.faces[f].normal;
    if (bodies.mesh_planes().flatness(body.face_id[f]) &&
        std::none_of(found.begin(), found.end(),
                     [&](const MeshPlane& p) { return p.origin == origin && p.normal == n; }))
      found.push_back({origin, n});
  }
  return found;
}

/// Where the load may drive a body along its joints: itself, its projections, the meeting lines.
std::vector<Vec3> driven_directions(const std::vector<ContactPlane>& planes, const Vec3& load) {
  std::vector<Vec3> directions;
  if (!(norm(load) > 0)) return directions;
  add_direction(directions, load);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Vec3& n = planes[i].normal;
    const Vec3 along = load - dot(load, n) * n;
    if (norm(along) > direction_tolerance * norm(load)) add_driven(directions, along, load);
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const Vec3 line = cross(n, planes[j].normal);
      if (norm(line) <= direction_tolerance) continue;
      add_driven(directions, line, load);
      add_driven(directions, -line, load);
    }
  }
  return directions;
}

/// Where a turn about an edge of a contact carries the body's centroid.
void add_turns(std::vector<Vec3>& directions, const std::vector<ContactPatch>& patches,
               const Vec3& centroid) {
  for (const ContactPatch& patch : patches)
    for (std::size_t k = 0; k < patch.corners.size(); ++k) {
      const Rotation turn = about_edge(patch, k);
      add_direction(directions, cross(turn.axis, centroid - turn.point));
    }
}

class GroupSearch {
 public:
  GroupSearch(const Bodies& bodies, const std::vector<Index>& batch, Index largest,
              const std::function<bool(Index)>& may_move)
      : bodies_(bodies), batch_(batch), largest_(largest), may_move_(may_move) {}

  /// The sets of blocks, two or more, that must move with the seed.
  std::vector<std::vector<Index>> pushed_with(Index seed) const {
    const RockBody body = bodies_.body({seed}, batch_);
    std::vector<std::vector<Index>> found;
    if (!body.finite) return found;
    auto directions = driven_directions(contact_planes(body.faces), body.load);
    if (bodies_.looks_at_rotation())
      add_turns(directions, bodies_.patches(body, batch_), body.centroid);
    const std::vector<MeshPlane> mesh_planes = mesh_planes_of(body, bodies_);
    for (const Vec3& u : directions)
      if (auto members = closure(body, mesh_planes, u); members.size() > 1)
        found.push_back(std::move(members));
    return found;
  }

 private:
  /// The blocks that a motion of the seed along u pushes on, with it; empty if rock is among them
  /// that stays, or if they are too many.
  std::vector<Index> closure(const RockBody& seed, const std::vector<MeshPlane>& mesh_planes,
                             const Vec3& u) const {
    std::vector<Index> members = seed.members;
    const BlockArrays& blocks = bodies_.blocks();
    for (std::size_t next = 0; next < members.size(); ++next) {
      const auto b = static_cast<std::size_t>(members[next]);
      for (Index face = blocks.face_begin[b]; face < blocks.face_begin[b + 1]; ++face)
        if (enters(face, mesh_planes, u) && !push(face, members)) return {};
    }
    std::sort(members.begin(), members.end());
    return members;
  }

  /// Whether a motion along u pushes a face on; not where it is one plane of a mesh with what the seed slides along or leaves.
  bool enters(Index face, const std::vector<MeshPlane>& of_seed, const Vec3& u) const {
    const Vec3& n = bodies_.mesh_planes().normal(face);
    if (dot(n, u) <= direction_tolerance) return false;
    const auto flatness = bodies_.mesh_planes().flatness(face);
    if (!flatness) return true;
    const Real least = std::cos(*flatness * std::numbers::pi / 180);
    const Index origin = bodies_.blocks().face_origin[static_cast<std::size_t>(face)];
    return std::none_of(of_seed.begin(), of_seed.end(), [&](const MeshPlane& p) {
      return p.origin == origin && dot(p.normal, u) <= direction_tolerance &&
             dot(p.normal, n) >= least;
    });
  }

  /// Adds what a face pushes on; false if that stays or is too much.
  bool push(Index face, std::vector<Index>& members) const {
    for (const auto& next : bodies_.interfaces().of_face(face)) {
      if (batch_[static_cast<std::size_t>(next.block)] != 0) continue;
      if (std::find(members.begin(), members.end(), next.block) != members.end()) continue;
      if (static_cast<Index>(members.size()) == largest_ || !may_move_(next.block)) return false;
      members.push_back(next.block);
    }
    return true;
  }

  const Bodies& bodies_;
  const std::vector<Index>& batch_;
  Index largest_;
  const std::function<bool(Index)>& may_move_;
};

/// The blocks of `blocks` that a chain of fewer than `largest` interfaces joins to one with a free face:
/// a group has a free face.
std::vector<Index> near_free_faces(const Bodies& bodies, const std::vector<Index>& blocks,
                                   const std::vector<Index>& batch, Index largest) {
  std::vector<Index> front, near;
  std::vector<std::uint8_t> seen(batch.size(), 1);
  for (const Index b : blocks) seen[static_cast<std::size_t>(b)] = 0;
  for (const Index b : blocks)
    if (!bodies.is_encased(b, batch)) {
      seen[static_cast<std::size_t>(b)] = 1;
      front.push_back(b);
    }
  for (Index step = 1; step <= largest && !front.empty(); ++step) {
    near.insert(near.end(), front.begin(), front.end());
    if (step == largest) break;
    std::erase_if(front = bodies.interfaces().neighbours(front, batch), [&](Index b) {
      return std::exchange(seen[static_cast<std::size_t>(b)], std::uint8_t{1}) != 0;
    });
  }
  std::sort(near.begin(), near.end());
  return near;
}

bool moves_before(const Group& a, const Group& b) {
  const auto size = [](const Group& g) { return g.body.members.size(); };
  if (size(a) != size(b)) return size(a) < size(b);
  const Real force_a = a.verdict.sliding_force(), force_b = b.verdict.sliding_force();
  if (std::abs(force_a - force_b) > 1e-9 * (force_a + force_b)) return force_a > force_b;
  return a.body.members < b.body.members;
}

/// In the order of moves_before, those that share no block with one before.
std::vector<Group> disjoint(std::vector<Group> groups) {
  std::sort(groups.begin(), groups.end(), moves_before);
  std::set<Index> taken;
  std::vector<Group> chosen;
  for (Group& group : groups) {
    const auto& members = group.body.members;
    if (std::any_of(members.begin(), members.end(), [&](Index b) { return taken.count(b) > 0; }))
      continue;
    taken.insert(members.begin(), members.end());
    chosen.push_back(std::move(group));
  }
  return chosen;
}

}  // namespace

std::vector<Group> find_groups(const Bodies& bodies, const std::vector<Index>& blocks,
                               const std::vector<Index>& batch, Index largest,
                               const std::function<bool(Index)>& may_move) {
  if (largest < 2) return {};
  std::vector<Index> seeds;
  for (const Index b : blocks)
    if (may_move(b)) seeds.push_back(b);
  seeds = near_free_faces(bodies, seeds, batch, largest);
  const GroupSearch search(bodies, batch, largest, may_move);
  std::vector<std::vector<std::vector<Index>>> of_seed(seeds.size());
  constexpr std::int64_t chunk = 64;
  parallel_for(static_cast<std::int64_t>(seeds.size()), chunk, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    of_seed[k] = search.pushed_with(seeds[k]);
  });
  std::set<std::vector<Index>> sets;
  for (auto& found : of_seed)
    for (auto& members : found) sets.insert(std::move(members));

  const std::vector<std::vector<Index>> list(sets.begin(), sets.end());
  std::vector<std::optional<Group>> judged(list.size());
  parallel_for(static_cast<std::int64_t>(list.size()), chunk, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    RockBody body = bodies.body(list[k], batch);
    BlockVerdict verdict = bodies.judge(body, batch);
    if (verdict.block_class == BlockClass::key)
      judged[k] = Group{std::move(body), std::move(verdict)};
  });
  std::vector<Group> groups;
  for (auto& group : judged)
    if (group) groups.push_back(std::move(*group));
  return disjoint(std::move(groups));
}

}  // namespace rockfold
