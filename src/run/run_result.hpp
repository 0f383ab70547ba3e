// What an analysis hands back: plain numbers for the JSON of INTERFACE.md §3 and for the result file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/arrays/element_arrays.hpp"
#include "src/base/types.hpp"
#include "src/run/fixed_contradiction.hpp"

namespace rockfold {

/// Stress as xx yy zz xy yz zx, Pa, tension positive.
using Stress = std::array<Real, 6>;

/// One state worth storing: t = 0, every `output.every` steps, and the last.
struct StoredState {
  Index step = 0;
  StateArrays motion;                  ///< of every physical cover; holds the time
  std::vector<Stress> element_stress;  ///< [nR + E] in the element numbering of CoverArrays
  std::vector<Stress> block_stress;    ///< [B] mean over each block's volume
  std::vector<Stress> nodal_stress;    ///< [K] at RunInput::mesh's points; empty without one
};

/// One material point over time; every vector has one entry for t = 0 and one for each step done.
struct MonitorHistory {
  std::string name;
  Index material = none;           ///< of the rock there, into Model::materials
  std::vector<Real> time;          ///< s
  std::vector<Vec3> displacement;  ///< m
  std::vector<Vec3> velocity;      ///< m/s
  std::vector<Vec3> acceleration;  ///< m/s²
  std::vector<Stress> stress;      ///< Pa, of the element that holds the point
};

/// A block as a whole at the end. Averages are over its volume.
struct BlockMotion {
  Vec3 displacement{};  ///< m
  /// rad: axis times angle of the mean rotation; under small kinematics half the curl of the displacement.
  Vec3 rotation{};
  Real volume = 0;  ///< m³, under large kinematics of the deformed block
};

/// The point of the rock that has moved furthest: displacement is linear in each element, so it is a vertex of one.
struct LargestDisplacement {
  Real length = 0;     ///< m
  Vec3 point{};        ///< m, before the motion
  Index block = none;  ///< that holds the point
};

/// How near the rock is to failure.
struct RockStrength {
  Real least_ratio =
      0;  ///< strength over stress (src/io/stress_measures.hpp) of the element nearest to failure
  Vec3 point{};            ///< m, its centroid
  Index block = none;      ///< that holds it; none: no rock has a strength
  Real failed_volume = 0;  ///< m³ of elements whose ratio is below 1
};

/// Motion of the ground since t = 0.
struct BaseMotion {
  Vec3 displacement{};  ///< m
  Vec3 velocity{};      ///< m/s
  Vec3 acceleration{};  ///< m/s²
};

/// What a condition's fixed points do to the rock.
struct Reaction {
  Vec3 force{};   ///< N
  Vec3 moment{};  ///< N·m about the origin
};

struct RunResult {
  Index steps = 0;           ///< steps done
  Real time = 0;             ///< s reached
  bool interrupted = false;  ///< a signal stopped the run after the last step counted above
  std::vector<MonitorHistory> monitors;  ///< in the order of Model::monitors
  std::vector<BaseMotion> base;  ///< at the monitors' times; empty unless the base is accelerated
  std::vector<BlockMotion> blocks;   ///< [B]
  std::vector<Stress> block_stress;  ///< [B] Pa, mean over each block's volume, at the end
  RockStrength strength;             ///< at the end
  std::vector<Vec3> reactions;       ///< [N] N, force of each fixed point on the rock, at the end
  std::vector<Reaction> conditions;  ///< the same by condition, in the order of Model::fixed
  Energy energy;                     ///< J, at the end
  std::vector<Real> energy_time;     ///< s, t = 0 and each step done
  std::vector<Energy> energies;      ///< J, likewise
  Real support_gap =
      0;  ///< distance of augmented fixed points from their places / largest displacement, last step

  OffPlace off_place;  ///< the fixed point farthest off its place, at the end

  struct Iterations {
    std::int64_t pcg = 0;
    std::int64_t open_close = 0;  ///< 0 until contact exists
    std::int64_t fallbacks = 0;   ///< solves that a direct factorisation took over
  } iterations;
  Preconditioner preconditioner = Preconditioner::automatic;  ///< of the last solve

  struct Seconds {
    Real assemble = 0, solve = 0, output = 0;
  } seconds;

  LargestDisplacement largest_displacement;  ///< at the end
  Index largest_substeps = 1;  ///< the finest subdivision of a step, whatever asked for it
  Index divided_steps = 0;     ///< steps that did not converge until they were divided
  Index most_parts = 1;        ///< into how many at most
};

}  // namespace rockfold
