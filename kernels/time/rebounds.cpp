#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/contact/point_kernel.hpp"
#include "kernels/time/rebounds_kernel.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::motion {
namespace {

/// β in periods √(m/K) of the block on what it hits: of what an impact of π periods stores in a joint as stiff as the rock, strain takes π/1000.
constexpr Real most_periods = 1000;

/// 2/ω of a bar of the length h that strains evenly, ω² = 12 E/(ρh²), over h √(ρ/E): its critical damping.
constexpr Real swing_of_transit = 0.5773502691896258;
/// Of an impact's π √(m/K), over the transit: such that it lasts until a wave has come to the middle.
constexpr Real shortest = 0.5 / 3.14159265358979323846;

/// What presses a block at a point at the start of the step, or begins to in it.
struct Pressed {
  Real closure = -1;  ///< m, ≥ 0 where something does
  Real share = 0;     ///< of it that an impact explains
};

KOKKOS_INLINE_FUNCTION Pressed pressed_at(const ContactPoint& p, const contact::LocalMotion& l) {
  const ContactMemory& memory = p.memory;
  Pressed out;
  if (memory.state == Contact::open && !(l.motion.gap < memory.dilation)) return out;
  out.closure = contact::larger(0.0, memory.dilation - l.motion.gap_before);
  if (!memory.met) return out;
  ContactMemory now = memory;
  contact::remember_approach(l.motion, now);
  if (out.closure > 0)
    out.share = contact::rigid_share(p.period, now.approach, -out.closure);
  else if (now.approach > 0)
    out.share = 1;
  return out;
}

/// The deepest point of an unknown's or of a block's, of those the one that an impact explains most.
struct Deepest {
  Real closure = -1, share = 0, period = 0;
  KOKKOS_INLINE_FUNCTION void take(Real c, Real s, Real p) {
    if (c < closure || (c == closure && s <= share)) return;
    closure = c;
    share = s;
    period = p;
  }
};

/// s, β.
KOKKOS_INLINE_FUNCTION Real viscosity_of(const Deepest& deepest, Real transit, Real swing) {
  if (deepest.closure < 0) return swing;
  if (!(deepest.period > 0) || deepest.period < shortest * transit) return 0;
  return deepest.period * deepest.share / (1 - deepest.share + 1 / most_periods);
}

}  // namespace

Rebounds make_rebounds(const MotionSetup& setup, const BlockForces& of_blocks) {
  const CoverArrays& covers = setup.covers;
  std::vector<Index> block, material;
  for (Index e = 0; e < covers.element_count(); ++e) {
    block.push_back(block_of(covers, e));
    material.push_back(material_of(covers, e));
  }
  std::vector<Index> blocks = block;
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  std::vector<Real> transit(blocks.size()), swing(blocks.size());
  const bool whole = covers.lattice.kind == LatticeKind::block;
  Real stiffest = 0;
  for (const JointLaw& law : setup.contact.laws)
    stiffest = std::max(stiffest, law.normal_stiffness);
  for (std::size_t e = 0; e < block.size(); ++e) {
    const ElasticMaterial& rock = setup.materials[material[e]];
    const Index of = static_cast<Index>(std::lower_bound(blocks.begin(), blocks.end(), block[e]) -
                                        blocks.begin());
    const Real size = std::cbrt(setup.surfaces->block_mass[block[e]] / rock.density);
    transit[of] = std::max(transit[of], size * std::sqrt(rock.density / rock.young_modulus));
    const bool elastic = std::sqrt(rock.density * size / stiffest) < shortest * transit[of];
    swing[of] = whole || !elastic ? swing_of_transit * transit[of] : 0;
    block[e] = of;
  }
  Rebounds r;
  r.block = device::to_device("motion::block_of_element", block);
  r.swing = device::to_device("motion::swing", swing);
  r.transit = device::to_device("motion::transit", transit);
  r.of_block = device::allocate<Real>("motion::block_viscosity", of_blocks.blocks);
  r.viscosity = device::Array<Real>("rockfold::motion::viscosity", block.size());
  return r;
}

void find_viscosity(Rebounds& rebounds, const BlockForces& of_blocks,
                    const contact::ContactTerm& term, const solve::PointTerms& rows, Real dt) {
  const Index count = term.contacts.current.count;
  device::grow(rebounds.closure, "motion::closure", count);
  device::grow(rebounds.share, "motion::share_of_impact", count);
  const Rebounds r = rebounds;
  const BlockForces b = of_blocks;
  const contact::Motion m = term.motion;
  const auto point = term.contacts.current.point;
  device::for_each(
      "rockfold::motion::pressed", count, KOKKOS_LAMBDA(const Index i) {
        const Pressed pressed = pressed_at(point(i), contact::local_motion(point(i), m));
        r.closure(i) = pressed.closure;
        r.share(i) = pressed.share;
      });
  const auto row_begin = rows.row_begin, row_point = rows.row_point;
  device::for_each(
      "rockfold::motion::block_viscosity", b.blocks,
      KOKKOS_LAMBDA(const Index k) {
        Deepest deepest;
        const Index end = b.chunk(b.block_begin(k + 1));
        for (Index u = b.chunk(b.block_begin(k)); u < end; ++u)
          for (Index i = row_begin(b.unknown(u)); i < row_begin(b.unknown(u) + 1); ++i) {
            const Index c = row_point(i);
            deepest.take(r.closure(c), r.share(c), point(c).period);
          }
        r.of_block(k) = viscosity_of(deepest, r.transit(k), r.swing(k));
      },
      1);
  device::for_each(
      "rockfold::motion::viscosity", static_cast<Index>(r.block.extent(0)),
      KOKKOS_LAMBDA(const Index e) { r.viscosity(e) = r.of_block(r.block(e)) / dt; });
}

}  // namespace rockfold::motion
