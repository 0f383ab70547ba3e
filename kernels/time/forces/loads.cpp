#include <algorithm>
#include <cmath>

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/time/forces/loads_kernel.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::motion {
namespace {

Array<Real> flat(const std::vector<Vec3>& values) {
  std::vector<Real> numbers;
  for (const Vec3& v : values) numbers.insert(numbers.end(), v.begin(), v.end());
  return device::to_device("motion::table_values", numbers);
}

/// N at a pressure of its own: along the inward normal.
Vec3 pressure_force(const LoadPoints& loads, std::size_t n) {
  Vec3 force;
  for (int d = 0; d < 3; ++d) force[d] = -loads.pressure[n] * loads.area[n][d];
  return force;
}

}  // namespace

MaterialPoints choose_points(const MaterialPoints& all,
                             const std::function<bool(std::size_t)>& wanted) {
  MaterialPoints chosen;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (!wanted(n)) continue;
    chosen.element.push_back(all.element[n]);
    chosen.local.push_back(all.local[n]);
    for (Index i = all.begin[n]; i < all.begin[n + 1]; ++i) {
      chosen.unknown.push_back(all.unknown[i]);
      chosen.weight.push_back(all.weight[i]);
    }
    chosen.begin.push_back(static_cast<Index>(chosen.unknown.size()));
  }
  return chosen;
}

bool under_pressure(const LoadPoints& loads, std::size_t n) {
  return loads.pressure[n] != 0 && loads.area[n] != Vec3{};
}

DeviceTables::DeviceTables(std::vector<TimeTable> tables) : tables_(std::move(tables)) {}

Array<Real> DeviceTables::at(Real t) const {
  std::vector<Vec3> values;
  for (const TimeTable& table : tables_) values.push_back(table.at(t));
  return flat(values);
}

Array<Real> DeviceTables::slope_after(Real t) const {
  std::vector<Vec3> values;
  for (const TimeTable& table : tables_) values.push_back(table.slope_after(t));
  return flat(values);
}

Array<Real> DeviceTables::at_or_before(Real t, Real start) const {
  if (t >= start) return at(t);
  std::vector<Vec3> values;
  for (const TimeTable& table : tables_) {
    values.push_back(table.at(start));
    const Vec3 slope = table.slope_after(start);
    for (int d = 0; d < 3; ++d) values.back()[d] += (t - start) * slope[d];
  }
  return flat(values);
}

bool DeviceTables::moving_after(Real t) const {
  return std::any_of(tables_.begin(), tables_.end(),
                     [&](const TimeTable& table) { return table.slope_after(t) != Vec3{}; });
}

VaryingLoads make_varying_loads(const MotionSetup& setup, const Field& mass) {
  const LoadPoints& all = setup.loads;
  const auto wanted = [&](std::size_t n) {
    return all.table[n] != none && !(setup.large && under_pressure(all, n));  // following.cpp
  };
  std::vector<Index> table;
  std::vector<Real> scale;
  std::vector<Vec3> by_x;
  for (std::size_t n = 0; n < all.points.size(); ++n) {
    if (!wanted(n)) continue;
    const bool pressure = under_pressure(all, n);
    table.push_back(all.table[n]);
    scale.push_back(pressure ? 0 : all.scale[n]);
    by_x.push_back(pressure ? pressure_force(all, n) : Vec3{});
  }
  VaryingLoads loads;
  const Index count = static_cast<Index>(table.size());
  loads.points =
      solve::make_point_rows(choose_points(all.points, wanted), setup.covers.unknown_count());
  loads.table = device::to_device("motion::load_table", table);
  loads.scale = device::to_device("motion::load_scale", scale);
  loads.by_x = device::make_field("motion::load_by_x", count);
  loads.force = device::make_field("motion::load_force", count);
  device::copy_to_device(by_x, loads.by_x);
  loads.tables = DeviceTables(all.tables);
  loads.base = setup.base_acceleration;
  if (!loads.base.empty()) loads.mass = mass;
  return loads;
}

void varying_load(const VaryingLoads& loads, Real t, const Field& f) {
  if (loads.base.empty()) {
    Kokkos::deep_copy(f, 0.0);
  } else {
    const Vec3 base = loads.base.at(t);
    const Real x = base[0], y = base[1], z = base[2];
    const auto mass = loads.mass;
    device::for_each(
        "rockfold::motion::base_load", static_cast<Index>(f.extent(0)),
        KOKKOS_LAMBDA(const Index p) {
          f(p, 0) = -x * mass(p, 0);
          f(p, 1) = -y * mass(p, 1);
          f(p, 2) = -z * mass(p, 2);
        });
  }
  if (!loads.points.any()) return;
  const auto value = loads.tables.at(t), scale = loads.scale;
  const auto table = loads.table;
  const auto by_x = loads.by_x, force = loads.force;
  device::for_each(
      "rockfold::motion::varying_load", loads.points.points.count, KOKKOS_LAMBDA(const Index n) {
        const Index row = 3 * table(n);
        for (int d = 0; d < 3; ++d)
          force(n, d) = scale(n) * value(row + d) + value(row) * by_x(n, d);
      });
  solve::scatter(loads.points, 1, force, f);
}

std::vector<Vec3> constant_load(const MotionSetup& setup, const std::vector<Vec3>& mass) {
  std::vector<Vec3> load(mass.size());
  for (std::size_t p = 0; p < mass.size(); ++p)
    for (int d = 0; d < 3; ++d) load[p][d] = mass[p][d] * setup.gravity[d];
  const LoadPoints& all = setup.loads;
  for (std::size_t n = 0; n < all.points.size(); ++n) {
    if (all.table[n] != none) continue;
    Vec3 force = all.force[n];
    if (under_pressure(all, n) && !setup.large)
      for (int d = 0; d < 3; ++d) force[d] += pressure_force(all, n)[d];
    for (Index i = all.points.begin[n]; i < all.points.begin[n + 1]; ++i)
      for (int d = 0; d < 3; ++d) load[all.points.unknown[i]][d] += all.points.weight[i] * force[d];
  }
  return load;
}

Dashpots make_dashpots(const QuietPoints& quiet, Index unknowns) {
  const Index count = static_cast<Index>(quiet.points.size());
  Dashpots dashpots;
  dashpots.points = solve::make_point_rows(quiet.points, unknowns);
  dashpots.normal = device::make_field("motion::quiet_normal", count);
  device::copy_to_device(quiet.normal, dashpots.normal);
  dashpots.normal_damping = device::to_device("motion::normal_damping", quiet.normal_damping);
  dashpots.shear_damping = device::to_device("motion::shear_damping", quiet.shear_damping);
  dashpots.force = device::make_field("motion::dashpot_force", count);
  return dashpots;
}

void add_dashpots(const Dashpots& dashpots, Real factor, const Field& x, const Field& y) {
  if (!dashpots.any()) return;
  const Dashpots c = dashpots;
  const solve::DevicePoints points = c.points.points;
  device::for_each(
      "rockfold::motion::dashpots", points.count, KOKKOS_LAMBDA(const Index n) {
        Real v[3], along = 0;
        for (int d = 0; d < 3; ++d) {
          v[d] = solve::interpolate_one(points, n, d, x);
          along += v[d] * c.normal(n, d);
        }
        const Real shear = c.shear_damping(n), extra = (c.normal_damping(n) - shear) * along;
        for (int d = 0; d < 3; ++d) c.force(n, d) = shear * v[d] + extra * c.normal(n, d);
      });
  solve::scatter(c.points, factor, c.force, y);
}

void set_tangents(const Dashpots& dashpots, Real factor, const solve::PointTerms& terms,
                  Index first) {
  if (!dashpots.any()) return;
  const Dashpots c = dashpots;
  const auto tangent = terms.tangent;
  device::for_each(
      "rockfold::motion::dashpot_tangents", c.points.points.count, KOKKOS_LAMBDA(const Index n) {
        const Real shear = c.shear_damping(n), extra = c.normal_damping(n) - shear;
        for (int i = 0; i < 3; ++i)
          for (int j = i; j < 3; ++j)
            tangent(first + n, solve::symmetric_entry(i, j)) =
                factor * ((i == j ? shear : 0) + extra * c.normal(n, i) * c.normal(n, j));
      });
}

MovingSupports make_moving_supports(const FixedPoints& fixed,
                                    const solve::ConstrainedSystem& system) {
  MovingSupports supports;
  if (fixed.tables.empty() || fixed.table.empty()) return supports;
  const Index count = system.springs.points.count;
  std::vector<Index> of_merged(count, none);
  for (std::size_t n = 0; n < fixed.table.size(); ++n)
    of_merged[system.shares.merged[n]] = fixed.table[n];
  supports.tables = DeviceTables(fixed.tables);
  supports.table = device::to_device("motion::support_table", of_merged);
  return supports;
}

void move_supports(const MovingSupports& supports, Real t, const solve::Springs& springs) {
  if (!supports.tables.any()) return;
  const auto value = supports.tables.at(t);
  const auto table = supports.table;
  const auto target = springs.target;
  device::for_each(
      "rockfold::motion::move_supports", springs.points.count, KOKKOS_LAMBDA(const Index n) {
        if (table(n) == none) return;
        for (int d = 0; d < 3; ++d) target(n, d) = value(3 * table(n) + d);
      });
}

}  // namespace rockfold::motion
