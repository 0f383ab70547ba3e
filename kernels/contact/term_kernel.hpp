// Contact as a term of the time step: the forces of contact points on the functions of the covers, and the rows of their tangents.
//
// Surface vertices are points of the material, x = home + N d. A contact point is a sum over up to six of them, so that it acts on the
// functions of their covers: for each detection those are merged to one list a point, and transposed by a stable sort, so that products
// and forces have one writer an unknown and the same bits on any number of threads. Nothing allocates once arrays have grown.
#pragma once

#include "kernels/contact/contact_kernel.hpp"

namespace rockfold::contact {

struct ContactTerm {
  DeviceContacts contacts;
  solve::DevicePoints vertex;  ///< functions of the surface vertices
  Field home;        ///< [V] m, undeformed, about the model's middle: digits are those of its size
  Motion motion;     ///< of the vertices
  Field force;       ///< of the points, on their first sides, N
  Tangents tangent;  ///< of the points
  Field heading, held;                        ///< hold_reversed
  Array<Index> staged_begin, staged_unknown;  ///< lists not merged yet; work space
  Array<Index> owner;                         ///< the point of each entry of the rows; work space
  Array<Real> staged_weight;
  SortedKeys transposed;
  Index rows_of = 0;     ///< the detection whose points the rows are of
  ContactEnergy energy;  ///< as evaluated last
};
ContactTerm make_contact_term(const SurfaceArrays& surfaces, const MaterialPoints& points,
                              const ContactOptions& options);

/// Empty rows for any number of points: every unknown has one.
solve::PointTerms make_contact_rows(Index unknowns);

/// Vertices where the displacement d has them, moving by v; `speed_by_gap` and `dt` as Motion has them.
void set_motion(ContactTerm& term, const Field& d, const Field& v, Real speed_by_gap, Real dt);

/// Finds the points where vertices are now, and writes their rows. Their tangents are those of the last write_tangents no more.
DetectReport detect(ContactTerm& term, solve::PointTerms& rows);

/// Forces and tangents of the points where vertices are now; f += scale · Nᵀ Gᵀ force.
void add_forces(ContactTerm& term, const solve::PointTerms& rows, Real scale, const Field& f);

/// acting += scale · Σ |weight| ‖force‖ of the points on each unknown, N, of the forces found last.
void add_force_sizes(const ContactTerm& term, const solve::PointTerms& rows, Real scale,
                     const Array<Real>& acting);

/// Of the forces found last, those of the points between rock that is gone and rock that is not; others become zero.
void keep_wall_forces(ContactTerm& term);

/// The next correction is the first of its kind: no point has slid yet.
void forget_headings(ContactTerm& term);

/// Friction is S-shaped in the slip: from one flat end of it Newton's iteration jumps to the other and back. A point that has turned round
/// is linearised as if it stuck, once: what it then asks for is where it slides to, if it does. f += scale · Nᵀ Gᵀ what that adds
/// to forces; returns how many points there are.
Index hold_reversed(ContactTerm& term, const solve::PointTerms& rows, Real scale, const Field& f);

/// factor · D into the rows. Returns whether all are symmetric.
bool write_tangents(const ContactTerm& term, Real factor, solve::PointTerms& rows);

/// No tangents: for what is solved without contact. Returns true, as write_tangents.
bool clear_tangents(const solve::PointTerms& rows);

/// N: what rounding of places leaves of the forces of closed points.
Real rounding(const ContactTerm& term);

}  // namespace rockfold::contact
