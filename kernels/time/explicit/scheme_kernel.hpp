// What explicit steps keep (explicit_kernel.hpp).
#pragma once

#include <vector>

#include "kernels/device/device_kernel.hpp"
#include "kernels/time/bolts/bolts_kernel.hpp"

namespace rockfold::motion {

using device::Array;
using device::Field;

/// What holds a block: rows of its functions (index 3k + d) that do not depend on each other, combined such that C A Cᵀ = 1 in its inverse inertia A as
/// it is turned. (In any other measure what supports bear would leave strain behind.)
struct HeldRows {
  int width = 3;             ///< 3n
  Index sets = 0;            ///< blocks with points held, ascending
  Array<Index> of_block;     ///< [P+1] the set of each block
  Array<Index> cover;        ///< [sets]
  Array<Index> begin;        ///< [sets+1]
  Array<Index> point;        ///< [rows] of the springs' points, …
  Array<int> component;      ///< [rows] … and which of theirs
  Array<Real> combine;       ///< [rows][width] of the set's rows, in their order, lower triangle
  Array<Real> row;           ///< [rows][width] C
  Array<Real> way;           ///< [rows][width] A Cᵀ
  Array<Real> impulse;       ///< [rows] N s, since they were last counted
  Array<Index> entry_begin;  ///< [sets+1] all points held of a block, …
  Array<Index> entry_point;  ///< … of each component,
  Array<int> entry_component;
  Array<Real> share;  ///< [entries][width] what they take of the rows' impulses
  KOKKOS_INLINE_FUNCTION bool any() const { return sets > 0; }
};

/// Points that pull at blocks: of contacts, or the links of bolts.
struct PullingPoints {
  Array<int> level;    ///< [points]
  Array<Index> begin;  ///< [P+1] into the entries of each block, the fastest first:
  Array<Index> entry_point;
  Array<Real> entry_weight;  ///< [entries][functions] of the point's force
};

/// Who is looked at how often: a clock of level l ticks every period/2^l. A contact point goes by the faster of its two blocks' own steps, a bolt by the
/// fastest of those that it goes through, and a block by the fastest of its points and bolts: its stress answers what pushes it at once.
struct Schedule {
  Real period = 0;                  ///< s
  int deepest = 0;                  ///< the fastest level
  Array<int> block_level;           ///< [P]
  PullingPoints contacts, links;    ///< links: of bolts
  Array<Index> block, point, bolt;  ///< all of them, the fastest first

  KOKKOS_INLINE_FUNCTION Real interval(int l) const { return period / (Index{1} << l); }
};

struct ExplicitScheme {
  bool ready = false;  ///< for the stage: what does not change with the motion is there
  int functions = 1;
  Array<Real> mass;       ///< [P][n][n] kg, m of M = m ⊗ 1
  Array<Real> factor;     ///< [P] of mass, ≥ 1: what blocks move as if they had
  Array<Real> stiffness;  ///< [P][3n][3n] N/m, of the rock in place, index 3k + d
  Array<Real> turn;       ///< [P][9] how blocks have turned since
  Array<Real> slowed;     ///< [P][3n][3n] (M + θh²K)⁻¹ in place: strain takes inertia with it
  /// [P][3n][3n] kg, ½ (M + θh²K) P², P = (M + θh²K)⁻¹ θh²K: times a velocity, the impulse that damps strain in a substep.
  Array<Real> damped;
  Array<Real>
      rigid;  ///< [P][3n][3n] (M + λK)⁻¹ in place, λ beyond all: of a block that does not strain
  Array<Real>
      impact;  ///< [points] of its force, the share that an impact explains; empty: nothing rebounds
  Array<Real> lost;        ///< [P] J, by that since the step began
  Array<Real> ahead;       ///< [P] J, see substeps.cpp
  Array<Real> unbalanced;  ///< [P] of steps that relax: forces out of balance over those that act
  Array<Real> step;  ///< [P] s, the longest substep that is stable with each block's own mass …
  Array<Real> turning;                ///< … and in which it turns little enough
  Real added_mass = 0;                ///< of all mass, by `factor`
  Array<Index> vertex_begin, vertex;  ///< [P+1] the surface vertices of each block
  HeldRows held;
  Schedule schedule;
  std::vector<Index> blocks, points,
      bolts;               ///< [deepest+1] how many are as fast as level l or faster
  bolts::Ticking ticking;  ///< of the bolts
  Field start;             ///< displacements at the start of the step
  Field period_start;      ///< and of the period, where something acts from outside
  Field outside;        ///< N, what acts from outside beside constant loads: at the end of a period
  Field target_before;  ///< of supports, at the start of the period
  Field pull;           ///< [points of supports] N s, of springs
  Array<Real>
      account;  ///< [2] J: friction, and work of the contact's forces since they were last counted
};

}  // namespace rockfold::motion
