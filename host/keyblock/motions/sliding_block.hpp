// Newmark's sliding block: how far a rigid block slides while the ground shakes it (Newmark, Géotechnique 15, 1965, 139), in the mode that
// block theory finds for it at rest (sliding.hpp).
//
//   r(t)                                   weight and loads less m a(t), a: acceleration of the ground
//   one plane    N = r·n,      P = 1 − n nᵀ    b = n
//   two planes   N_i = r·b_i,  P = s sᵀ        b_i·n_i = 1, b_i·n_j = 0
//   resistance   R = Σ max(0, N_i) tan φ_i + c_i A_i       peak values up to the first slip, residual ones after it
//   motion       m v' = P r − R v/|v|; at rest where |P r| ≤ R
//
// A step of length h takes w = v + h P r/m and leaves v' = w max(0, 1 − h R/(m |w|)): friction at the step's end, so that what stops stays. No
// other plane is entered that the block leans on: uphill it goes no further than where it has come from.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/keyblock/motions/sliding.hpp"

namespace rockfold {

/// What is left of a plane's strength once the block has slipped.
struct PlaneStrength {
  Real friction = 0;  ///< tan φ
  Real cohesion = 0;  ///< N
};

class SlidingBlock {
 public:
  /// `movement`: along one plane or two of `planes`; `residual` strengths of these, in their order. `mass` in kg, > 0.
  SlidingBlock(std::span<const ContactPlane> planes, const Movement& movement,
               const std::array<PlaneStrength, 2>& residual, Real mass);

  /// A time of dt, s, in which the resultant is r, N.
  void go(const Vec3& r, Real dt);
  void stop() { velocity_ = {}; }

  const Vec3& displacement() const { return displacement_; }  ///< m
  /// Whether a plane that it slides on has lost its pressure: for that time it would have left it.
  bool has_lifted() const { return lifted_; }

 private:
  struct SlidingPlane {
    Vec3 reciprocal{};  ///< b
    PlaneStrength peak, residual;
  };
  Vec3 along(const Vec3& v) const;
  Real resistance(const Vec3& r);
  Vec3 kept_out(Vec3 velocity) const;

  bool line_;                         ///< two planes
  Vec3 direction_;                    ///< s, or the plane's n
  std::vector<SlidingPlane> planes_;  ///< one or two
  std::vector<Vec3> walls_;  ///< unit, along which it cannot go beyond its place at the start
  Real mass_;
  Vec3 velocity_{}, displacement_{};
  bool slipped_ = false, lifted_ = false;
};

}  // namespace rockfold
