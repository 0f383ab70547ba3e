// Bolts in the rock that they hold (src/arrays/bolt_arrays.hpp): forces on its functions, and their tangents.
//
//   steel_law_kernel.hpp  what a piece of steel bears
//   chain_kernel.hpp      a bolt in balance with the rock about it
//   link_kernel.hpp       what its links do to the rock
//   state_kernel.hpp      what becomes of it by a step
//   bolts.cpp             all of them
//
// What the rock does to a bolt are the motions of its links, u = x' − x of their two points less what they were. Given these, the steel slips along
// the rock until pulls and bond are in balance: a chain of few numbers that each bolt solves by itself, by Newton's method, one thread a bolt. What is left is a
// potential of the links' motions, whose derivatives are f = Σ forces on links and, with the slips eliminated,
//   ∂f_k/∂u_l = A_k δ_kl − a_k W_kl a_lᵀ:
// a 3×3 tangent for each link, and couplings among those of one bolt. Along a piece the steel pulls in the direction of its two points; at a joint
// along the mean of the bolt's directions in the two blocks, and across it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/operator/elements/sampled_elements_kernel.hpp"
#include "kernels/operator/point_terms_kernel.hpp"
#include "src/arrays/bolt_arrays.hpp"
#include "src/arrays/load_arrays.hpp"

namespace rockfold::bolts {

using device::Array;
using device::Field;

/// What a step changes, and what it is judged by. (Of crossings of links.)
struct BoltState {
  Array<Real> slip;       ///< [M] m, of the steel against the rock, towards the toe
  Array<Real> slid;       ///< [M] m of it that the bond has lost
  Array<Real> plate;      ///< [B] m that the plate has been pulled in for good
  Array<Real> plastic;    ///< [P] m, elongation
  Array<Real> used;       ///< [P] m, plastic flow so far, across the bolt too
  Array<Real> cut;        ///< [L] m, way across bolts that bear nothing so
  Array<Real> broken;     ///< [P] 1: broken
  Array<Real> installed;  ///< [B] 1: it acts
  Array<Real> peak;       ///< [B] N, BoltForces::peak
  Field sheared;          ///< [L] m, plastic, across …
  Field axis;             ///< [L] … this direction

  std::vector<Array<Real>> arrays() const {
    return {slip, slid, plate, plastic, used, cut, broken, installed, peak};
  }
  std::vector<Field> fields() const { return {sheared, axis}; }
};

/// What the chains are solved with.
struct ChainWork {
  Array<Real> diagonal, off, residual, step, solution;  ///< [M]
  Array<Real> axial, tangent;                           ///< [P] N, N/m
};

struct DeviceBolts {
  Index bolts = 0, points = 0, links = 0, nodes = 0, steels = 0;
  solve::PointRows
      rows;  ///< of the links: the weights of their far point less those of the near one
  Array<Index> element;  ///< [N]
  Field local;           ///< [N] m
  solve::PointSlopes slopes;
  solve::ElementTable elements;
  Array<Index> point_begin, link_begin, node_begin;  ///< [B+1]
  Array<Index> steel_begin;                          ///< [L+1]
  Field direction;                                   ///< [B] at first
  Field apart;                   ///< [L] m, from the near point to the far one at first
  Array<std::uint8_t> crossing;  ///< [L]
  Array<Real> length, elastic_length, dowel;   ///< [L]
  Array<Real> steel_length;                    ///< [P] m
  Array<BoltLaw> law;                          ///< [B]
  Array<Real> toe;                             ///< [B] m
  Array<Real> node_place, bond_from, bond_to;  ///< [M]
  std::vector<Index> install, node_element;    ///< as BoltArrays
  Real largest_strength = 0;                   ///< N
  BoltState now, next;                         ///< accepted, and of the trial motion

  Field axis;                   ///< [N] unit, of the trial motion
  Field motion;                 ///< [L] m, u + apart
  Field force;                  ///< [L] N, on the far point
  solve::Blocks tangent;        ///< [L] A_k
  Field lead;                   ///< [L] a_k
  Array<Index> coupling_begin;  ///< [B+1]
  Array<Real> coupling;         ///< W, bolt by bolt, row-major
  ChainWork work;

  bool any() const { return bolts > 0; }
};

/// Of bolts that are looked at by clocks of their own: the links as they were looked at last, and the work done on each bolt since.
struct Ticking {
  Field motion, force;  ///< [L] m, N
  Array<Real> work;     ///< [B] J
};

DeviceBolts make_bolts(const BoltArrays& arrays, const CoverArrays& covers,
                       const PieceMoments& moments, const std::vector<ElasticMaterial>& materials);

/// The links' weights as points, for make_constrained_system and DeviceBolts::rows.
MaterialPoints link_points(const BoltArrays& arrays);

/// Forces on the links where the displacement d has the rock.
void find_forces(const DeviceBolts& bolts, const Field& d, bool tangents);
/// For ticks from here on.
void begin_ticks(const DeviceBolts& bolts, const Field& d, Ticking& ticking);
/// find_forces and accept of the first `count` bolts in this order, with the work done on them since they were looked at last.
void tick(const DeviceBolts& bolts, const Field& d, const Array<Index>& order, Index count,
          const Ticking& ticking);
/// f += scale · what they do to the rock.
void add_forces(const DeviceBolts& bolts, Real scale, const Field& f);
/// The tangents found last into those of `terms` from `first` on, with their couplings.
void write_tangents(const DeviceBolts& bolts, solve::PointTerms& terms, Index first);
/// N, below which forces of bolts are those of threads that stand for broken steel.
Real rounding(const DeviceBolts& bolts);
/// factor · bounds of them, whatever the bolts' states, without couplings.
void write_stiffest(const DeviceBolts& bolts, Real factor, const solve::PointTerms& terms,
                    Index first);
void clear_tangents(const DeviceBolts& bolts, solve::PointTerms& terms, Index first);

/// The trial motion is that of the step's end: what has been stretched to rupture is broken from here on.
void accept(DeviceBolts& bolts);
/// Bolts of this stage act from here on, with their pretension, where d has the rock.
void install(DeviceBolts& bolts, Index stage, const Field& d);
/// Steel in rock that is gone holds nothing.
void leave_out(DeviceBolts& bolts, const std::vector<std::uint8_t>& gone_element);

void copy_state(const BoltState& from, BoltState& to);
BoltState make_state(const DeviceBolts& bolts);
std::vector<std::byte> bytes(const DeviceBolts& bolts);
void restore(DeviceBolts& bolts, std::span<const std::byte> bytes);

/// As they are after the last step, where d has the rock.
BoltForces forces(const DeviceBolts& bolts, const Field& d);

}  // namespace rockfold::bolts
