#include "src/report/drawings/contours.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace rockfold {

namespace {

/// Sides of a square of the grid; corners are a (low, low), b to its right, c above b, d above a.
enum Side { bottom, right, top, left };
using Segments = std::vector<std::pair<Side, Side>>;

/// By the corners that are high, a = 1, b = 2, c = 4, d = 8: each segment from the one side to the other.
Segments segments_of(unsigned corners, bool middle_is_high) {
  if (corners == 5)
    return middle_is_high ? Segments{{bottom, right}, {top, left}}
                          : Segments{{bottom, left}, {top, right}};
  if (corners == 10)
    return middle_is_high ? Segments{{left, bottom}, {right, top}}
                          : Segments{{right, bottom}, {left, top}};
  static const std::array<Segments, 16> simple{{{},
                                                {{bottom, left}},
                                                {{right, bottom}},
                                                {{right, left}},
                                                {{top, right}},
                                                {},
                                                {{top, bottom}},
                                                {{top, left}},
                                                {{left, top}},
                                                {{bottom, top}},
                                                {},
                                                {{right, top}},
                                                {{left, right}},
                                                {{bottom, right}},
                                                {{left, bottom}},
                                                {}}};
  return simple[corners];
}

/// An edge between two nodes: the lower node, and whether the other is above it.
using Edge = std::pair<std::size_t, bool>;

class Tracer {
 public:
  Tracer(const ContourGrid& grid, Real level) : grid_(grid), level_(level) {
    for (std::size_t j = 0; j + 1 < grid.size; ++j)
      for (std::size_t i = 0; i + 1 < grid.size; ++i) add_square(i, j);
  }

  std::vector<std::vector<Point2>> loops() {
    std::vector<std::vector<Point2>> all;
    while (!next_.empty()) {
      std::vector<Point2> loop;
      auto at = next_.begin();
      while (at != next_.end()) {
        loop.push_back(crossing(at->first));
        const Edge to = at->second;
        next_.erase(at);
        at = next_.find(to);
      }
      all.push_back(std::move(loop));
    }
    return all;
  }

 private:
  Edge edge(std::size_t i, std::size_t j, Side side) const {
    const std::size_t node = j * grid_.size + i;
    switch (side) {
      case bottom:
        return {node, false};
      case top:
        return {node + grid_.size, false};
      case left:
        return {node, true};
      default:
        return {node + 1, true};
    }
  }

  void add_square(std::size_t i, std::size_t j) {
    const std::array<Real, 4> corner{grid_.at(i, j), grid_.at(i + 1, j), grid_.at(i + 1, j + 1),
                                     grid_.at(i, j + 1)};
    unsigned corners = 0;
    for (unsigned k = 0; k < 4; ++k) corners |= corner[k] >= level_ ? 1U << k : 0U;
    const bool middle = (corner[0] + corner[1] + corner[2] + corner[3]) / 4 >= level_;
    for (const auto& [from, to] : segments_of(corners, middle))
      next_[edge(i, j, from)] = edge(i, j, to);
  }

  Point2 crossing(const Edge& edge) const {
    const auto [node, up] = edge;
    const Real here = grid_.value[node], there = grid_.value[node + (up ? grid_.size : 1)];
    const Real part = (level_ - here) / (there - here);
    const std::size_t row = node / grid_.size, column = node % grid_.size;
    const auto i = static_cast<Real>(column), j = static_cast<Real>(row);
    return {grid_.low[0] + grid_.step * (i + (up ? 0 : part)),
            grid_.low[1] + grid_.step * (j + (up ? part : 0))};
  }

  const ContourGrid& grid_;
  Real level_;
  std::map<Edge, Edge> next_;  ///< along the contours
};

}  // namespace

std::vector<std::vector<Point2>> contour_loops(const ContourGrid& grid, Real level) {
  return Tracer(grid, level).loops();
}

std::vector<Real> contour_levels(Real most) {
  constexpr int most_levels = 8;
  if (!(most > 0)) return {};
  Real step = 0;
  for (Real power = std::pow(10, std::floor(std::log10(most)) - 1); step == 0; power *= 10)
    for (const Real factor : {1.0, 2.0, 5.0})
      if (step == 0 && most <= (most_levels + 1) * factor * power) step = factor * power;
  std::vector<Real> levels;
  for (int k = 1; k <= most_levels && k * step < most; ++k) levels.push_back(k * step);
  return levels;
}

}  // namespace rockfold
