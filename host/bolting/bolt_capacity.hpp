// What one bolt can do where it leaves a block: docs/support_design.md, "Capacity of a bolt".
#pragma once

#include "src/base/types.hpp"
#include "src/model/bolting_spec.hpp"

namespace rockfold {

/// How a bolt lies with regard to one block.
struct Embedment {
  Real length = 0;    ///< m, of the bolt
  Real within = 0;    ///< m in the block, L_w
  Real anchored = 0;  ///< m in rock that stays beyond the block, L_a
  bool plate = true;  ///< whether its plate holds the block
  Real anchor = 0;    ///< m of L_a that the anchor at the far end takes; dmfc only
};

/// N along the bolt, T: cmc and cfc min(T, P + b L_w, b L_a); dmfc min(T, P, b × the anchor's part of L_a).
/// Zero without anchored length, and of a dmfc bolt without any of its anchor in rock beyond the block. Hoek, Kaiser & Bawden (1995); UnWedge's force diagrams.
Real axial_capacity(const BoltType& type, const Embedment& embedment);

/// What a bolt puts on a block that moves along the unit direction s, at full mobilisation.
struct BoltForce {
  Vec3 force{};    ///< N, on the block
  Real axial = 0;  ///< N along the bolt, ≥ 0
  Real shear = 0;  ///< N across it, ≥ 0
  Real angle = 0;  ///< rad between the bolt and the direction against the motion
};

/// Of a passive bolt. `axis` points from the block into the rock that stays, `axial` is the capacity along it. With θ the
/// angle between axis and −s the bolt does the most work on the ellipse (N/T)² + (V/S)² = 1: N = T² cos θ / R,
/// V = S² sin θ / R, R² = (T cos θ)² + (S sin θ)². Without shear capacity N = T up to θ = 90°, inclusive to
/// direction_tolerance. A bolt that the block pushes (θ > 90°) gives its shear capacity alone.
BoltForce bolt_force(const BoltType& type, const Vec3& axis, Real axial, const Vec3& motion);

/// Of an active bolt: its tension, whatever the motion; on the ellipse that leaves no shear.
BoltForce anchor_force(const Vec3& axis, Real axial, const Vec3& motion);

/// Single bolts that a force asks for, each with its whole capacity: ⌈force / capacity⌉.
Index bolts_needed(Real force, Real capacity);
/// m: square spacing at which bolts of this capacity give a pressure, √(capacity / pressure); infinite for no pressure.
Real square_spacing(Real capacity, Real pressure);

/// By length (thesis 3.1.7): rock bolts up to 3 m, cable bolts up to 15 m, ground anchors beyond; from 10 m to 15 m it may be
/// either of the latter, and the class decides: dmfc is an anchor.
enum class BoltCategory { rock_bolt, cable_bolt, ground_anchor };
BoltCategory bolt_category(const BoltType& type, Real length);

}  // namespace rockfold
