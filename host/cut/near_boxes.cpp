#include "host/cut/near_boxes.hpp"

#include <algorithm>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

namespace rockfold {

namespace {

using TreeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

std::vector<TreeBox> tree_boxes(const std::vector<Box>& boxes, Real slack) {
  std::vector<TreeBox> result;
  result.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec3 &low = boxes[i].low, &high = boxes[i].high;
    result.emplace_back(CGAL::Bbox_3(low[0] - slack, low[1] - slack, low[2] - slack,
                                     high[0] + slack, high[1] + slack, high[2] + slack),
                        static_cast<Index>(i));
  }
  return result;
}

void sort_each(std::vector<std::vector<Index>>& lists) {
  for (auto& list : lists) std::sort(list.begin(), list.end());
}

}  // namespace

std::vector<std::vector<Index>> earlier_near_boxes(const std::vector<Box>& boxes, Real slack) {
  std::vector<std::vector<Index>> earlier(boxes.size());
  auto tree = tree_boxes(boxes, slack / 2);
  CGAL::box_self_intersection_d(tree.begin(), tree.end(), [&](const TreeBox& x, const TreeBox& y) {
    const Index a = x.info(), b = y.info();
    earlier[std::max(a, b)].push_back(std::min(a, b));
  });
  sort_each(earlier);
  return earlier;
}

std::vector<std::vector<Index>> near_boxes(const std::vector<Box>& of,
                                           const std::vector<Box>& among, Real slack) {
  std::vector<std::vector<Index>> near(of.size());
  auto first = tree_boxes(of, slack), second = tree_boxes(among, 0);
  CGAL::box_intersection_d(
      first.begin(), first.end(), second.begin(), second.end(),
      [&](const TreeBox& x, const TreeBox& y) { near[x.info()].push_back(y.info()); });
  sort_each(near);
  return near;
}

}  // namespace rockfold
