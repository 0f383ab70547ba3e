#include "host/files/meshes/polygon_soup.hpp"

#include <limits>

#include <fmt/format.h>

namespace rockfold {

void end_polygon(PolygonSoup& soup, int line, Faults& faults) {
  const auto begin = static_cast<std::size_t>(soup.corner_begin.back());
  const std::size_t corners = soup.corner.size() - begin;
  if (corners < 3) {
    faults.add(
        line, 0,
        fmt::format("face {} must have 3 corners or more, has {}", soup.line.size() + 1, corners));
    soup.corner.resize(begin);
    return;
  }
  soup.corner_begin.push_back(static_cast<Index>(soup.corner.size()));
  soup.line.push_back(line);
}

void check_size(const PolygonSoup& soup, Faults& faults) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<Index>::max());
  if (soup.vertices.size() < most && soup.corner.size() < most) return;
  faults.fail(fmt::format("has more than {} vertices or corners", most - 1));
}

}  // namespace rockfold
