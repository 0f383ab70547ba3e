#include "src/report/drawings/survey_net.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/survey/density.hpp"
#include "src/report/drawings/contours.hpp"
#include "src/report/drawings/net.hpp"
#include "src/report/drawings/stereonet.hpp"

namespace rockfold {

namespace {

/// Nodes across the net, and how far beyond its rim: the density goes on there, so that contours leave the net at their own angle.
constexpr std::size_t grid_size = 141;
constexpr Real reach = 1.05;

/// On a net of radius 1 (equal area, north up) the density of the direction that the point shows, of the other hemisphere beyond the rim.
ContourGrid density_grid(const PoleDensity& density) {
  ContourGrid grid{grid_size, {-reach, -reach}, 2 * reach / (grid_size - 1), {}};
  for (std::size_t j = 0; j < grid_size; ++j)
    for (std::size_t i = 0; i < grid_size; ++i) {
      const Real x = grid.low[0] + grid.step * static_cast<Real>(i);
      const Real y = grid.low[1] + grid.step * static_cast<Real>(j);
      const Real squared = x * x + y * y;  // 2 sin²(θ/2) = 1 − cos θ
      const bool rim = i == 0 || j == 0 || i + 1 == grid_size || j + 1 == grid_size;
      const Real scale = std::sqrt(std::max(2 - squared, Real{0}));  // sin θ / r
      grid.value.push_back(
          rim || squared > reach * reach ? 0 : density.at({scale * x, scale * y, squared - 1}));
    }
  return grid;
}

void add_density(NetContent& content, const SurveyReport& report) {
  const PoleDensity density(report.poles, report.weight);
  const ContourGrid grid = density_grid(density);
  for (const Real level : contour_levels(*std::max_element(grid.value.begin(), grid.value.end())))
    content.shades.push_back({fmt::format("{:g} and more", level), contour_loops(grid, level)});
  content.title_of_shades = "Density, multiples of uniform (% per 1 % area)";
}

}  // namespace

std::string survey_net(const SurveyReport& report, const std::string& title) {
  NetContent content;
  content.title = title;
  content.title_of_document = "Poles and joint sets of " + title;
  content.equal_area = true;
  content.words_of_poles = fmt::format("dots: poles of {} joints", report.poles.size());
  content.words_of_others = "of no set";
  content.label_planes = true;
  add_density(content, report);
  for (const MeasuredSet& set : report.sets) {
    const std::size_t number = content.planes.size();
    content.planes.push_back(net_plane(set.name, set.fisher.mean));
    content.planes.back().note =
        std::isfinite(set.fisher.kappa)
            ? fmt::format("  κ {:.0f}, {} joints", set.fisher.kappa, set.count)
            : fmt::format("  {} joints", set.count);
    if (std::isfinite(set.fisher.confidence_cone) && number < most_net_planes)
      content.means.push_back({set.fisher.mean, set.fisher.confidence_cone, number});
  }
  for (std::size_t i = 0; i < report.poles.size(); ++i) {
    const Index set = report.set_of_row[i];
    content.poles.push_back(
        {report.poles[i], set == none ? content.planes.size() : static_cast<std::size_t>(set)});
  }
  return draw_net(content);
}

}  // namespace rockfold
