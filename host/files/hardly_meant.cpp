#include "host/files/hardly_meant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// Of the median edge: above it faces of that size turn by half a degree.
constexpr Real coarse = 0.01;

/// Ground is never so much higher than wide; in degrees a rise of 1 in 1,000 is 100 times that.
constexpr Real tower = 10;

struct Bounds {
  Vec3 low, high;

  explicit Bounds(const std::vector<Vec3>& points) : low(points.front()), high(low) {
    for (const Vec3& p : points)
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], p[d]);
        high[d] = std::max(high[d], p[d]);
      }
  }
  Real farthest(std::size_t d) const { return std::max(std::abs(low[d]), std::abs(high[d])); }
};

/// From a number to the next larger one of single precision.
Real float_step(Real x) {
  const auto value = static_cast<float>(x);
  return std::nextafter(value, std::numeric_limits<float>::infinity()) - value;
}

struct Sizes {
  std::vector<Real> edges;  ///< m, of each triangle
  Real area = 0;            ///< m²
  Real volume = 0;          ///< m³
};

Sizes sizes_of(const TriangleSurface& mesh) {
  Sizes sizes;
  const Vec3& origin = mesh.vertices.front();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(i)] - origin,
               b = mesh.vertices[static_cast<std::size_t>(j)] - origin,
               c = mesh.vertices[static_cast<std::size_t>(k)] - origin;
    sizes.edges.insert(sizes.edges.end(), {norm(b - a), norm(c - b), norm(a - c)});
    sizes.area += norm(cross(b - a, c - a)) / 2;
    sizes.volume += dot(a, cross(b, c)) / 6;
  }
  std::sort(sizes.edges.begin(), sizes.edges.end());
  return sizes;
}

}  // namespace

std::optional<Diagnostic> coarse_coordinates(const TriangleSurface& mesh, bool is_solid,
                                             const Place& place) {
  const Bounds bounds(mesh.vertices);
  Vec3 step{};
  std::size_t worst = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    step[d] = float_step(bounds.farthest(d));
    if (step[d] > step[worst]) worst = d;
  }
  const Sizes sizes = sizes_of(mesh);
  const Real median = sizes.edges[sizes.edges.size() / 2];
  if (step[worst] <= coarse * median) return {};
  // Vertices that are off by half a step on each axis move all faces by no more than its length.
  const std::string volume = is_solid
                                 ? fmt::format(", its volume may be off by up to {:.2g} %",
                                               100 * sizes.area * norm(step) / 2 / sizes.volume)
                                 : "";
  return Diagnostic{
      place,
      fmt::format(
          "holds numbers of single precision, which are {:.2g} m apart at {} = {:.10g}: its "
          "shortest edge is {:.2g} m, half of its edges are no longer than {:.2g} m{}. Subtract an "
          "origin near the rock from all coordinates of the model before they are "
          "exported, or export OBJ with all decimals",
          step[worst], "xyz"[worst], bounds.farthest(worst), sizes.edges.front(), median, volume)};
}

std::optional<Diagnostic> geographic_coordinates(const TriangleSurface& ground, Real base,
                                                 const Place& place) {
  const Bounds bounds(ground.vertices);
  const auto& [low, high] = bounds;
  const Real width = std::max(high[0] - low[0], high[1] - low[1]);
  if (bounds.farthest(0) > 180 || bounds.farthest(1) > 90 || high[2] - base < tower * width)
    return {};
  const Real longitude = (low[0] + high[0]) / 2, latitude = (low[1] + high[1]) / 2;
  const int zone = std::clamp(static_cast<int>(std::floor((longitude + 180) / 6)) + 1, 1, 60);
  return Diagnostic{
      place,
      fmt::format(
          "x and y look like degrees of longitude and latitude: x {:.6g} to {:.6g}, y "
          "{:.6g} to {:.6g} on rock {:.4g} m high. Coordinates are metres: reproject the file "
          "to UTM zone {}{} (as gdalwarp -t_srs EPSG:{} does)",
          low[0], high[0], low[1], high[1], high[2] - base, zone, latitude < 0 ? "S" : "N",
          (latitude < 0 ? 32700 : 32600) + zone)};
}

}  // namespace rockfold
