// The model reader on any bytes: it reads a model that keeps what model.hpp promises, or throws an
// Error whose diagnostics all say something.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "src/model/planar_polygon.hpp"
#include "src/model/read/read_model.hpp"

namespace rockfold {
namespace {

void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

#define PROMISE(condition) promise(condition, #condition)

bool finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

template <class List>
bool refers(Index id, const List& list) {
  return id == none || (id >= 0 && static_cast<std::size_t>(id) < list.size());
}

struct CheckShape {
  void operator()(const BoxShape& box) const {
    for (int d = 0; d < 3; ++d) PROMISE(box.min[d] < box.max[d]);
  }
  void operator()(const HalfspacesShape& shape) const { PROMISE(!shape.planes.empty()); }
  void operator()(const PrismShape& prism) const {
    PROMISE(polygon_problem(prism.base).empty());
    PROMISE(leaves_plane(prism.base, prism.extrude));
  }
  void operator()(const PyramidShape& pyramid) const {
    PROMISE(polygon_problem(pyramid.base).empty());
    PROMISE(finite(pyramid.apex));
  }
  void operator()(const FrustumShape& frustum) const {
    PROMISE(frustum.base.size() == frustum.top.size());
    PROMISE(is_convex(frustum.base) && is_convex(frustum.top));
  }
  void operator()(const CylinderShape& cylinder) const {
    PROMISE(cylinder.radius > 0 && cylinder.axis[0] != cylinder.axis[1]);
    PROMISE(cylinder.sides >= 3 && cylinder.sides <= 1000);
  }
  void operator()(const SphereShape& sphere) const {
    PROMISE(sphere.radius > 0 && sphere.subdivisions >= 0 && sphere.subdivisions <= 7);
  }
  void operator()(const TunnelShape& tunnel) const {
    std::vector<Vec3> section;
    for (const auto& [x, y] : tunnel.section) section.push_back({x, y, 0});
    PROMISE(polygon_problem(section).empty() && doubled_area(section)[2] > 0);
    PROMISE(tunnel.path.size() >= 2);
    for (std::size_t i = 0; i + 1 < tunnel.path.size(); ++i)
      PROMISE(tunnel.path[i] != tunnel.path[i + 1]);
  }
  void operator()(const MeshShape& mesh) const { PROMISE(!mesh.file.empty() && !mesh.surface); }
  void operator()(const TerrainShape& terrain) const {
    PROMISE(!terrain.file.empty() && std::isfinite(terrain.base));
  }
};

void check(const std::optional<Distribution>& d) {
  if (!d) return;
  const bool power_law = d->kind == Distribution::Kind::power_law;
  PROMISE(power_law || d->mean > 0);
  PROMISE(d->kind != Distribution::Kind::log_normal || d->standard_deviation > 0);
  PROMISE(d->min >= 0 && d->min < d->max);
  PROMISE(!power_law || (d->exponent > 0 && d->min > 0 && std::isfinite(d->max)));
}

void check(const Model& model, const JointSet& set) {
  PROMISE(refers(set.material, model.joint_materials) && refers(set.within, model.solids));
  PROMISE(set.sides >= 3 && (!set.radius || *set.radius > 0) && finite(set.origin));
  PROMISE(set.random ? set.spacing == 0 && !set.count : set.spacing > 0);
  if (!set.random) return;
  const auto& random = *set.random;
  PROMISE(random.spacing.has_value() + random.p32.has_value() + random.p10.has_value() +
              random.count.has_value() ==
          1);
  PROMISE(random.spacing || random.radius || set.radius);
  PROMISE(!random.p10 || random.scanline[0] != random.scanline[1]);
  PROMISE(random.fisher_kappa > 0);
  check(random.radius);
  check(random.spacing);
}

void check(const Model& model, const Joint& joint) {
  PROMISE(refers(joint.material, model.joint_materials) && refers(joint.within, model.solids));
  PROMISE(joint.sides >= 3 && (!joint.radius || *joint.radius > 0));
  PROMISE(!joint.radius || joint.polygon.empty());
  PROMISE(finite(joint.plane.point) && (joint.polygon.empty() || joint.polygon.size() >= 3));
  if (const auto* normal = std::get_if<Vec3>(&joint.plane.orientation))
    PROMISE(finite(*normal) && *normal != Vec3{});
}

void check(const Model& model) {
  for (const auto& solid : model.solids) {
    std::visit(CheckShape{}, solid.shape);
    PROMISE(solid.continues.size() == face_names(solid.shape).size());
    PROMISE(refers(solid.material, model.materials));
    PROMISE(refers(solid.interface, model.joint_materials));
  }
  for (const auto& set : model.joint_sets) check(model, set);
  for (const auto& joint : model.joints) check(model, joint);
  for (const auto& mesh : model.joint_meshes) PROMISE(refers(mesh.within, model.solids));
  for (const auto& table : model.joint_tables) PROMISE(refers(table.within, model.solids));
  for (const auto& excavation : model.excavations) {
    std::visit(CheckShape{}, excavation.shape);
    PROMISE(excavation.stage >= 1);
  }
  for (const auto& merge : model.merges)
    if (const auto* in = std::get_if<Merge::InSolid>(&merge.region))
      PROMISE(in->solid != none && refers(in->solid, model.solids));
  PROMISE(model.cut.max_cells >= 1);
}

}  // namespace
}  // namespace rockfold

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rockfold;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    check(parse_model(text, "m.toml", {}, Purpose::check));
  } catch (const Error& error) {
    PROMISE(!error.diagnostics().empty());
    for (const auto& diagnostic : error.diagnostics()) {
      PROMISE(!diagnostic.message.empty());
      PROMISE(diagnostic.place.file == "m.toml");
    }
  }
  return 0;
}
