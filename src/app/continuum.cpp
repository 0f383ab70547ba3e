#include "src/app/continuum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "host/shapes/extents.hpp"
#include "src/arrays/polygon_mesh.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

std::array<Real, 3> sorted_widths(const Extent& box) {
  const Vec3 width = box.max - box.min;
  std::array<Real, 3> sorted{width[0], width[1], width[2]};
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

void intersect(Extent& box, const Extent& other) {
  for (int d = 0; d < 3; ++d) {
    box.min[d] = std::max(box.min[d], other.min[d]);
    box.max[d] = std::min(box.max[d], other.max[d]);
  }
}

void unite(Extent& box, const Extent& other) {
  for (int d = 0; d < 3; ++d) {
    box.min[d] = std::min(box.min[d], other.min[d]);
    box.max[d] = std::max(box.max[d], other.max[d]);
  }
}

/// Half the least width of an opening whose box is `box`.
Real half_width(const Shape& shape, const Extent& box) {
  const Real of_box = sorted_widths(box)[0] / 2;
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape))
    return std::min(cylinder->radius, norm(cylinder->axis[1] - cylinder->axis[0]) / 2);
  const auto* tunnel = std::get_if<TunnelShape>(&shape);
  if (!tunnel) return of_box;
  std::vector<Vec3> section;
  for (const auto& point : tunnel->section) section.push_back({point[0], point[1], 0});
  return sorted_widths(bounding_box(section))[1] / 2;  // [0] is the section's thickness, none
}

struct Opening {
  const Shape* shape;
  Extent box;
};

/// The rock's box, and the openings within it.
struct Layout {
  Extent rock{};
  std::vector<Opening> openings;
};

Layout layout_of(const Model& model) {
  Layout layout;
  const auto extents = named_extents(model);  // solids, then excavations, in their order
  bool first = true;
  for (std::size_t i = 0; i < model.solids.size(); ++i)
    if (model.solids[i].add) {
      if (!std::exchange(first, false))
        unite(layout.rock, extents[i].box);
      else
        layout.rock = extents[i].box;
    }
  const auto add = [&](const Shape& shape, const NamedExtent& extent) {
    Opening opening{&shape, layout.rock};
    if (extent.bounded) intersect(opening.box, extent.box);
    if (sorted_widths(opening.box)[0] > 0) layout.openings.push_back(opening);
  };
  for (std::size_t i = 0; i < model.solids.size(); ++i)
    if (!model.solids[i].add) add(model.solids[i].shape, extents[i]);
  for (std::size_t i = 0; i < model.excavations.size(); ++i)
    add(model.excavations[i].shape, extents[model.solids.size() + i]);
  return layout;
}

Openings measure(const Layout& layout) {
  Openings all{layout.openings.front().box, std::numeric_limits<Real>::infinity(), 0};
  for (const Opening& opening : layout.openings) {
    unite(all.box, opening.box);
    const Real half = half_width(*opening.shape, opening.box);
    all.radius = std::min(all.radius, half);
    all.size = std::max(all.size, half);
  }
  if (layout.openings.size() > 1) {
    Real together = sorted_widths(all.box)[0] / 2;
    all.size = std::max(all.size, together);
  }
  return all;
}

/// Takes away what of the rock lies beyond `kept`: a box at each side where there is any.
void cut_off(Model& model, const Extent& rock, const Extent& kept) {
  const Vec3 margin = 0.1 * (rock.max - rock.min);
  for (int d = 0; d < 3; ++d)
    for (const bool high : {false, true}) {
      if (high ? kept.max[d] >= rock.max[d] : kept.min[d] <= rock.min[d]) continue;
      BoxShape box{rock.min - margin, rock.max + margin};
      (high ? box.min : box.max)[d] = high ? kept.max[d] : kept.min[d];
      Solid solid;
      solid.name = "beyond";
      solid.add = false;
      solid.shape = box;
      solid.continues.assign(6, false);
      model.solids.push_back(std::move(solid));
    }
}

/// A lattice whose planes lie in the sides of the box, near as fine as `spacing`; coarser where that makes too many cells.
CoverSpec lattice_in(const Extent& box, Real spacing, Index most_cells) {
  CoverSpec cover;
  cover.order = 0;
  cover.joints = JointTreatment::welded;
  cover.origin = box.min;
  const Vec3 width = box.max - box.min;
  const Real cells = width[0] * width[1] * width[2] / (spacing * spacing * spacing);
  if (cells > static_cast<Real>(most_cells))
    spacing *= std::cbrt(cells / static_cast<Real>(most_cells));
  for (int d = 0; d < 3; ++d)  // spacings are listed z, y, x
    cover.spacing[2 - d] = width[d] / std::ceil(width[d] / spacing * (1 - 1e-9));
  return cover;
}

/// A face that the rock is held by.
struct OuterFace {
  Extent box{};
  Vec3 normal{}, point{};
  int axis = -1;  ///< of all its normals; 3: they are others, or differ

  void add(const BlockArrays& blocks, Index face) {
    normal = blocks.face_normal[face];
    int along = 3;
    for (int d = 0; d < 3; ++d)
      if (std::abs(normal[d]) > 1 - 1e-12) along = d;
    for (const Index v : face_loop(blocks, blocks.loop_begin[face])) {
      point = blocks.vertex[v];
      if (axis == -1) box = {point, point};
      unite(box, {point, point});
      axis = axis == -1 || axis == along ? along : 3;
    }
  }
};

/// Pa, of the first solid.
Real shear_modulus_of(const Model& model) {
  const auto first = std::find_if(model.solids.begin(), model.solids.end(),
                                  [](const Solid& solid) { return solid.add; });
  const Material& rock = model.materials[first->material];
  return rock.young_modulus / (2 * (1 + rock.poisson_ratio));
}

}  // namespace

std::optional<Openings> measure_openings(const Model& model) {
  const Layout layout = layout_of(model);
  if (layout.openings.empty()) return std::nullopt;
  return measure(layout);
}

Real distance(const Extent& a, const Extent& b) {
  Vec3 gap{};
  for (int d = 0; d < 3; ++d) gap[d] = std::max({0.0, a.min[d] - b.max[d], b.min[d] - a.max[d]});
  return norm(gap);
}

bool Continuum::is_made_free(const FaceOrigin& origin) const {
  if (origin.kind == FaceOrigin::Kind::excavation) return true;
  return origin.kind == FaceOrigin::Kind::solid_face && origin.solid < original_solids &&
         !model.solids[static_cast<std::size_t>(origin.solid)].add;
}

std::optional<Continuum> continuum_after(const Model& model, Index stage,
                                         const ContinuumRule& rule) {
  Continuum found;
  Model& rock = found.model;
  rock = model;
  rock.joints.clear();
  rock.joint_sets.clear();
  rock.joint_meshes.clear();
  rock.joint_tables.clear();
  rock.merges.clear();
  rock.fixed.clear();
  rock.tractions.clear();
  rock.point_loads.clear();
  rock.analysis.reset();  // whose steps may excavate later
  for (Solid& solid : rock.solids) solid.interface = none;
  std::erase_if(rock.excavations, [&](const Excavation& e) { return e.stage > stage; });
  found.original_solids = static_cast<Index>(rock.solids.size());

  const Layout layout = layout_of(rock);
  if (layout.openings.empty()) return std::nullopt;
  found.openings = measure(layout);
  const Real reach = rule.reach * found.openings.size;
  Extent kept = found.openings.box;
  kept.min -= Vec3{reach, reach, reach};
  kept.max += Vec3{reach, reach, reach};
  cut_off(rock, layout.rock, kept);
  intersect(kept, layout.rock);
  const Real wanted = found.openings.radius / rule.cells_a_radius;
  rock.cover = lattice_in(kept, wanted, rule.most_cells);
  found.spacing =
      std::max({rock.cover->spacing[0], rock.cover->spacing[1], rock.cover->spacing[2]});
  found.coarser = found.spacing > 1.01 * wanted;
  return found;
}

void hold_continuum(Continuum& continuum, const BlockArrays& blocks) {
  std::map<std::pair<Index, Index>, OuterFace> faces;  // by solid and face
  for (std::size_t f = 0; f < blocks.face_normal.size(); ++f) {
    const FaceOrigin& origin = blocks.origins[blocks.face_origin[f]];
    if (origin.kind != FaceOrigin::Kind::solid_face) continue;
    if (origin.continues || origin.solid >= continuum.original_solids)
      faces[{origin.solid, origin.solid_face}].add(blocks, static_cast<Index>(f));
  }
  const Extent& opened = continuum.openings.box;
  const Vec3 centre = 0.5 * (opened.min + opened.max);
  const Real shear_modulus = shear_modulus_of(continuum.model);
  std::array<bool, 3> held{};
  for (const auto& [id, face] : faces) {
    Fixed fixed;
    fixed.where = FaceRegion{id.first, {id.second}, false};
    fixed.method = FixMethod::penalty;
    if (distance(face.box, opened) > 0)
      fixed.stiffness = 2 * shear_modulus / std::abs(dot(face.normal, face.point - centre));
    else if (face.axis < 3)
      for (int d = 0; d < 3; ++d) fixed.components[d] = d == face.axis;
    for (int d = 0; d < 3; ++d) held[d] = held[d] || fixed.components[d];
    continuum.model.fixed.push_back(fixed);
  }
  if (held[0] && held[1] && held[2]) return;
  for (Fixed& fixed : continuum.model.fixed) fixed.components = {true, true, true};
}

}  // namespace rockfold
