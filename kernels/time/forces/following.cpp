#include "kernels/time/forces/following_kernel.hpp"
#include "kernels/time/forces/stress_kernel.hpp"

namespace rockfold::motion {
namespace {

PressedPoints pressed_points(const LoadPoints& all, const CoverArrays& covers) {
  PressedPoints pressed;
  const auto wanted = [&](std::size_t n) { return under_pressure(all, n); };
  std::vector<Vec3> area;
  std::vector<Real> pressure;
  std::vector<Index> table, side;
  for (std::size_t n = 0; n < all.points.size(); ++n) {
    if (!wanted(n)) continue;
    area.push_back(all.area[n]);
    pressure.push_back(all.pressure[n]);
    table.push_back(all.table[n]);
    side.push_back(all.side.empty() ? none : all.side[n]);
  }
  if (area.empty()) return pressed;
  const MaterialPoints points = choose_points(all.points, wanted);
  const Index count = static_cast<Index>(area.size());
  pressed.points = solve::make_point_rows(points, covers.unknown_count());
  pressed.element = device::to_device("motion::following_element", points.element);
  pressed.local = device::make_field("motion::following_local", count);
  pressed.area = device::make_field("motion::following_area", count);
  device::copy_to_device(points.local, pressed.local);
  device::copy_to_device(area, pressed.area);
  pressed.pressure = device::to_device("motion::following_pressure", pressure);
  pressed.table = device::to_device("motion::following_table", table);
  pressed.side = device::to_device("motion::following_side", side);
  pressed.force = device::make_field("motion::following_force", count);
  pressed.slopes = solve::sampled_slopes(covers, points.element, points.local);
  return pressed;
}

void add_pressed(const PressedPoints& pressed, const FollowingPressures& loads,
                 const Array<Real>& value, const Field& d, Real scale, const Field& f) {
  if (!pressed.points.any()) return;
  const PressedPoints p = pressed;
  const auto share = loads.share;
  const solve::ElementTable elements = loads.elements;
  device::for_each(
      "rockfold::motion::following", p.points.points.count, KOKKOS_LAMBDA(const Index n) {
        const Real x[3] = {p.local(n, 0), p.local(n, 1), p.local(n, 2)};
        Real deformed[3][3];
        gradient_at(elements, d, p.element(n), x, p.slopes.at(n), deformed);
        for (int i = 0; i < 3; ++i) deformed[i][i] += 1;
        const Real pressure = p.pressure(n) * (p.table(n) == none ? 1 : value(3 * p.table(n))) *
                              (p.side(n) == none ? 1 : share(p.side(n)));
        for (int i = 0; i < 3; ++i) {
          const Real *b = deformed[(i + 1) % 3], *c = deformed[(i + 2) % 3];
          const Real cofactor[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2],
                                    b[0] * c[1] - b[1] * c[0]};
          p.force(n, i) = -pressure * (cofactor[0] * p.area(n, 0) + cofactor[1] * p.area(n, 1) +
                                       cofactor[2] * p.area(n, 2));
        }
      });
  solve::scatter(p.points, scale, p.force, f);
}

}  // namespace

FollowingPressures make_following_pressures(const MotionSetup& setup) {
  FollowingPressures loads;
  loads.tractions = pressed_points(setup.loads, setup.covers);
  loads.in_joints = setup.water != nullptr;
  if (!loads.any()) return loads;
  loads.tables = DeviceTables(setup.loads.tables);
  loads.elements = solve::make_element_table(setup.covers, setup.moments, setup.materials);
  if (!loads.in_joints) return loads;
  loads.share = device::to_device("motion::water_share", std::vector<Real>(setup.water_sides, 1));
  loads.water = loads.water_at_end = pressed_points(*setup.water, setup.covers);
  return loads;
}

void set_water(FollowingPressures& loads, const CoverArrays& covers, const LoadPoints& water) {
  loads.water_at_end = pressed_points(water, covers);
}

void add_following_pressures(const FollowingPressures& loads, Real t, const Field& d, Real scale,
                             const Field& f) {
  if (!loads.any()) return;
  const auto value = loads.tables.at(t);
  add_pressed(loads.tractions, loads, value, d, scale, f);
  add_pressed(loads.water, loads, value, d, scale, f);
}

}  // namespace rockfold::motion
