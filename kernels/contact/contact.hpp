// Contact between blocks: the points at which surfaces are near each other, what they remember, and the forces there.
//
//   surfaces.cpp              blocks as convex parts with real faces, in a pose
//   broad_phase.cpp, sort     which parts are near: boxes in grids
//   separating_plane_kernel   on which plane two parts touch; it persists from step to step
//   cone_kernel               the middle of all such planes, where edges lie on edges and corners on corners
//   pair_points_kernel        the points of a pair: corners and insides of the overlaps of its faces on that plane
//   overlap_kernel            overlaps of two polygons, and their quadrature
//   turning_kernel            which faces turn in their plane while they slide, and need more points
//   handover_kernel           memories from the points before to those now; shear forces keep their sum
//   detect.cpp                all of these
//   joint_stress.cpp          joints under the initial stress at step 0
//   law                       traction, tangent and memory of one point over a step
//   evaluate.cpp              forces and tangents of all points; accept; energies
//   gone.cpp                  rock that is excavated on the way
//   state.cpp                 the whole state as bytes
//
// A time step calls (contact_kernel.hpp has the same on the device):
//
//   detect(x')                      once for the predicted places: points, normals and areas hold for the Newton iterations
//     evaluate(x, v)                in each iteration: forces, tangents; memories are those of the step's start
//   detect(x)                       at the places found, where a vertex has come far from x': report.missed > 0: iterate again
//   accept(x, v)                    memories, planes and places become those that the next step starts from
//
// Before the first step: detect(x), then accept(x, v) with the velocities that it starts with, which impacts are measured by.
// A step that is dropped needs no call: everything starts again from what was accepted last. bytes() is all of that.
//
// Limits: parts are rigid enough for their faces to stay plane to `search_distance`. Parts of one block never touch each other. Edges of a
// block that is not convex are found where two faces of the cutting's cells share a whole side; elsewhere faces and vertices alone
// give the plane.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "src/arrays/contact_arrays.hpp"
#include "src/arrays/load_arrays.hpp"
#include "src/arrays/surface_arrays.hpp"

namespace rockfold {

struct ContactOptions {
  std::vector<JointLaw> laws;  ///< by Model::joint_materials
  /// [surfaces + 1][surfaces + 1] of faces that met, by SurfaceArrays::face_material + 1; empty: the first law.
  std::vector<std::int16_t> law_of_pair;
  Real restitution = 0;      ///< 0 … 1
  Real search_distance = 0;  ///< m: points with a larger gap are not looked at
  Real skin = 0;             ///< m: boxes are sorted again once a vertex has moved by half of it
  Real still =
      -1;  ///< m: points serve on while no vertex has moved by more; < 0: they are always found anew
  InitialStress initial_stress{};  ///< in joints at step 0
};

class Contacts {
 public:
  Contacts(const SurfaceArrays& surfaces, const ContactOptions& options);
  ~Contacts();
  Contacts(Contacts&&) noexcept;
  Contacts& operator=(Contacts&&) noexcept;

  /// Finds the points with all vertices at x [V], m. The first call finds those of step 0: joints of the cut are whole, their gaps zero.
  DetectReport detect(const std::vector<Vec3>& x);

  struct Forces {
    std::vector<Vec3> force;    ///< [points] N, on the first side
    std::vector<Mat3> tangent;  ///< [points] N/m, −d(force)/d(Σ weight · x)
    ContactEnergy energy;
  };
  /// For vertices at x with velocities v (empty: none, and no impact) at the end of a step of dt, with speed_by_gap = γ/(βΔt).
  Forces evaluate(const std::vector<Vec3>& x, const std::vector<Vec3>& v = {}, Real dt = 0,
                  Real speed_by_gap = 0) const;
  void accept(const std::vector<Vec3>& x, const std::vector<Vec3>& v = {}, Real dt = 0,
              Real speed_by_gap = 0);

  /// As detected last; of each pair of parts together, pairs ascending.
  std::vector<ContactPoint> points() const;
  ContactCount count() const;

  /// All that the next step depends on, as bytes of this machine.
  std::vector<std::byte> bytes() const;
  void restore(std::span<const std::byte> bytes);

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace rockfold
