#include "host/keyblock/first_look.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <set>

#include "host/keyblock/bodies.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Index excavated = -1;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

template <class T>
Index count(const std::vector<T>& list) {
  return static_cast<Index>(list.size());
}

/// The model's support section, without what the page can change in the load.
SupportSpec without_loads(const Model& model) {
  SupportSpec spec = model.support.value_or(SupportSpec{});
  spec.seismic_coefficient = {};
  spec.water_pressure = 0;
  return spec;
}

class FirstLooks {
 public:
  FirstLooks(const BlockArrays& blocks, const Model& model)
      : blocks_(blocks),
        spec_(without_loads(model)),
        bodies_(blocks, model, spec_, {}),
        batch_(at(blocks.block_count()), 0) {
    for (auto* begin : {&looks_.neighbour_begin, &looks_.held_neighbour_begin, &looks_.face_begin,
                        &looks_.loop_begin, &looks_.corner_begin, &looks_.patch_begin,
                        &looks_.patch_corner_begin, &looks_.outline_begin})
      begin->push_back(0);
  }

  FirstLookArrays run() {
    std::vector<Index> left;
    for (Index b = 0; b < blocks_.block_count(); ++b)
      if (stage_of(b) == 0) left.push_back(b);
    look(0, left);
    std::set<Index> stages(blocks_.stage.begin(), blocks_.stage.end());
    stages.erase(0);
    for (const Index stage : stages) look(stage, excavate(stage));
    return std::move(looks_);
  }

 private:
  struct Look {
    RockBody body;
    BlockVerdict verdict;
  };

  Index stage_of(Index block) const { return blocks_.stage.empty() ? 0 : blocks_.stage[at(block)]; }

  /// The blocks that lean on the rock of a stage, which is gone then.
  std::vector<Index> excavate(Index stage) {
    std::vector<Index> removed;
    for (Index b = 0; b < blocks_.block_count(); ++b)
      if (stage_of(b) == stage) {
        batch_[at(b)] = excavated;
        removed.push_back(b);
      }
    auto candidates = bodies_.interfaces().neighbours(removed, batch_);
    std::erase_if(candidates, [&](Index b) { return stage_of(b) != 0; });
    return candidates;
  }

  /// Adds those of the candidates that are removable.
  void look(Index stage, const std::vector<Index>& candidates) {
    std::vector<std::optional<Look>> found(candidates.size());
    std::atomic<bool> open = false;  // some block that is not part of endless rock has a free face
    const auto look_at = [&](std::int64_t i) {
      const Index block = candidates[static_cast<std::size_t>(i)];
      if (blocks_.finite[at(block)] == 0 || bodies_.is_encased(block, batch_)) return;
      Look one{bodies_.body({block}, batch_), {}};
      one.verdict = judge_block(one.body.faces, one.body.load, 0);
      if (one.verdict.block_class == BlockClass::infinite) return;
      open = true;
      if (one.verdict.block_class != BlockClass::tapered)
        found[static_cast<std::size_t>(i)] = std::move(one);
    };
    constexpr std::int64_t chunk = 256;  // as in the search itself
    parallel_for(static_cast<std::int64_t>(candidates.size()), chunk, look_at);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i])
        add(stage, found[i]->body, found[i]->verdict);
      else if (stage != 0 && blocks_.finite[at(candidates[i])] != 0)
        add_held(stage, candidates[i]);
    looks_.looked_at_stage.push_back(stage);
    looks_.groups_may_move.push_back(spec_.largest_group > 1 && open ? 1 : 0);
  }

  void add_held(Index stage, Index block) {
    looks_.held_block.push_back(block);
    looks_.held_stage.push_back(stage);
    for (const Index b : bodies_.interfaces().neighbours({block}, batch_))
      looks_.held_neighbour.push_back(b);
    looks_.held_neighbour_begin.push_back(count(looks_.held_neighbour));
  }

  void add(Index stage, const RockBody& body, const BlockVerdict& verdict) {
    const Index block = body.members[0];
    looks_.block.push_back(block);
    looks_.stage.push_back(stage);
    looks_.volume.push_back(body.volume);
    looks_.mass.push_back(body.mass);
    looks_.free_area.push_back(verdict.free_area);
    looks_.centroid.push_back(body.centroid);
    looks_.load.push_back(body.load);
    looks_.moment.push_back(body.moment);
    looks_.free_centre.push_back(bodies_.free_centre(body));
    for (const Index b : bodies_.interfaces().neighbours({block}, batch_))
      looks_.neighbour.push_back(b);
    looks_.neighbour_begin.push_back(count(looks_.neighbour));
    add_faces(body);
    looks_.inertia.push_back(bodies_.looks_at_rotation() ? bodies_.inertia(body) : Mat3{});
    looks_.patch_begin.push_back(count(looks_.patch_face));
  }

  void add_faces(const RockBody& body) {
    const JointOutlines joints = bodies_.joint_outlines(body);
    const Index first_outline = count(looks_.outline_normal);
    add_outlines(joints.outline);
    const auto patches =
        bodies_.looks_at_rotation() ? bodies_.patches(body, batch_) : std::vector<ContactPatch>{};
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      const BlockFace& face = body.faces[f];
      if (!(face.contact_area > 0) || std::abs(norm(face.normal) - 1) > 1e-6) continue;
      for (const ContactPatch& patch : patches)
        if (patch.face == static_cast<Index>(f)) add_patch(patch, count(looks_.origin));
      const Index id = body.face_id[f];
      looks_.origin.push_back(blocks_.face_origin[at(id)]);
      looks_.normal.push_back(blocks_.face_normal[at(id)]);
      looks_.plane_normal.push_back(face.normal);
      looks_.contact_area.push_back(face.contact_area);
      looks_.share.push_back(std::min(1.0, face.contact_area / blocks_.face_area[at(id)]));
      looks_.outline.push_back(joints.of_face[f] == none ? none
                                                         : first_outline + joints.of_face[f]);
      add_loops(id);
    }
    looks_.face_begin.push_back(count(looks_.origin));
  }

  void add_patch(const ContactPatch& patch, Index face) {
    looks_.patch_face.push_back(face);
    looks_.patch_normal.push_back(patch.normal);
    looks_.patch_corner.insert(looks_.patch_corner.end(), patch.corners.begin(),
                               patch.corners.end());
    looks_.patch_corner_begin.push_back(count(looks_.patch_corner));
  }

  void add_loops(Index face) {
    if (has_polygons(blocks_))
      for (const auto& loop : face_loops(blocks_, face)) {
        looks_.corner.insert(looks_.corner.end(), loop.begin(), loop.end());
        looks_.corner_begin.push_back(count(looks_.corner));
      }
    looks_.loop_begin.push_back(count(looks_.corner_begin) - 1);
  }

  void add_outlines(const std::vector<JointOutline>& outlines) {
    for (const JointOutline& outline : outlines) {
      looks_.outline_normal.push_back(outline.normal);
      for (const DrainedCorner& corner : outline.corners) {
        looks_.outline_corner.push_back(corner.at);
        looks_.outline_drains.push_back(corner.share);
        looks_.outline_edge_drains.push_back(corner.edge_share);
        looks_.outline_pond.push_back(corner.pond);
      }
      looks_.outline_begin.push_back(count(looks_.outline_corner));
    }
  }

  const BlockArrays& blocks_;
  SupportSpec spec_;
  Bodies bodies_;
  std::vector<Index> batch_;  ///< [B] of every block: 0 = it is there
  FirstLookArrays looks_;
};

}  // namespace

bool has_first_looks(const Model& model) {
  return !model.initial_stress.any;
}

FirstLookArrays find_first_looks(const BlockArrays& blocks, const Model& model) {
  return has_first_looks(model) ? FirstLooks(blocks, model).run() : FirstLookArrays{};
}

}  // namespace rockfold
