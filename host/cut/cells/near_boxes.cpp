#include "host/cut/cells/near_boxes.hpp"

#include <algorithm>

#include "host/box_tree.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

Bounds grown(const Box& box, Real by) {
  const Vec3 all{by, by, by};
  return {box.low - all, box.high + all};
}

BoxTree tree_of(const std::vector<Box>& boxes) {
  std::vector<Bounds> bounds;
  bounds.reserve(boxes.size());
  for (const Box& box : boxes) bounds.push_back({box.low, box.high});
  return BoxTree(std::move(bounds));
}

// So few boxes are no work for two threads.
constexpr std::size_t worth_threads = 1000;

// `own`: of the boxes of `among` themselves, where only those before each count.
std::vector<std::vector<Index>> near_each(const std::vector<Box>& of, const std::vector<Box>& among,
                                          Real slack, bool own) {
  const BoxTree tree = tree_of(among);
  std::vector<std::vector<Index>> near(of.size());
  const auto find = [&](std::int64_t i) {
    thread_local std::vector<Index> found;
    tree.near(grown(of[i], slack), found);
    const auto end =
        own ? std::lower_bound(found.begin(), found.end(), static_cast<Index>(i)) : found.end();
    near[i].assign(found.begin(), end);
  };
  parallel_for(static_cast<std::int64_t>(of.size()), 64, find, of.size() > worth_threads);
  return near;
}

}  // namespace

std::vector<std::vector<Index>> earlier_near_boxes(const std::vector<Box>& boxes, Real slack) {
  return near_each(boxes, boxes, slack, true);
}

std::vector<std::vector<Index>> near_boxes(const std::vector<Box>& of,
                                           const std::vector<Box>& among, Real slack) {
  return near_each(of, among, slack, false);
}

}  // namespace rockfold
