#include "host/cut/subdivide.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Independent subtrees; enough to keep any likely number of threads busy, and the same for all of them.
constexpr std::size_t subtree_count = 512;
constexpr std::int64_t max_cells = 20'000'000;

using SurfaceList = std::vector<Index>;

struct Task {
  ConvexCell cell;
  SurfaceList surfaces;  // that may still meet the cell
  Index parent = none;
};

// Cuts cells by surfaces, with buffers that live as long as it does.
class Cutter {
 public:
  Cutter(const PlaneTable& planes, const std::vector<CuttingSurface>& surfaces)
      : planes_(planes), surfaces_(surfaces), splitter_(planes), clipper_(planes) {}

  // The first surface of the list that cuts the cell, after which the list holds those that follow; none if none does.
  // Surfaces found not to meet the cell are left out.
  Index first_cut(const CellView& cell, const SurfaceList& list, SurfaceList& rest,
                  ConvexCell& below, ConvexCell& above) {
    const BoundingBall ball = bounding_ball(cell);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const CuttingSurface& surface = surfaces_[list[i]];
      if (!may_meet(ball, surface.plane)) continue;
      if (splitter_.classify(cell, surface.plane) != CellSide::split) continue;
      split(cell, surface.plane, below, above);
      if (!section_meets(below, surface)) continue;
      rest.assign(list.begin() + static_cast<std::ptrdiff_t>(i) + 1, list.end());
      return list[i];
    }
    return none;
  }

  // All cells of a subtree, depth first.
  void run(Task& task, Subdivision& out, std::atomic<std::int64_t>& made) {
    descend(0, task.cell, task.surfaces, task.parent, out, made);
  }

  IntentCount take_intent() {
    IntentCount sum = splitter_.intent;
    sum.add(clipper_.intent);
    return sum;
  }

 private:
  struct Level {
    ConvexCell below, above;
    SurfaceList rest;
  };

  bool may_meet(const BoundingBall& ball, Index plane) const {
    const Real distance = dot(planes_.normal(plane), ball.centre) - planes_.offset(plane);
    return std::abs(distance) <= ball.radius + 100 * planes_.tolerance();
  }

  void split(const CellView& cell, Index plane, ConvexCell& below, ConvexCell& above) {
    try {
      splitter_.split(cell, plane, &below, &above);
    } catch (const std::logic_error& error) {
      const Vec3 x = bounding_ball(cell).centre + planes_.centre();
      throw Error(ErrorKind::analysis, fmt::format("cutting failed near ({:.6g}, {:.6g}, {:.6g}): "
                                                   "{}; planes that nearly coincide there are "
                                                   "neither one plane nor clearly two",
                                                   x[0], x[1], x[2], error.what()));
    }
  }

  // Whether the polygon's interior meets the section, which is the last face of the part below.
  bool section_meets(const ConvexCell& below, const CuttingSurface& surface) {
    if (surface.edges.empty()) return true;
    Polygon section = face_polygon(below, below.faces.back()), part;
    for (const HalfSpaceId edge : surface.edges) {
      clipper_.split(section, edge, part, nullptr);
      if (part.empty()) return false;
      std::swap(section, part);
    }
    return true;
  }

  void descend(std::size_t depth, const ConvexCell& cell, const SurfaceList& list, Index parent,
               Subdivision& out, std::atomic<std::int64_t>& made) {
    if (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
    Level& level = *levels_[depth];
    if (first_cut(cell, list, level.rest, level.below, level.above) == none) {
      out.cells.append(cell);
      out.parent.push_back(parent);
      count(made);
      return;
    }
    descend(depth + 1, level.below, level.rest, parent, out, made);
    descend(depth + 1, level.above, level.rest, parent, out, made);
  }

  static void count(std::atomic<std::int64_t>& made) {
    const auto n = made.fetch_add(1, std::memory_order_relaxed) + 1;
    if (n > max_cells)
      throw Error(
          ErrorKind::model,
          fmt::format("the joints make more than {} cells; use larger spacings or fewer joints",
                      max_cells));
    if (n % 1024 == 0 && interrupt_signal != 0)
      throw Error(ErrorKind::analysis, "interrupted while cutting; nothing was written");
  }

  const PlaneTable& planes_;
  const std::vector<CuttingSurface>& surfaces_;
  CellSplitter splitter_;
  PolygonClipper clipper_;
  std::vector<std::unique_ptr<Level>> levels_;
};

// Cuts breadth first until there are enough subtrees to share out; the order is that of a depth-first walk.
std::vector<Task> make_tasks(const CellStore& cells, Cutter& cutter, std::size_t surface_count) {
  std::vector<Task> tasks;
  SurfaceList all(surface_count);
  for (std::size_t i = 0; i < surface_count; ++i) all[i] = static_cast<Index>(i);
  for (Index c = 0; c < cells.size(); ++c) {
    const CellView view = cells[c];
    Task task;
    task.cell.vertices.assign(view.vertices.begin(), view.vertices.end());
    task.cell.faces.assign(view.faces.begin(), view.faces.end());
    task.cell.corners.assign(view.corners.begin(), view.corners.end());
    task.surfaces = all;
    task.parent = c;
    tasks.push_back(std::move(task));
  }
  for (bool grew = true; grew && tasks.size() < subtree_count;) {
    grew = false;
    std::vector<Task> next;
    for (Task& task : tasks) {
      Task below, above;
      if (task.surfaces.empty() || cutter.first_cut(task.cell, task.surfaces, below.surfaces,
                                                    below.cell, above.cell) == none) {
        task.surfaces.clear();
        next.push_back(std::move(task));
        continue;
      }
      above.surfaces = below.surfaces;
      below.parent = above.parent = task.parent;
      next.push_back(std::move(below));
      next.push_back(std::move(above));
      grew = true;
    }
    tasks = std::move(next);
  }
  return tasks;
}

}  // namespace

Subdivision subdivide(const PlaneTable& planes, const CellStore& cells,
                      const std::vector<CuttingSurface>& surfaces, Progress& progress) {
  Cutter first(planes, surfaces);
  std::vector<Task> tasks = make_tasks(cells, first, surfaces.size());

  std::vector<Subdivision> parts(tasks.size());
  std::atomic<std::int64_t> made{0};
  progress.begin("cutting", 0, "cells");
  parallel_for(static_cast<std::int64_t>(tasks.size()), 1, [&](std::int64_t i) {
    Cutter cutter(planes, surfaces);
    cutter.run(tasks[i], parts[i], made);
    parts[i].intent = cutter.take_intent();
    tasks[i] = {};
#pragma omp critical(rockfold_progress)
    progress.done(made.load(std::memory_order_relaxed));
  });
  progress.end();

  Subdivision result;
  result.intent = first.take_intent();
  for (Subdivision& part : parts) {
    result.cells.append(part.cells);
    result.parent.insert(result.parent.end(), part.parent.begin(), part.parent.end());
    result.intent.add(part.intent);
    part = {};
  }
  return result;
}

}  // namespace rockfold
