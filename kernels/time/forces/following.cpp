#include "kernels/time/forces/following_kernel.hpp"
#include "kernels/time/forces/stress_kernel.hpp"

namespace rockfold::motion {

FollowingPressures make_following_pressures(const MotionSetup& setup) {
  FollowingPressures loads;
  const LoadPoints& all = setup.loads;
  const auto wanted = [&](std::size_t n) { return under_pressure(all, n); };
  std::vector<Vec3> area;
  std::vector<Real> pressure;
  std::vector<Index> table;
  for (std::size_t n = 0; n < all.points.size(); ++n) {
    if (!wanted(n)) continue;
    area.push_back(all.area[n]);
    pressure.push_back(all.pressure[n]);
    table.push_back(all.table[n]);
  }
  if (area.empty()) return loads;
  const MaterialPoints points = choose_points(all.points, wanted);
  const Index count = static_cast<Index>(area.size());
  loads.points = solve::make_point_rows(points, setup.covers.unknown_count());
  loads.element = device::to_device("motion::following_element", points.element);
  loads.local = device::make_field("motion::following_local", count);
  loads.area = device::make_field("motion::following_area", count);
  device::copy_to_device(points.local, loads.local);
  device::copy_to_device(area, loads.area);
  loads.pressure = device::to_device("motion::following_pressure", pressure);
  loads.table = device::to_device("motion::following_table", table);
  loads.force = device::make_field("motion::following_force", count);
  loads.tables = DeviceTables(all.tables);
  loads.slopes = solve::sampled_slopes(setup.covers, points.element, points.local);
  loads.elements = solve::make_element_table(setup.covers, setup.moments, setup.materials);
  return loads;
}

void add_following_pressures(const FollowingPressures& loads, Real t, const Field& d, Real scale,
                             const Field& f) {
  if (!loads.any()) return;
  const auto value = loads.tables.at(t);
  const auto element = loads.element, table = loads.table;
  const auto local = loads.local, area = loads.area, force = loads.force;
  const auto pressure = loads.pressure;
  const solve::ElementTable elements = loads.elements;
  const solve::PointSlopes slopes = loads.slopes;
  device::for_each(
      "rockfold::motion::following", loads.points.points.count, KOKKOS_LAMBDA(const Index n) {
        const Real x[3] = {local(n, 0), local(n, 1), local(n, 2)};
        Real deformed[3][3];
        gradient_at(elements, d, element(n), x, slopes.at(n), deformed);
        for (int i = 0; i < 3; ++i) deformed[i][i] += 1;
        const Real p = pressure(n) * (table(n) == none ? 1 : value(3 * table(n)));
        for (int i = 0; i < 3; ++i) {
          const Real *b = deformed[(i + 1) % 3], *c = deformed[(i + 2) % 3];
          const Real cofactor[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2],
                                    b[0] * c[1] - b[1] * c[0]};
          force(n, i) =
              -p * (cofactor[0] * area(n, 0) + cofactor[1] * area(n, 1) + cofactor[2] * area(n, 2));
        }
      });
  solve::scatter(loads.points, scale, force, f);
}

}  // namespace rockfold::motion
