// Where bolts stand: single ones, and patterns laid on unrolled walls.
#pragma once

#include <vector>

#include "host/bolting/rock_lines.hpp"
#include "host/bolting/wall.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct Bolt {
  Index group = none;             ///< into the groups it was drilled with
  Index number = 0;               ///< within its group, from 1
  Vec3 collar{};                  ///< m
  Vec3 direction{};               ///< unit, into the rock
  Real length = 0;                ///< m
  std::array<Real, 2> sheet{};    ///< (u, v) on its wall's sheet; patterns only
  std::vector<RockSegment> rock;  ///< the blocks that it crosses
};

/// Bolts of one kind: a pattern or a single bolt.
struct BoltGroup {
  std::string name;
  BoltType type;
  bool is_pattern = false;
  std::string on;  ///< the walls' names; patterns only
  Index bolts = 0;
  Real wall_area = 0;  ///< m² of free face on the walls, all of it; patterns only
  Index install = 0;   ///< SpotBolt::install
};

/// Collars at the nodes of a pattern's grid that lie on free faces, in rows. Rows of a panel that goes round an axis run
/// round it with one bolt at the crown, the first row half a spacing from the axis' start; the grid of a plane panel is
/// centred. A face whose bolt direction rises less or more than `inclination` allows gets none, nor one that the given
/// direction does not enter. Throws Error(model) for more than a million bolts. `rock` is left empty.
std::vector<Bolt> pattern_collars(const Wall& wall, const BlockArrays& blocks,
                                  const BoltPattern& pattern);

/// The walls of a pattern, in the model's order. Throws Error(model) for one that is not there.
std::vector<Wall> walls_of(const BlockArrays& blocks, const Model& model,
                           const BoltPattern& pattern);
/// The collars on all of them, one wall after the other, numbered through.
std::vector<Bolt> pattern_collars(const std::vector<Wall>& walls, const BlockArrays& blocks,
                                  const BoltPattern& pattern);

/// Fills `rock` of each bolt, in parallel.
void drill(const RockLines& lines, std::vector<Bolt>& bolts);

/// The model's bolts, in all rock that there is before any is excavated. Throws Error(model) for a wall that is not there.
struct DrilledBolts {
  std::vector<BoltGroup> groups;
  std::vector<Bolt> bolts;
};
DrilledBolts drill_model(const BlockArrays& blocks, const Model& model);
/// Throws Error(model) for a single bolt that meets no rock.
void require_rock(const Model& model, const DrilledBolts& drilled);

}  // namespace rockfold
