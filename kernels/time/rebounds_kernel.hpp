// Restitution is of blocks as wholes: what hits one must not set it swinging, or it leaves with less than it should, and with more when it next hits. As
// far as impacts explain what presses a block it goes on as a rigid one: its rock has viscosity beyond all that an impact could strain in its time. While
// nothing presses a block, it stops swinging: with the speeds of its surface the next impact would be measured by them. On joints so stiff
// that an impact is over before a wave has come to the block's middle, waves run through it: there it is elastic, and restitution is that of its surface.
#pragma once

#include "kernels/contact/term_kernel.hpp"
#include "kernels/time/block_forces_kernel.hpp"
#include "kernels/time/motion.hpp"

namespace rockfold::motion {

struct Rebounds {
  device::Array<Real> transit;    ///< [blocks] s, of a wave through the block: h √(ρ/E)
  device::Array<Real> swing;      ///< [blocks] s, the β in flight
  device::Array<Index> block;     ///< [elements] among those of BlockForces
  device::Array<Real> closure;    ///< [points] m, of what presses; < 0: nothing does
  device::Array<Real> share;      ///< [points] of that, what an impact explains
  device::Array<Real> of_block;   ///< [blocks] s, the viscosity's β
  device::Array<Real> viscosity;  ///< [elements] β over the step's length
  bool any() const { return viscosity.extent(0) > 0; }
};
Rebounds make_rebounds(const MotionSetup& setup, const BlockForces& of_blocks);

/// Rebounds::viscosity for a step of dt s from its points, with vertices at their predicted places.
void find_viscosity(Rebounds& rebounds, const BlockForces& of_blocks,
                    const contact::ContactTerm& term, const solve::PointTerms& rows, Real dt);

}  // namespace rockfold::motion
