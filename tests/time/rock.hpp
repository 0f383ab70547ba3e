// A small rock with everything that Motion asks for.
#pragma once

#include "kernels/integrate/moments.hpp"
#include "kernels/time/motion.hpp"
#include "tests/reference/box_covers.hpp"
#include "tests/reference/dense_system.hpp"

namespace rockfold {

struct Rock {
  reference::CoveredRegions covered;
  std::vector<ElasticMaterial> materials{{2000, 1e8, 0.25}};
  FixedPoints fixed;
  PieceMoments moments;

  explicit Rock(reference::CoveredRegions made)
      : covered(std::move(made)), moments(piece_moments(covered.arrays)) {}

  const CoverArrays& covers() const { return covered.arrays; }
  MotionSetup setup() const {
    MotionSetup setup{covers(), moments, materials, fixed};
    setup.solver.tolerance = 1e-12;
    setup.solver.max_iterations = 20000;
    return setup;
  }
  TrackedPoints track(const std::vector<Vec3>& points) const {
    return TrackedPoints(reference::locate(covered, points));
  }
  /// Springs of `stiffness` at all corners where `wanted`.
  void hold(
      const std::function<bool(const Vec3&)>& wanted, Real stiffness, bool augmented,
      const std::function<Vec3(const Vec3&)>& value = [](const Vec3&) { return Vec3{}; }) {
    fixed = reference::fix(covered, reference::corner_points(covered, wanted), value, stiffness,
                           augmented);
  }
};

/// Constant forces at points.
inline LoadPoints forces_at(const Rock& rock, const std::vector<Vec3>& points,
                            const std::vector<Vec3>& forces) {
  LoadPoints loads;
  loads.points = reference::locate(rock.covered, points);
  loads.force = forces;
  loads.table.assign(points.size(), none);
  loads.scale.assign(points.size(), 1);
  loads.area.assign(points.size(), {});
  loads.pressure.assign(points.size(), 0);
  return loads;
}

/// A box that no lattice plane of a lattice turned about two axes meets.
inline Rock turned_box(const Vec3& low, const Vec3& high, Real spacing) {
  const Vec3 centre{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  const Real radius = std::sqrt(std::pow(high[0] - low[0], 2) + std::pow(high[1] - low[1], 2) +
                                std::pow(high[2] - low[2], 2)) /
                      2;
  return Rock(reference::cover_regions(
      reference::turned_lattice({0.11, -0.23, 0.37}, spacing, 0.3, 0.2, centre, radius),
      {reference::box(low, high)}));
}

/// A box of whole lattice cells, cut nowhere.
inline Rock whole_box(const std::array<Index, 3>& cells, Real spacing) {
  Lattice lattice;
  lattice.edge = {{{spacing, 0, 0}, {0, spacing, 0}, {0, 0, spacing}}};
  lattice.cells = cells;
  return Rock(reference::cover_regions(lattice, {{{}, 0, 0, 0}}));
}

}  // namespace rockfold
