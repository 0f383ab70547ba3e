#include "host/cut/cut.hpp"

#include <algorithm>
#include <bit>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "host/cut/adjacency.hpp"
#include "host/cut/blocks.hpp"
#include "host/cut/subdivide.hpp"
#include "host/cut/surfaces.hpp"
#include "host/cut/zones.hpp"
#include "host/parallel.hpp"
#include "host/refuse.hpp"
#include "src/base/sum.hpp"

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
  for (const auto* list : {&through, &finite})
    for (const Index i : bisecting_order(static_cast<Index>(list->size())))
      surfaces.push_back({&(*list)[i]->patch, (*list)[i]->within});
  return surfaces;
}

std::vector<CuttingSurface> facet_surfaces(const Complex& complex) {
  std::vector<CuttingSurface> surfaces;
  for (const Facet& facet : complex.facets) surfaces.push_back({&facet.patch, none});
  return surfaces;
}

AuxTree make_tree(PlaneTable& planes, const std::vector<CuttingSurface>& surfaces,
                  const Box& space) {
  std::vector<const Patch*> patches;
  for (const CuttingSurface& s : surfaces) patches.push_back(s.patch);
  return {planes, patches, space};
}

// More than that many beyond the limit are not even counted.
constexpr std::int64_t counted_beyond = 100'000;

// Everything inside the enclosing box, rock and void, cut by the boundaries of all shapes.
CellStore cut_by_shapes(CuttingInput& input, const Model& model, IntentCount& intent) {
  Complex& complex = input.complex;
  auto surfaces = facet_surfaces(complex);
  Box space;
  for (const Vertex& v : input.start[0].vertices) space.add(v.x);
  const AuxTree tree = make_tree(complex.planes, surfaces, space);
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
  intent.add(cut.intent);
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
  CellStore cells;                   // with the void
  std::vector<Index> zone;           // [cells] none = void
  std::vector<Index> of_rock;        // cells that are rock
  std::vector<CellMoments> moments;  // [of_rock]
  Real volume = 0;
};

Rock find_rock(CellStore cells, Complex& complex, const Model& model) {
  ZonedCells zoned = find_zones(complex, cells, model);
  complex.zones = std::move(zoned.zones);
  Rock rock{std::move(cells), std::move(zoned.cell_zone), {}, {}, 0};
  for (Index c = 0; c < rock.cells.size(); ++c)
    if (rock.zone[c] != none) rock.of_rock.push_back(c);
  if (rock.of_rock.empty())
    refuse(model.solids.back().place, "solid", "the block operations leave no rock");
  rock.moments.resize(rock.of_rock.size());
  parallel_for(static_cast<std::int64_t>(rock.moments.size()), 256, [&](std::int64_t i) {
    rock.moments[i] = cell_moments(rock.cells[rock.of_rock[i]], complex.planes);
  });
  Sum sum;
  for (const CellMoments& m : rock.moments) sum += m.volume;
  rock.volume = sum.value();
  return rock;
}

// Takes over the cells with their moments. A cell without positive volume is a trace of planes that nearly meet in one
// point, within the tolerance; it is left out and counted as a near decision.
Index take_cells(const Subdivision& cut, const Rock& rock, Complex& complex) {
  const std::size_t n = cut.parts.size();
  std::vector<std::vector<CellMoments>> moments(n);
  std::vector<std::vector<Index>> kept(n);
  // What no joint has cut is measured already.
  std::vector<Index> parts_of(rock.cells.size(), 0), measured(rock.cells.size(), none);
  for (const auto& parents : cut.parents)
    for (const Index c : parents) ++parts_of[c];
  for (std::size_t i = 0; i < rock.of_rock.size(); ++i)
    if (parts_of[rock.of_rock[i]] == 1) measured[rock.of_rock[i]] = static_cast<Index>(i);
  const auto measure = [&](std::int64_t p) {
    const CellStore& part = cut.parts[p];
    for (Index c = 0; c < part.size(); ++c) {
      const Index known = measured[cut.parents[p][c]];
      const CellMoments m =
          known != none ? rock.moments[known] : cell_moments(part[c], complex.planes);
      if (!(m.volume > 0)) continue;
      moments[p].push_back(m);
      kept[p].push_back(c);
    }
  };
  const bool many = rock.of_rock.size() > 256 || n >= 256;
  parallel_for(static_cast<std::int64_t>(n), 1, measure, many);
  std::vector<const CellStore*> stores;
  Index dropped = 0;
  for (std::size_t p = 0; p < n; ++p) {
    stores.push_back(&cut.parts[p]);
    dropped += cut.parts[p].size() - static_cast<Index>(kept[p].size());
    complex.moments.insert(complex.moments.end(), moments[p].begin(), moments[p].end());
    for (const Index c : kept[p]) complex.cell_zone.push_back(rock.zone[cut.parents[p][c]]);
  }
  complex.cells = CellStore::join(stores, kept);
  return dropped;
}

IntentCount cut_by_joints(const Rock& rock, const Model& model, Complex& complex,
                          Progress& progress) {
  auto surfaces = joint_surfaces(complex);
  Box space;
  for (const Index c : rock.of_rock)
    for (const Vertex& v : rock.cells[c].vertices) space.add(v.x);
  const AuxTree tree = make_tree(complex.planes, surfaces, space);
  const auto applies = [&](Index cell, Index within) {
    const auto& solids = complex.zones[rock.zone[cell]].within;
    return std::binary_search(solids.begin(), solids.end(), within);
  };
  const std::int64_t most = model.cut.max_cells + counted_beyond;
  Subdivision cut;
  try {
    cut = subdivide(
        {complex.planes, rock.cells, rock.of_rock, std::move(surfaces), tree, applies, most},
        progress);
  } catch (const TooManyCells&) {
    refuse_cell_count(model, fmt::format("more than {}", most));
  }
  cut.intent.near_decisions += take_cells(cut, rock, complex);
  if (complex.cells.size() > model.cut.max_cells)
    refuse_cell_count(model, fmt::format("{}", complex.cells.size()));
  return std::move(cut.intent);
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

// The rock before joints cut it.
struct Uncut {
  std::shared_ptr<Complex> complex;
  Rock rock;
  IntentCount intent;
  Index planes_identified = 0;
};

Uncut shape_rock(const Model& model) {
  CuttingInput input = make_surfaces(model);
  Uncut uncut;
  uncut.intent = std::move(input.intent);
  uncut.planes_identified = input.planes_identified;
  CellStore cells = cut_by_shapes(input, model, uncut.intent);
  uncut.complex = std::make_shared<Complex>(std::move(input.complex));
  uncut.rock = find_rock(std::move(cells), *uncut.complex, model);
  refuse_hopeless(input, uncut.rock, *uncut.complex, model);
  return uncut;
}

IntentReport intent_report(const Complex& complex, const IntentCount& count,
                           Index planes_identified) {
  IntentReport report;
  report.planes_identified = planes_identified;
  report.vertices_identified = count.vertices_identified;
  report.near_decisions = count.near_decisions;
  const std::set<Index> near(count.near_planes.begin(), count.near_planes.end());
  std::set<std::string> names;
  const auto name_all = [&](const auto& things) {
    for (const auto& thing : things) {
      if (thing.origin == none) continue;
      bool is_near = near.count(thing.patch.plane) != 0;
      for (const HalfSpaceId edge : thing.patch.edges)
        is_near = is_near || near.count(plane_of(edge)) != 0;
      if (is_near) names.insert(complex.origins[thing.origin].name);
    }
  };
  if (!near.empty()) name_all(complex.joints), name_all(complex.facets);
  report.near_planes.assign(names.begin(), names.end());
  if (report.near_planes.size() > 20) report.near_planes.resize(20);
  return report;
}

CutTotals totals_of(const Complex& complex, const Rock& rock) {
  CutTotals totals;
  totals.cells = complex.cells.size();
  totals.solid_volume = rock.volume;
  Sum joint_area, dangling_joint_area;
  for (const Fragment& f : complex.fragments) {
    if (f.joint == none || complex.origins[f.joint].kind != FaceOrigin::Kind::joint) continue;
    joint_area += f.area;
    if (complex.cell_block[f.cell[0]] == complex.cell_block[f.cell[1]])
      dangling_joint_area += f.area;
  }
  totals.joint_area = joint_area.value();
  totals.dangling_joint_area = dangling_joint_area.value();
  return totals;
}

}  // namespace

Real check_cutting(const Model& model) {
  const Uncut uncut = shape_rock(model);
  const Rock& rock = uncut.rock;
  Sum volume;
  for (std::size_t i = 0; i < rock.of_rock.size(); ++i)
    if (uncut.complex->zones[rock.zone[rock.of_rock[i]]].stage == 0)
      volume += rock.moments[i].volume;
  return volume.value();
}

Cutting cut_blocks(const Model& model, Progress& progress) {
  Cutting cutting;
  Uncut uncut = shape_rock(model);
  const auto complex = std::move(uncut.complex);
  IntentCount intent = std::move(uncut.intent);
  {
    const Rock rock = std::move(uncut.rock);
    intent.add(cut_by_joints(rock, model, *complex, progress));
    intent.add(find_adjacency(*complex));
    find_blocks(*complex, model);
    cutting.totals = totals_of(*complex, rock);
  }
  cutting.totals.intent = intent_report(*complex, intent, uncut.planes_identified);
  cutting.complex = complex;
  return cutting;
}

}  // namespace rockfold
