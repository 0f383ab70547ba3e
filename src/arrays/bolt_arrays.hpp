// Bolts as elements of an analysis, as flat arrays: the contract between host/bolting (which finds what they go through) and
// kernels/bolts (which load them).
//
// A bolt is a chain of points of the rock along it, from the collar to the toe, and of steel between nodes. Between two points a link:
// a piece of one block, whose stretch the steel goes through evenly, or the crossing of a joint, where both points have one place in two
// blocks. At each node the steel is bonded to the rock that it would move with if nothing slipped.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// What a bolt is made of and held by.
struct BoltLaw {
  Real section = 0;          ///< N, E A: force per strain of the steel
  Real yield = 0;            ///< N, where the steel yields first …
  Real strength = 0;         ///< N, … and what it bears in the end
  Real rupture = 0;          ///< strain at which it breaks; 0: it breaks by `reach`
  Real reach = 0;            ///< m by which a crossing may open or shear in all, at capacity
  Real stiffness = 0;        ///< N/m, of the elastic part of that
  Real shear_strength = 0;   ///< N across the bolt
  Real bond_stiffness = 0;   ///< N/m for each metre
  Real bond_strength = 0;    ///< N for each metre; infinite: the bond never slides
  Real plate_stiffness = 0;  ///< N/m
  Real plate_strength = 0;   ///< N; 0: no plate
  Real pretension = 0;       ///< N
  /// Share of its stiffness that the steel has when it is pushed: hardly any of a bolt; all: it bears to both sides alike, and yields so.
  Real pushed = 0;
};

enum class BoltLink : std::uint8_t {
  piece,    ///< in one block, or across air
  crossing  ///< of a joint
};

/// B bolts with N points, N − B links, M nodes and M − B pieces of steel.
struct BoltArrays {
  MaterialPoints points;              ///< [N]
  std::vector<Vec3> place;            ///< [N] m, before anything moves
  std::vector<Index> point_begin{0};  ///< [B+1]
  std::vector<Vec3> direction;        ///< [B] unit, into the rock
  std::vector<Real>
      toe;  ///< [B] m from the collar, where the steel ends: beyond the last node where the rock goes on beyond the model
  std::vector<BoltLaw> law;    ///< [B]
  std::vector<Index> install;  ///< [B] stage of the analysis with whose first step it acts

  std::vector<BoltLink> link;  ///< [N−B]
  std::vector<Real>
      link_length;  ///< [N−B] m of steel: of a crossing, what of it is not held by rock
  std::vector<Real>
      elastic_length;  ///< [N−B] m of steel that stretches: of a crossing next to nothing, as rock holds it to the joint until it is crushed there
  std::vector<Real> dowel;            ///< [N−B] N/m across the bolt, of crossings
  std::vector<Index> steel_begin{0};  ///< [N−B+1] pieces of steel of each link

  std::vector<Index> node_begin{0};  ///< [B+1]
  std::vector<Real> node_place;      ///< [M] m from the collar
  std::vector<Real> bond_from,
      bond_to;  ///< [M] m from the collar, where the bond about it begins and ends
  std::vector<Index> node_element;  ///< [M] that holds it, or none

  Index count() const { return static_cast<Index>(law.size()); }
};

/// What has become of a piece of steel, or of the bond about a node.
enum class BoltStatus : std::uint8_t { elastic, yields, slides, broken };

/// As they are: of each node and each piece of steel, in the order of BoltArrays.
struct BoltForces {
  std::vector<std::uint8_t> installed;  ///< [B]
  std::vector<Real> axial;              ///< [M−B] N, tension positive
  std::vector<Real> shear;              ///< [M−B] N, at crossings
  std::vector<BoltStatus> steel;        ///< [M−B]
  std::vector<Real> slip;               ///< [M] m, of the steel against the rock, towards the toe
  std::vector<BoltStatus> bond;         ///< [M]
  std::vector<Real> plate;              ///< [B] N
  std::vector<Real>
      peak;  ///< [B] N, the largest along it at the end of any step, before what breaks then is broken
};

/// Bolts as lines: of each piece of steel one between two of its nodes.
struct BoltLines {
  std::vector<Vec3> node;                   ///< [M] m
  std::vector<std::array<Index, 2>> steel;  ///< [P] into node
  std::vector<Index> bolt;                  ///< [P] from 0
};

/// What a state stores of them.
struct BoltLineState {
  std::vector<Vec3> displacement;  ///< [M] m, of the steel
  std::vector<Real> force;         ///< [P] N along it
  std::vector<Real> mobilisation;  ///< [P] of what it bears along and across
  std::vector<BoltStatus> status;  ///< [P] of the steel
};

}  // namespace rockfold
