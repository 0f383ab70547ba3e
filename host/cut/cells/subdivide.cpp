#include "host/cut/cells/subdivide.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numeric>

#include "host/parallel.hpp"
#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Independent subtrees; enough to keep any likely number of threads busy, and the same for all of them.
constexpr std::size_t subtree_count = 512;

using SurfaceList = std::vector<Index>;

// Some of the given cells, or a part of one of them, with the surfaces that may still meet it.
struct Task {
  std::vector<Index> group;
  ConvexCell cell;  // if the group is empty
  Index parent = none;
  Index node = AuxTree::root;
  SurfaceList surfaces;
};

struct Extent {
  Box box;
  BoundingBall ball;
};
Extent extent_of(const CellView& cell) {
  Extent e;
  for (const Vertex& v : cell.vertices) e.box.add(v.x);
  e.ball.centre = 0.5 * (e.box.low + e.box.high);
  Real squared = 0;
  for (const Vertex& v : cell.vertices) {
    const Vec3 r = v.x - e.ball.centre;
    squared = std::max(squared, dot(r, r));
  }
  e.ball.radius = std::sqrt(squared);
  return e;
}

ConvexCell copy_of(const CellView& view) {
  ConvexCell cell;
  cell.vertices.assign(view.vertices.begin(), view.vertices.end());
  cell.faces.assign(view.faces.begin(), view.faces.end());
  cell.corners.assign(view.corners.begin(), view.corners.end());
  return cell;
}

// Cuts cells by surfaces, with buffers that live as long as it does.
class Cutter {
 public:
  explicit Cutter(const CuttingJob& job)
      : job_(job), planes_(job.planes), splitter_(job.planes), clipper_(job.planes) {}

  /// Cuts a cell once: by the plane of its node of the tree, or by the first surface that cuts it. False if none does.
  /// The two halves share `rest`, from which surfaces found not to meet the cell are left out.
  bool cut_once(const CellView& cell, Index& node, const SurfaceList& list, SurfaceList& rest,
                Index (&child_node)[2], ConvexCell& below, ConvexCell& above) {
    const Extent extent = extent_of(cell);
    while (job_.tree[node].plane != none) {
      const AuxTree::Node& at = job_.tree[node];
      const CellSide side = splitter_.classify(cell, at.plane);
      if (side == CellSide::split) {
        splitter_.split(cell, at.plane, &below, &above);
        child_node[0] = at.child[0], child_node[1] = at.child[1];
        keep_near(cell, extent, list, 0, rest);
        return true;
      }
      node = at.child[side == CellSide::above ? 1 : 0];
    }
    put_off_.clear();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Patch& patch = *job_.surfaces[list[i]].patch;
      if (!may_meet(extent, patch)) continue;
      if (splitter_.classify(cell, patch.plane) != CellSide::split) continue;
      const Cut cut = how_cuts(cell, job_.surfaces[list[i]]);
      if (cut == Cut::narrow) put_off_.push_back(list[i]);
      if (cut != Cut::wide) continue;
      splitter_.split(cell, patch.plane, &below, &above);
      child_node[0] = child_node[1] = node;
      keep_near(cell, extent, list, i + 1, rest);
      rest.insert(rest.end(), put_off_.begin(), put_off_.end());
      return true;
    }
    return false;
  }

  /// All cells of a task.
  void run(Task& task, CellStore& out, std::vector<Index>& parents,
           std::atomic<std::int64_t>& made) {
    if (task.group.empty()) {
      descend(0, task.cell, task.node, task.surfaces, task.parent, out, parents, made);
    } else if (task.group.size() == 1) {
      const Index c = task.group.front();
      const SurfaceList mine = applying(c, task.surfaces);
      descend(0, job_.cells[c], task.node, mine, c, out, parents, made);
    } else {
      Task halves[2];
      divide(task, halves);
      for (Task& half : halves) run(half, out, parents, made);
    }
  }

  /// Two groups of nearby cells, each with the surfaces near it.
  void divide(Task& task, Task (&halves)[2]) const {
    std::vector<Box> boxes;
    Box centres;
    for (const Index c : task.group) {
      Box box;
      for (const Vertex& v : job_.cells[c].vertices) box.add(v.x);
      boxes.push_back(box);
      centres.add(box.low + box.high);
    }
    int axis = 0;
    for (int d = 1; d < 3; ++d)
      if (centres.high[d] - centres.low[d] > centres.high[axis] - centres.low[axis]) axis = d;
    std::vector<std::size_t> order(task.group.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::nth_element(order.begin(), middle, order.end(), [&](std::size_t a, std::size_t b) {
      const Real x = boxes[a].low[axis] + boxes[a].high[axis],
                 y = boxes[b].low[axis] + boxes[b].high[axis];
      return x != y ? x < y : a < b;
    });
    for (int h = 0; h < 2; ++h) {
      Box box;
      for (auto it = h == 0 ? order.begin() : middle; it != (h == 0 ? middle : order.end()); ++it) {
        halves[h].group.push_back(task.group[*it]);
        box.add(boxes[*it]);
      }
      for (const Index s : task.surfaces)
        if (job_.surfaces[s].patch->box.meets(box, slack())) halves[h].surfaces.push_back(s);
    }
    task = {};
  }

  SurfaceList applying(Index cell, const SurfaceList& list) const {
    SurfaceList mine;
    for (const Index s : list)
      if (job_.surfaces[s].within == none || job_.applies(cell, job_.surfaces[s].within))
        mine.push_back(s);
    return mine;
  }

 private:
  struct Level {
    ConvexCell below, above;
    SurfaceList rest;
  };

  // m, far above what positions and boxes are off by.
  Real slack() const { return planes_.width_tolerance(); }

  bool may_meet(const Extent& extent, const Patch& patch) const {
    const Vec3& n = planes_.normal(patch.plane);
    const Real distance = dot(n, extent.ball.centre) - planes_.offset(patch.plane);
    return std::abs(distance) <= extent.ball.radius + slack() &&
           (!patch.bounded() ||
            (patch.box.meets(extent.box, slack()) && circles_meet(extent.ball, distance, patch)));
  }

  // The ball's circle in the plane, so far from its centre, and the one around the patch.
  bool circles_meet(const BoundingBall& ball, Real distance, const Patch& patch) const {
    const Vec3 r = ball.centre - patch.middle;
    const Real reach = ball.radius + slack(), from_axis2 = dot(r, r) - distance * distance;
    const Real apart = std::sqrt(reach * reach - distance * distance) + patch.outer + slack();
    return from_axis2 <= apart * apart;
  }

  // A ball tells little of a slab between parallel planes.
  bool may_cross(const CellView& cell, Index plane) const {
    bool below = false, above = false;
    for (const Vertex& v : cell.vertices) {
      const Real d = planes_.distance(v, plane);
      below = below || d <= slack();
      above = above || d >= -slack();
      if (below && above) return true;
    }
    return false;
  }

  void keep_near(const CellView& cell, const Extent& extent, const SurfaceList& list,
                 std::size_t from, SurfaceList& rest) const {
    rest.clear();
    for (std::size_t i = from; i < list.size(); ++i) {
      const Patch& patch = *job_.surfaces[list[i]].patch;
      if (may_meet(extent, patch) && may_cross(cell, patch.plane)) rest.push_back(list[i]);
    }
  }

  // `narrow`: not (rule 7), but what others leave of the cell may be cut.
  enum class Cut { none, narrow, wide };

  Cut how_cuts(const CellView& cell, const CuttingSurface& surface) {
    const Patch& patch = *surface.patch;
    if (!patch.bounded()) return Cut::wide;
    splitter_.section(cell, patch.plane, section_);
    const Vec3 centre = middle_of(section_);
    if (holds_widely(patch, centre)) return Cut::wide;
    if (lies_beyond_an_edge(patch, centre)) return Cut::none;
    const Polygon common = clipper_.intersection(section_, patch.edges);
    if (common.empty()) return Cut::none;
    if (surface.least_width == 0 || width_of(common) >= surface.least_width) return Cut::wide;
    // Where the cell itself is as narrow, as a wedge of a folded joint is near its edge, nothing wide is left beside the polygon:
    // without the cut the cell would join what it touches on the two sides.
    const Real beside = planes_.width_tolerance() + surface.least_width;
    return width_of(section_) < beside ? Cut::wide : Cut::narrow;
  }

  Real width_of(const Polygon& polygon) {
    corners_.clear();
    for (const Vertex& v : polygon.corner) corners_.push_back(v.x);
    return width_in_plane(corners_, planes_.normal(polygon.plane));
  }

  static Vec3 middle_of(const Polygon& polygon) {
    Vec3 middle{};
    for (const Vertex& v : polygon.corner) middle += v.x;
    return (1 / static_cast<Real>(polygon.corner.size())) * middle;
  }

  // Whether a circle about the section's middle, some tolerances wide, lies inside both: then what they share is no narrower.
  bool holds_widely(const Patch& patch, const Vec3& centre) const {
    const Real enough = 2 * slack();
    if (norm(centre - patch.middle) > patch.inner - enough) return false;
    const Vec3& n = planes_.normal(patch.plane);
    const std::size_t count = section_.corner.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3& a = section_.corner[k].x;
      const Vec3 along = section_.corner[k + 1 < count ? k + 1 : 0].x - a;
      const Vec3 across = cross(n, along);
      const Real inside = dot(across, centre - a);
      if (!(inside > 0 && inside * inside > enough * enough * dot(along, along))) return false;
    }
    return true;
  }

  // Exactly, by the edge that the section's middle is farthest beyond.
  bool lies_beyond_an_edge(const Patch& patch, const Vec3& centre) const {
    HalfSpaceId farthest = none;
    Real most = 0;
    for (const HalfSpaceId h : patch.edges) {
      const Real above = dot(planes_.normal(plane_of(h)), centre) - planes_.offset(plane_of(h));
      const Real beyond = is_above(h) ? -above : above;
      if (beyond > most) most = beyond, farthest = h;
    }
    if (farthest == none) return false;
    const int inside = is_above(farthest) ? 1 : -1;
    return std::none_of(section_.corner.begin(), section_.corner.end(), [&](const Vertex& v) {
      return planes_.side(v, plane_of(farthest)) == inside;
    });
  }

  void descend(std::size_t depth, const CellView& cell, Index node, const SurfaceList& list,
               Index parent, CellStore& out, std::vector<Index>& parents,
               std::atomic<std::int64_t>& made) {
    if (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
    Level& level = *levels_[depth];
    Index child_node[2];
    if (!cut_once(cell, node, list, level.rest, child_node, level.below, level.above)) {
      out.append(cell);
      parents.push_back(parent);
      count(made);
      return;
    }
    descend(depth + 1, level.below, child_node[0], level.rest, parent, out, parents, made);
    descend(depth + 1, level.above, child_node[1], level.rest, parent, out, parents, made);
  }

  void count(std::atomic<std::int64_t>& made) const {
    const auto n = made.fetch_add(1, std::memory_order_relaxed) + 1;
    if (n > job_.max_cells) throw TooManyCells();
    if (n % 1024 == 0 && interrupt_signal != 0)
      throw Error(ErrorKind::analysis, "interrupted while cutting; nothing was written");
  }

  const CuttingJob& job_;
  const PlaneTable& planes_;
  CellSplitter splitter_;
  PolygonClipper clipper_;
  Polygon section_;
  std::vector<Vec3> corners_;
  SurfaceList put_off_;  // surfaces whose part in the cell is narrow
  std::vector<std::unique_ptr<Level>> levels_;
};

// A task in two, or false if there is nothing to share out.
bool divide_task(Task& task, Cutter& cutter, const CuttingJob& job, Task (&halves)[2]) {
  if (task.group.size() > 1) {
    cutter.divide(task, halves);
    return true;
  }
  if (task.group.size() == 1) {
    const Index c = task.group.front();
    task.cell = copy_of(job.cells[c]);
    task.parent = c;
    task.surfaces = cutter.applying(c, task.surfaces);
    task.group.clear();
  }
  if (task.surfaces.empty() && job.tree[task.node].plane == none) return false;
  Index child_node[2];
  if (!cutter.cut_once(task.cell, task.node, task.surfaces, halves[0].surfaces, child_node,
                       halves[0].cell, halves[1].cell)) {
    task.surfaces.clear();
    return false;
  }
  halves[1].surfaces = halves[0].surfaces;
  for (int h = 0; h < 2; ++h) {
    halves[h].parent = task.parent;
    halves[h].node = child_node[h];
  }
  return true;
}

// Divides breadth first until there are enough subtrees to share out; the order is that of a depth-first walk.
std::vector<Task> make_tasks(const CuttingJob& job, Cutter& cutter) {
  Task all;
  all.group = job.which;
  all.surfaces.resize(job.surfaces.size());
  std::iota(all.surfaces.begin(), all.surfaces.end(), 0);
  std::vector<Task> tasks;
  if (all.group.empty()) return tasks;
  tasks.push_back(std::move(all));
  for (bool grew = true; grew && tasks.size() < subtree_count;) {
    grew = false;
    std::vector<Task> next;
    for (Task& task : tasks) {
      Task halves[2];
      if (!divide_task(task, cutter, job, halves)) {
        next.push_back(std::move(task));
        continue;
      }
      for (Task& half : halves) next.push_back(std::move(half));
      grew = true;
    }
    tasks = std::move(next);
  }
  return tasks;
}

}  // namespace

Subdivision subdivide(const CuttingJob& job, Progress& progress) {
  Cutter first(job);
  std::vector<Task> tasks = make_tasks(job, first);
  Subdivision result;
  result.parts.resize(tasks.size());
  result.parents.resize(tasks.size());
  std::atomic<std::int64_t> made{0};
  progress.begin("cutting", 0, "cells");
  const auto run = [&](std::int64_t i) {
    Cutter cutter(job);
    cutter.run(tasks[i], result.parts[i], result.parents[i], made);
    tasks[i] = {};
#pragma omp critical(rockfold_progress)
    progress.done(made.load(std::memory_order_relaxed));
  };
  const bool unfinished = tasks.size() >= subtree_count;
  parallel_for(static_cast<std::int64_t>(tasks.size()), 1, run, unfinished);
  progress.end();
  return result;
}

}  // namespace rockfold
