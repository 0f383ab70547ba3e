#include "host/cover/points/loads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "host/cover/points/free_faces.hpp"
#include "host/cover/points/locate.hpp"
#include "host/cover/points/triangle_rule.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"
#include "src/space/stress_on_plane.hpp"

namespace rockfold {

namespace {

Error error_at(const Place& entry, const std::string& key, const std::string& message) {
  Place place = entry;
  place.key += "." + key;
  return {ErrorKind::model, message, place};
}

Error outside(const Place& entry, const std::string& key, const Vec3& x) {
  return error_at(entry, key,
                  fmt::format("({:g}, {:g}, {:g}) is not in the rock", x[0], x[1], x[2]));
}

/// Points on the free faces of a region, each with its share of the area.
class FaceIntegral {
 public:
  FaceIntegral(const Cutting& cutting, const Covering& covering, int degree)
      : cutting_(cutting), covering_(covering), rule_(triangle_rule(degree)) {}

  /// Calls add(polygon, point, area) for points of the parts where `depth`, linear, is not below zero. Returns whether there is any
  /// free face.
  template <class Faces, class Add, class Depth>
  bool over(const Faces& faces, const Add& add, const Depth& depth) const {
    bool any = false;
    visit_free_faces(cutting_, covering_, faces, [&](const FacePolygon& polygon) {
      any = true;
      const auto corner = part_below(polygon.corner, depth);
      for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
        const Real area =
            0.5 * polygon.share * norm(cross(corner[k] - corner[0], corner[k + 1] - corner[0]));
        for (const auto& [at, weight] : rule_)
          add(polygon, at[0] * corner[0] + at[1] * corner[k] + at[2] * corner[k + 1],
              weight * area);
      }
    });
    return any;
  }
  template <class Faces, class Add>
  bool over(const Faces& faces, const Add& add) const {
    return over(faces, add, [](const Vec3&) { return Real{1}; });
  }

 private:
  /// What of a convex polygon lies where depth ≥ 0.
  template <class Depth>
  static std::vector<Vec3> part_below(const std::vector<Vec3>& corner, const Depth& depth) {
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const Vec3 &a = corner[i], &b = corner[(i + 1) % corner.size()];
      const Real da = depth(a), db = depth(b);
      if (da >= 0) part.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) part.push_back(a + da / (da - db) * (b - a));
    }
    return part;
  }

  const Cutting& cutting_;
  const Covering& covering_;
  const std::vector<RulePoint> rule_;
};

/// A force without area or table; the caller changes what is otherwise.
void add_force(LoadPoints& loads, const Vec3& force) {
  loads.force.push_back(force);
  loads.table.push_back(none);
  loads.scale.push_back(1);
  loads.area.push_back({});
  loads.pressure.push_back(0);
}

Index add_table(LoadPoints& loads, const TimeTable& table) {
  if (table.empty()) return none;
  loads.tables.push_back(table);
  return static_cast<Index>(loads.tables.size()) - 1;
}

/// What a pressure that does not follow is as a vector over time: −p n.
TimeTable along(TimeTable pressure, const Vec3& normal) {
  for (Vec3& p : pressure.value) p = -p[0] * normal;
  return pressure;
}

void add_traction(const FaceIntegral& faces, const CoverArrays& covers, const Traction& traction,
                  LoadPoints& loads) {
  const bool fixed_pressure = traction.pressure && !traction.follows;
  Index table = fixed_pressure ? none : add_table(loads, traction.table);
  Vec3 table_normal{};
  const bool any =
      faces.over(traction.where, [&](const FacePolygon& polygon, const Vec3& x, Real area) {
        add_material_point(covers, x, polygon.element, loads.points);
        if (fixed_pressure && !traction.table.empty() && polygon.normal != table_normal) {
          table_normal = polygon.normal;
          table = add_table(loads, along(traction.table, table_normal));
        }
        if (traction.follows) {
          add_force(loads, {});
          loads.area.back() = area * polygon.normal;
          loads.pressure.back() = traction.table.empty() ? traction.value[0] : 1;
        } else {
          add_force(loads, traction.pressure ? (-area * traction.value[0]) * polygon.normal
                                             : area * traction.value);
          loads.scale.back() = area;
        }
        loads.table.back() = table;
      });
  if (!any) throw error_at(traction.place, "where", "holds no free face of the rock");
}

/// Water up to an elevation: its pressure is that at the points where the rock lay at t = 0.
void add_water(const FaceIntegral& faces, const CoverArrays& covers, const Vec3& gravity,
               const Traction& traction, LoadPoints& loads) {
  const Vec3 up = -normalized(gravity);
  const auto depth = [&](const Vec3& x) { return *traction.head - dot(up, x); };
  const auto add = [&](const FacePolygon& polygon, const Vec3& x, Real area) {
    const Real pressure = traction.density * norm(gravity) * depth(x);
    add_material_point(covers, x, polygon.element, loads.points);
    add_force(loads, traction.follows ? Vec3{} : (-area * pressure) * polygon.normal);
    if (!traction.follows) return;
    loads.area.back() = area * polygon.normal;
    loads.pressure.back() = pressure;
  };
  if (!faces.over(traction.where, add, depth))
    throw error_at(traction.place, "where", "holds no free face of the rock");
}

}  // namespace

int function_degree(const CoverArrays& covers) {
  const LatticeKind kind = covers.lattice.kind;
  const int of_weights = kind == LatticeKind::hex8 ? 3 : kind == LatticeKind::block ? 0 : 1;
  return of_weights + covers.order;
}

LoadPoints load_points(const Cutting& cutting, const Covering& covering, const Model& model) {
  LoadPoints loads;
  const Locator locator(covering);
  for (const PointLoad& load : model.point_loads) {
    const Holder holder = locator.find_firm(load.point);
    if (!holder.found()) throw outside(load.place, "point", load.point);
    locator.add(load.point, holder, loads.points);
    add_force(loads, load.force);
    loads.table.back() = add_table(loads, load.table);
  }
  const int degree = function_degree(covering.arrays);
  const FaceIntegral faces(cutting, covering, degree), under_water(cutting, covering, degree + 1);
  for (const Traction& traction : model.tractions)
    if (traction.head)
      add_water(under_water, covering.arrays, model.gravity, traction, loads);
    else
      add_traction(faces, covering.arrays, traction, loads);
  return loads;
}

LoadPoints unloading_points(const Cutting& cutting, const Covering& covering,
                            const InitialStress& stress, const FacesOf& made_free) {
  LoadPoints loads;
  const FaceIntegral faces(cutting, covering, function_degree(covering.arrays) + 1);
  faces.over(made_free, [&](const FacePolygon& polygon, const Vec3& x, Real area) {
    add_material_point(covering.arrays, x, polygon.element, loads.points);
    add_force(loads, -area * traction_on(stress, x, polygon.normal));
  });
  return loads;
}

QuietPoints quiet_points(const Cutting& cutting, const Covering& covering, const Model& model) {
  QuietPoints quiet;
  const FaceIntegral faces(cutting, covering, 2 * function_degree(covering.arrays));
  for (const QuietBoundary& boundary : model.quiet_boundaries) {
    const bool any =
        faces.over(boundary.where, [&](const FacePolygon& polygon, const Vec3& x, Real area) {
          const Material& m = model.materials[material_of(covering.arrays, polygon.element)];
          const Real shear = m.young_modulus / (2 * (1 + m.poisson_ratio));
          const Real p_wave = 2 * shear * (1 - m.poisson_ratio) / (1 - 2 * m.poisson_ratio);
          add_material_point(covering.arrays, x, polygon.element, quiet.points);
          quiet.normal.push_back(polygon.normal);
          quiet.normal_damping.push_back(area * std::sqrt(m.density * p_wave));
          quiet.shear_damping.push_back(area * std::sqrt(m.density * shear));
        });
    if (!any) throw error_at(boundary.place, "where", "holds no free face of the rock");
  }
  return quiet;
}

std::vector<RigidVelocity> rigid_velocities(const Covering& covering, Index blocks,
                                            const Model& model) {
  const Locator locator(covering);
  std::vector<RigidVelocity> given;
  for (const InitialVelocity& start : model.initial_velocities) {
    RigidVelocity motion{{}, start.velocity, start.angular_velocity};
    if (start.block_at) {
      const Holder holder = locator.find(*start.block_at);
      if (!holder.found()) throw outside(start.place, "where.block_at", *start.block_at);
      motion.blocks = {holder.block};
    } else {
      motion.blocks.resize(blocks);
      std::iota(motion.blocks.begin(), motion.blocks.end(), 0);
    }
    given.push_back(std::move(motion));
  }
  return given;
}

}  // namespace rockfold
