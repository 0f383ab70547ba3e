// The rock of a nasty model and its frame: joints are drawn in the unit cube and mapped into the world.
#pragma once

#include <string>
#include <vector>

#include "tests/cut/models/draw.hpp"
#include "tests/cut/models/nasty_models.hpp"
#include "tests/cut/oracles/voxel_oracle.hpp"

namespace rockfold::test {

class NastyBody {
 public:
  /// `single`: a box, nothing added or subtracted.
  NastyBody(unsigned seed, bool single);

  NastyModel take(std::string kind);

  Draw draw;

  /// A plane or a polygon, in the unit cube's coordinates. The polygon's plane is the one that best fits its corners.
  void plane(const Vec3& normal, const Vec3& point);
  void polygon(const std::vector<Vec3>& corners);
  /// Of the world's angles; a disc of the world's metres over the size.
  void dipping(const DipOrientation& orientation, const Vec3& point);
  void disc(const Vec3& normal, const Vec3& centre, Real radius);
  /// Each coordinate off by up to `by`.
  Vec3 off(Vec3 x, Real by);
  /// 1e-16 … 1e-7, now and then nothing; of either sign.
  Real tiny();
  /// A random point well inside the unit cube.
  Vec3 inner() { return draw.within(0.25, 0.75); }

  bool far() const { return far_; }

 private:
  void choose_frame();
  void add_boxes(bool single);
  void add_regions();
  Solid solid(const Vec3& low, const Vec3& high, bool add);

  AffineMap map_;
  bool straight_ = true, far_ = false, prisms_ = false;
  NastyModel result_;
  std::vector<Solid> unit_boxes_;  // the same solids in the unit cube's coordinates
};

}  // namespace rockfold::test
