// Contacts on the device: what the time step calls. See contact.hpp for the order of calls.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/contact/contact.hpp"
#include "kernels/contact/detection/broad_phase_kernel.hpp"
#include "kernels/contact/detection/point_set_kernel.hpp"
#include "kernels/operator/point_terms_kernel.hpp"

namespace rockfold::contact {

/// −d(force)/d(displacement of the first side from the second), N/m.
using solve::Tangents;

/// Where the surface vertices are and how fast they move, at the end of a step.
struct Motion {
  Field x;  ///< [V] m
  Field v;  ///< [V] m/s; unused where speed_by_gap = 0
  Real speed_by_gap =
      0;        ///< 1/s, d(velocity)/d(place) of the step: γ/(βΔt); 0: no speeds, no impact
  Real dt = 0;  ///< s
};

struct DeviceContacts {
  Surfaces surfaces;
  ContactOptions options;
  Array<JointLaw> laws;
  Array<std::int16_t> law_of_pair;  ///< ContactOptions::law_of_pair
  Array<std::uint8_t> met;  ///< likewise: 1: such faces, which no joint joined, have touched

  Pose before;         ///< of the last accepted step
  Field speed_before;  ///< [V] m/s then
  Pose now;            ///< work space: of the pose that detection looks at
  Field sorted_at;     ///< [V] where vertices were when boxes were sorted last
  Pairs candidates;    ///< of then
  PointSet accepted;   ///< at the last accepted step
  PointSet current;    ///< as detected last
  Index detections = 0;
  bool started = false;
  bool detected = false;  ///< since the last accepted step

  BroadPhase broad;
  Array<Plane> spare_plane;    ///< that the next detection writes
  Array<Index> near;           ///< [pairs] 0 or 1, then places; work space
  Array<Index> near_pair;      ///< the pairs near enough to have points
  Array<Index> staged_count;   ///< of each of these
  Array<ContactPoint> staged;  ///< [near][capacity]
  Index capacity = 16;         ///< points of a pair; doubled where a pair has more
  Array<Real> partial, total;  ///< of sums
  Array<Real> gain;            ///< [pairs] J; work space
};

DeviceContacts make_contacts(const SurfaceArrays& surfaces, const ContactOptions& options);

/// Finds the points of a pose into `current`, from `accepted`; the first call is step 0. Those found before serve on while no vertex
/// has gone further than `still` since.
DetectReport detect(DeviceContacts& contacts, const Field& x);

/// rad, the largest turn of a face from the last accepted step to the pose that detection looked at last.
Real largest_turn(const DeviceContacts& contacts);

/// Of pairs that have come beyond the plane that parted them at the last accepted step, to the pose that detection looked at last, and that no other
/// parted all the way: the largest depth over half the width of the thinner part. Beyond 1 a pair may come out on the other side.
Real largest_crossing(const DeviceContacts& contacts);

/// Gives the points of joints, as accepted at step 0, the tractions of the initial stress with all vertices at x: as shear stretch, and as
/// a dilation that closes.
void stress_joints(const DeviceContacts& contacts, const Field& x);

/// [points] The force of each point of `current` on its first side, N, and its tangent.
ContactEnergy evaluate(DeviceContacts& contacts, const Motion& motion, const Field& force,
                       const Tangents& tangent);

/// Points that slide against the `heading` [points] (zero: none) in which they slid when this was called last are to be held: gets their
/// tangents, and the forces, N, that `held` has beyond those of `evaluate`, as if they stuck. Returns how many.
Index hold_reversed(DeviceContacts& contacts, const Motion& motion, const Field& heading,
                    const Field& held, const Tangents& tangent);

/// Breaks the bonds that do not bear the tractions of this motion, for the step and all that detection finds in it. Returns how many.
Index break_bonds(DeviceContacts& contacts, const Motion& motion);

/// Of the step that ends with this motion, before it is accepted: the pair that stores and loses most beyond what it stored before and what
/// the rock's work has given it.
EnergyGain find_largest_gain(DeviceContacts& contacts, const Motion& motion);

/// N s: what points that have met or parted in the step have given the first side, all sizes added.
Real impulse_of_impacts(DeviceContacts& contacts, const Motion& motion);

/// Makes the end of a step the start of the next: memories, planes, places and speeds. Returns the elastic energy of its points, J.
Real accept(DeviceContacts& contacts, const Motion& motion);

/// Which points go on, and by how much: order(0 … count − 1), each by period/2^level s.
struct PointClocks {
  Array<Index> order;
  Array<int> level;  ///< [points]
  Index count = 0;
  Real period = 0;       ///< s
  Real restitution = 0;  ///< that of impacts; 1 where nothing hits anything
};
/// Explicit substeps: takes points of `current` to the motion m (its speeds count), in place. `force` [points], N, has those that each ended with
/// before, and gets those of now; `impact` [points], unless it is empty, the shares of these that impacts explain. account[0] += what friction took, account[1] += what the contact's forces did on the rock, J.
void advance(DeviceContacts& contacts, const Motion& motion, const PointClocks& clocks,
             const Field& force, const Array<Real>& impact, const Array<Real>& account);
/// The points as they are now become those of the last accepted step, with vertices at x moving by v. Returns their elastic energy, J.
Real settle_in_place(DeviceContacts& contacts, const Field& x, const Field& v);
/// [points] factor · the stiffness of each point of `current` while it is closed and sticks, N/m.
void write_stiffest(const DeviceContacts& contacts, Real factor, const solve::Blocks& tangent);

/// The next step starts with that share of the speeds that the last one ended with.
void scale_speeds(const DeviceContacts& contacts, Real share);

/// J, elastic, of the points accepted last.
Real stored_energy(DeviceContacts& contacts);

/// Blocks, [B] 1, that touch nothing any more.
void set_gone(const DeviceContacts& contacts, const std::vector<std::uint8_t>& block);
/// Nor have they touched anything at the last accepted step, at whose end vertices are said to have been at x, theirs at rest.
void forget_gone(DeviceContacts& contacts, const Field& x);

/// Pairs are found in new arrays each time, and need no copy.
void copy(const PointSet& from, PointSet& to);

/// What was accepted last, kept aside.
struct Accepted {
  bool started = false;
  Field x, speed, sorted_at;
  Pairs candidates;
  PointSet points;
};
void keep(const DeviceContacts& contacts, Accepted& kept);
void restore(DeviceContacts& contacts, const Accepted& kept);

std::vector<std::byte> bytes(const DeviceContacts& contacts);
void restore(DeviceContacts& contacts, std::span<const std::byte> bytes);

/// Those detected last, or, if none have been since, those accepted.
std::vector<ContactPoint> points(const DeviceContacts& contacts);
ContactCount count_states(const DeviceContacts& contacts);
/// DeviceContacts::met.
std::vector<std::uint8_t> surfaces_that_met(const DeviceContacts& contacts);

}  // namespace rockfold::contact
