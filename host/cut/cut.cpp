#include "host/cut/cut.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "host/cut/adjacency.hpp"
#include "host/cut/ask_about_blocks.hpp"
#include "host/cut/block_forecast.hpp"
#include "host/cut/bodies/beams.hpp"
#include "host/cut/bodies/blocks.hpp"
#include "host/cut/bodies/connectivity.hpp"
#include "host/cut/bodies/intent_report.hpp"
#include "host/cut/bodies/width.hpp"
#include "host/cut/cells/near_boxes.hpp"
#include "host/cut/cells/subdivide.hpp"
#include "host/cut/planes/surfaces.hpp"
#include "host/cut/zones.hpp"
#include "host/parallel.hpp"
#include "host/refuse.hpp"
#include "src/base/sum.hpp"
#include "src/base/vector.hpp"
#include "src/model/openings.hpp"

namespace rockfold {

namespace {

// 0, n/2, n/4, 3n/4, …: parallel planes next to each other in the list halve what is left.
std::vector<Index> bisecting_order(Index n) {
  std::vector<Index> order;
  order.reserve(n);
  const auto bits = static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(n)));
  for (std::uint32_t i = 0; i < (1u << bits); ++i) {
    std::uint32_t reversed = 0;
    for (unsigned b = 0; b < bits; ++b) reversed |= (i >> b & 1u) << (bits - 1 - b);
    if (reversed < static_cast<std::uint32_t>(n)) order.push_back(static_cast<Index>(reversed));
  }
  return order;
}

// Through-going joints first, each plane once, in an order that balances the cutting and that the order in the model does
// not enter; then the finite ones.
std::vector<CuttingSurface> joint_surfaces(const Complex& complex) {
  std::vector<const JointPatch*> through, finite;
  for (const JointPatch& joint : complex.joints)
    (joint.patch.bounded() || joint.within != none ? finite : through).push_back(&joint);
  const auto by_instance = [](const JointPatch* a, const JointPatch* b) {
    return a->instance < b->instance;
  };
  std::stable_sort(through.begin(), through.end(), by_instance);
  std::stable_sort(finite.begin(), finite.end(), by_instance);
  std::set<Index> seen;
  std::erase_if(through, [&](const JointPatch* j) { return !seen.insert(j->patch.plane).second; });
  std::erase_if(finite, [&](const JointPatch* j) { return seen.count(j->patch.plane) != 0; });
  std::vector<CuttingSurface> surfaces;
  // A tenth of what counts as narrow (rule 7): harmless, and halves the cells of noisy networks.
  const Real least_width = 0.1 * complex.planes.width_tolerance();
  for (const auto* list : {&through, &finite})
    for (const Index i : bisecting_order(static_cast<Index>(list->size())))
      surfaces.push_back({&(*list)[i]->patch, (*list)[i]->within, least_width});
  return surfaces;
}

std::vector<CuttingSurface> facet_surfaces(const Complex& complex) {
  std::vector<CuttingSurface> surfaces;
  for (const Facet& facet : complex.facets) surfaces.push_back({&facet.patch, none, 0});
  return surfaces;
}

// More than that many beyond the limit are not even counted.
constexpr std::int64_t counted_beyond = 100'000;

// Everything inside the enclosing box, rock and void, cut by the boundaries of all shapes.
CellStore cut_by_shapes(CuttingInput& input, const Model& model) {
  Complex& complex = input.complex;
  auto surfaces = facet_surfaces(complex);
  Box space;
  for (const Vertex& v : input.start[0].vertices) space.add(v.x);
  // The faces of convex parts are few and meet at angles.
  std::vector<const Patch*> patches;
  for (const Facet& facet : complex.facets)
    if (complex.bodies[facet.body].inside.empty()) patches.push_back(&facet.patch);
  const AuxTree tree(complex.planes, patches, space);
  // The void is cut too, but only the rock's cells count; the limit here is for the memory.
  const std::int64_t most = std::max(model.cut.max_cells, CutSpec{}.max_cells);
  Progress silent;
  Subdivision cut;
  try {
    cut =
        subdivide({complex.planes, input.start, {0}, std::move(surfaces), tree, {}, most}, silent);
  } catch (const TooManyCells&) {
    refuse_cells(model, fmt::format("the shapes cut rock and void into more than {} convex parts; "
                                    "use simpler shapes or a larger cut.max_cells",
                                    most));
  }
  std::vector<const CellStore*> stores;
  std::vector<std::vector<Index>> all;
  for (const CellStore& part : cut.parts) {
    stores.push_back(&part);
    all.emplace_back(part.size());
    for (Index c = 0; c < part.size(); ++c) all.back()[c] = c;
  }
  return CellStore::join(stores, all);
}

struct Rock {
  CellStore cells;                    // with the void
  std::vector<Index> zone;            // [cells] none = void
  std::vector<Index> of_rock;         // cells that are rock
  std::vector<CellMeasure> measures;  // [of_rock]
  std::vector<Index> gaps;            // void cells so narrow that rock on their two sides may touch
  Real volume = 0;
};

Rock find_rock(CellStore cells, Complex& complex, const Model& model) {
  ZonedCells zoned = find_zones(complex, cells, model);
  complex.zones = std::move(zoned.zones);
  Rock rock;
  rock.cells = std::move(cells);
  rock.zone = std::move(zoned.cell_zone);
  std::vector<CellMeasure> all(rock.cells.size());
  parallel_for(rock.cells.size(), 256, [&](std::int64_t c) {
    all[c] = measure_cell(rock.cells[static_cast<Index>(c)], complex.planes);
  });
  Sum sum;
  for (Index c = 0; c < rock.cells.size(); ++c) {
    if (rock.zone[c] != none) {
      rock.of_rock.push_back(c);
      rock.measures.push_back(all[c]);
      sum += all[c].moments.volume;
    } else if (all[c].width < complex.planes.width_tolerance()) {
      rock.gaps.push_back(c);
    }
  }
  if (rock.of_rock.empty())
    refuse(model.solids.back().place, "solid", "the block operations leave no rock");
  rock.volume = sum.value();
  return rock;
}

// The cells that joints made of the rock, then those of the narrow voids. Returns how many are rock.
Index take_cells(const Subdivision& cut, const Rock& rock, Complex& complex,
                 std::vector<CellMeasure>& measures) {
  const std::size_t n = cut.parts.size();
  // What no joint has cut is measured already.
  std::vector<Index> parts_of(rock.cells.size(), 0), measured(rock.cells.size(), none);
  for (const auto& parents : cut.parents)
    for (const Index c : parents) ++parts_of[c];
  for (std::size_t i = 0; i < rock.of_rock.size(); ++i)
    if (parts_of[rock.of_rock[i]] == 1) measured[rock.of_rock[i]] = static_cast<Index>(i);
  std::vector<std::vector<CellMeasure>> of_part(n);
  std::vector<std::vector<Index>> chosen(2 * n);  // rock, then void
  const auto measure = [&](std::int64_t p) {
    const CellStore& part = cut.parts[p];
    for (Index c = 0; c < part.size(); ++c) {
      const Index parent = cut.parents[p][c], known = measured[parent];
      const bool is_rock = rock.zone[parent] != none;
      chosen[is_rock ? p : p + n].push_back(c);
      if (is_rock)
        of_part[p].push_back(known != none ? rock.measures[known]
                                           : measure_cell(part[c], complex.planes));
    }
  };
  parallel_for(static_cast<std::int64_t>(n), 1, measure, rock.of_rock.size() > 256 || n >= 256);
  std::vector<const CellStore*> stores;
  for (std::size_t p = 0; p < 2 * n; ++p) stores.push_back(&cut.parts[p % n]);
  for (std::size_t p = 0; p < n; ++p) {
    measures.insert(measures.end(), of_part[p].begin(), of_part[p].end());
    for (const Index c : chosen[p]) complex.cell_zone.push_back(rock.zone[cut.parents[p][c]]);
  }
  complex.cells = CellStore::join(stores, chosen);
  return static_cast<Index>(measures.size());
}

// Returns the measures of the cells of rock; narrow voids follow these.
std::vector<CellMeasure> cut_by_joints(const Rock& rock, const Model& model, Complex& complex,
                                       Progress& progress) {
  auto surfaces = joint_surfaces(complex);
  Box space;
  for (const Index c : rock.of_rock)
    for (const Vertex& v : rock.cells[c].vertices) space.add(v.x);
  std::vector<const Patch*> patches;
  for (const CuttingSurface& s : surfaces) patches.push_back(s.patch);
  const AuxTree tree(complex.planes, patches, space);
  const auto applies = [&](Index cell, Index within) {
    if (rock.zone[cell] == none) return true;
    const auto& solids = complex.zones[rock.zone[cell]].within;
    return std::binary_search(solids.begin(), solids.end(), within);
  };
  const std::int64_t most = model.cut.max_cells + counted_beyond;
  std::vector<Index> which = rock.of_rock;
  which.insert(which.end(), rock.gaps.begin(), rock.gaps.end());
  Subdivision cut;
  try {
    cut = subdivide(
        {complex.planes, rock.cells, std::move(which), std::move(surfaces), tree, applies, most},
        progress);
  } catch (const TooManyCells&) {
    refuse_cell_count(model, fmt::format("more than {}", most));
  }
  std::vector<CellMeasure> measures;
  const Index cells = take_cells(cut, rock, complex, measures);
  if (cells > model.cut.max_cells) refuse_cell_count(model, fmt::format("{}", cells));
  return measures;
}

// What can be told before joints cut the rock, which may take long.
void refuse_hopeless(const CuttingInput& input, const Rock& rock, const Complex& complex,
                     const Model& model) {
  const CellEstimate cells =
      estimate_cells(input.plane_sets, rock.volume, complex.planes.model_size());
  constexpr Real above_rounding = 1 + 1e-6;
  if (cells.least > above_rounding * static_cast<Real>(model.cut.max_cells))
    refuse_cell_count(model, about_cells(cells.about));
  const auto by_points = [](const Merge& merge) {
    return std::holds_alternative<Merge::Blocks>(merge.region);
  };
  if (std::any_of(model.merges.begin(), model.merges.end(), by_points))
    check_merge_points(CellStore::join({&rock.cells}, {rock.of_rock}), complex.planes, model);
}

// The regions of the model's joints: all rock, then the solids that joints stay within; their numbers in `of_solid`.
std::vector<ForecastRegion> forecast_regions(const Rock& rock, const Complex& complex,
                                             std::map<Index, std::size_t>& of_solid) {
  for (const JointPatch& joint : complex.joints) of_solid.try_emplace(joint.within, 0);
  std::size_t count = 0;
  for (auto& [solid, number] : of_solid) number = count++;
  std::vector<ForecastRegion> regions(count);
  for (std::size_t i = 0; i < rock.of_rock.size(); ++i) {
    const Index cell = rock.of_rock[i];
    Box box;
    for (const Vertex& v : rock.cells[cell].vertices) box.add(v.x);
    const auto& within = complex.zones[rock.zone[cell]].within;
    for (const auto& [solid, number] : of_solid) {
      if (solid != none && !std::binary_search(within.begin(), within.end(), solid)) continue;
      regions[number].box.add(box);
      regions[number].volume += rock.measures[i].moments.volume;
    }
  }
  return regions;
}

// Planes and discs; other polygons cut off little.
Real forecast(const Rock& rock, const Complex& complex) {
  std::map<Index, std::size_t> of_solid;
  const auto regions = forecast_regions(rock, complex, of_solid);
  std::vector<ForecastJoint> joints;
  for (const JointPatch& joint : complex.joints) {
    const std::size_t region = of_solid.at(joint.within);
    if (regions[region].volume > 0)
      joints.push_back({complex.planes.normal(joint.patch.plane),
                        complex.planes.offset(joint.patch.plane), joint.patch.middle,
                        joint.patch.bounded() ? joint.patch.inner : Box::infinity, region});
  }
  return forecast_blocks(joints, regions);
}

// The rock before joints cut it.
struct Uncut {
  std::shared_ptr<Complex> complex;
  Rock rock;
  GivenIntent intent;
};

// `most_blocks` as of cut_blocks().
Uncut shape_rock(const Model& model, Real most_blocks) {
  CuttingInput input = make_surfaces(model);
  Uncut uncut;
  uncut.intent = std::move(input.intent);
  CellStore cells = cut_by_shapes(input, model);
  uncut.complex = std::make_shared<Complex>(std::move(input.complex));
  uncut.rock = find_rock(std::move(cells), *uncut.complex, model);
  refuse_hopeless(input, uncut.rock, *uncut.complex, model);
  if (std::isfinite(most_blocks))
    if (const Real blocks = forecast(uncut.rock, *uncut.complex); blocks > most_blocks)
      ask_about_blocks(model, *uncut.complex, blocks);
  return uncut;
}

// On its boundary too, to the tolerance.
bool holds(const CellView& cell, const Vec3& point, const PlaneTable& planes) {
  const Vec3 x = point - planes.centre();
  return std::all_of(cell.faces.begin(), cell.faces.end(), [&](const auto& face) {
    const Index plane = plane_of(face.inside);
    const Real above = dot(planes.normal(plane), x) - planes.offset(plane);
    return (is_above(face.inside) ? above : -above) >= -planes.width_tolerance();
  });
}

CutTotals totals_of(const Complex& complex, const Rock& rock) {
  CutTotals totals;
  totals.cells = complex.cells.size();
  totals.solid_volume = rock.volume;
  Sum joint_area, dangling_joint_area;
  for (const Fragment& f : complex.fragments) {
    if (f.joint == none || complex.origins[f.joint].kind != FaceOrigin::Kind::joint) continue;
    joint_area += f.area;
    if (f.dead_end) dangling_joint_area += f.area;
  }
  totals.joint_area = joint_area.value();
  totals.dangling_joint_area = dangling_joint_area.value();
  return totals;
}

}  // namespace

UncutRock check_cutting(const Model& model, const std::vector<Vec3>& points, Real most_blocks) {
  const Uncut uncut = shape_rock(model, most_blocks);
  const Rock& rock = uncut.rock;
  const PlaneTable& planes = uncut.complex->planes;
  UncutRock found;
  Sum volume;
  std::vector<Box> of_cell(rock.of_rock.size()), of_point(points.size());
  std::vector<UncutRock::At> at(rock.of_rock.size());
  for (std::size_t i = 0; i < rock.of_rock.size(); ++i) {
    const Index cell = rock.of_rock[i];
    for (const Vertex& v : rock.cells[cell].vertices) of_cell[i].add(v.x);
    const bool stays = is_there_at_first(model, uncut.complex->zones[rock.zone[cell]].stage);
    at[i] = stays ? UncutRock::At::stays : UncutRock::At::excavated;
    if (stays) volume += rock.measures[i].moments.volume;
  }
  found.volume = volume.value();
  for (std::size_t p = 0; p < points.size(); ++p) of_point[p].add(points[p] - planes.centre());
  const auto near = near_boxes(of_point, of_cell, planes.width_tolerance());
  for (std::size_t p = 0; p < points.size(); ++p) {
    UncutRock::At& most = found.of_point.emplace_back(UncutRock::At::outside);
    for (const Index i : near[p])
      if (most < at[i] && holds(rock.cells[rock.of_rock[i]], points[p], planes)) most = at[i];
  }
  return found;
}

StageKeys keys_of_cutting() {
  return {"blocks",
          {"title", "gravity", "material.name", "material.density", "joint_material.name", "solid",
           "joint_set", "joint", "joint_mesh.name", "joint_mesh.file", "joint_mesh.material",
           "joint_mesh.within", "joint_table", "merge", "excavation", "cut", "contact.tolerance"}};
}

Cutting cut_blocks(const Model& model, Progress& progress, Real most_blocks) {
  Cutting cutting;
  Uncut uncut = shape_rock(model, most_blocks);
  const auto complex = std::move(uncut.complex);
  const Rock rock = std::move(uncut.rock);
  const std::vector<CellMeasure> measures = cut_by_joints(rock, model, *complex, progress);
  const auto rock_count = static_cast<Index>(measures.size());
  for (const CellMeasure& m : measures) {
    complex->moments.push_back(m.moments);
    complex->is_sliver.push_back(m.width < complex->planes.width_tolerance() ? 1 : 0);
  }
  const std::vector<Fragment> gaps = find_adjacency(*complex, rock_count);
  complex->beams = find_beams(*complex, rock_count, gaps);
  complex->cells.truncate(rock_count);
  const std::vector<Index> doubtful_glue = mark_narrow_glue(*complex);
  std::optional<SpeckReport> specks = find_blocks(*complex, model);
  cutting.totals = totals_of(*complex, rock);
  cutting.totals.specks = std::move(specks);
  cutting.totals.intent = intent_report(*complex, uncut.intent, measures, doubtful_glue);
  cutting.complex = complex;
  return cutting;
}

}  // namespace rockfold
