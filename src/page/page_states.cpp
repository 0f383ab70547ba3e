#include "src/page/page_states.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/base/vector.hpp"
#include "src/page/block_motion_fit.hpp"
#include "src/page/page_contacts.hpp"

namespace rockfold {

namespace {

using hdf5::File;

/// Of the largest displacement: what single precision leaves.
constexpr Real rigid_enough = 1e-4;
/// Larger strength ratios are all the same to the eye.
constexpr float largest_ratio = 10;

std::string field_path(const PageSurface& surface, const std::string& field) {
  return "/VTKHDF/" + surface.grid + "/PointData/" + field;
}

/// A field of the surface's points in one state, `width` numbers a point.
std::vector<float> point_field(const File& file, const PageSurface& surface,
                               const std::string& field, Index state, std::size_t width) {
  const std::string path = field_path(surface, field);
  const std::int64_t rows = file.shape("/VTKHDF/" + surface.grid + "/Points").at(0);
  const std::vector<float> all = file.read_rows(path, state * rows, rows);
  std::vector<float> out;
  out.reserve(surface.point_row.size() * width);
  for (const Index row : surface.point_row)
    for (std::size_t k = 0; k < width; ++k)
      out.push_back(all.at(width * static_cast<std::size_t>(row) + k));
  return out;
}

Real largest_length(const std::vector<float>& displacement) {
  Real largest = 0;
  for (std::size_t i = 0; i + 2 < displacement.size(); i += 3)
    largest = std::max(largest, norm({displacement[i], displacement[i + 1], displacement[i + 2]}));
  return largest;
}

/// The motion of whole blocks, unless one of them bends.
std::optional<std::vector<float>> whole_motions(const std::vector<std::vector<float>>& states,
                                                const PageSurface& surface,
                                                const std::vector<Vec3>& middle) {
  std::vector<float> all;
  for (const auto& displacement : states) {
    const FittedMotion fitted = fit_block_motions(surface, middle, displacement);
    if (fitted.miss > rigid_enough * largest_length(displacement)) return {};
    for (const AffineMotion& motion : fitted.block)
      all.insert(all.end(), motion.begin(), motion.end());
  }
  return all;
}

void add_point_displacement(const std::vector<std::vector<float>>& states, PageArrays& arrays) {
  constexpr Real most =
      4095;  // a model that is magnified until it moves by its own size shows no steps
  std::vector<std::int16_t> all;
  std::vector<float> units;
  for (const auto& displacement : states) {
    Real largest = 0;
    for (const float d : displacement) largest = std::max<Real>(largest, std::abs(d));
    const Real unit = largest > 0 ? largest / most : 1;
    units.push_back(static_cast<float>(unit));
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = axis; i < displacement.size(); i += 3)
        all.push_back(static_cast<std::int16_t>(
            std::lround(std::clamp(displacement[i] / unit, -most, most))));
  }
  arrays.add("displacement_unit", units);
  arrays.add_smooth("point_displacement", all);
}

/// Stress at the points of elements, smooth within each block.
void add_point_stress(const File& file, const PageSurface& surface,
                      const std::vector<Index>& states, PageArrays& arrays) {
  std::vector<float> von_mises, sigma_1, sigma_3, ratio;
  const bool with_ratio = file.exists(field_path(surface, "nodal_strength_ratio"));
  for (const Index s : states) {
    const auto mises = point_field(file, surface, "nodal_von_mises", s, 1);
    von_mises.insert(von_mises.end(), mises.begin(), mises.end());
    const auto principal = point_field(file, surface, "nodal_principal_stress", s, 3);
    for (std::size_t i = 0; i + 2 < principal.size(); i += 3)
      sigma_1.push_back(principal[i]), sigma_3.push_back(principal[i + 2]);
    if (!with_ratio) continue;
    for (const float r : point_field(file, surface, "nodal_strength_ratio", s, 1))
      ratio.push_back(std::isnan(r) ? r : std::min(r, largest_ratio));
  }
  add_levels("von_mises", von_mises, arrays);
  add_levels("sigma_1", sigma_1, arrays);
  add_levels("sigma_3", sigma_3, arrays);
  if (with_ratio) add_levels("strength_ratio", ratio, arrays);
}

void add_block_stress(const File& file, const PageSurface& surface,
                      const std::vector<Index>& states, PageArrays& arrays) {
  std::vector<float> all;
  for (const Index s : states) {
    const std::vector<float> stress = file.read_rows("/rockfold/states/block_stress", s, 1);
    for (const Index b : surface.block)
      for (std::size_t k = 0; k < 6; ++k)
        all.push_back(stress.at(6 * static_cast<std::size_t>(b) + k));
  }
  arrays.add("block_stress", all);
}

}  // namespace

std::vector<Index> shown_states(const File& file, Index every) {
  std::vector<Index> shown;
  if (!file.exists("/rockfold/states/time")) return shown;
  const auto count = static_cast<Index>(file.shape("/rockfold/states/time").at(0));
  for (Index s = 0; s < count; s += std::max<Index>(1, every)) shown.push_back(s);
  if (count > 0 && shown.back() != count - 1) shown.push_back(count - 1);
  return shown;
}

void add_states(const File& file, const PageSurface& surface, const std::vector<Index>& states,
                const Vec3& origin, PageArrays& arrays) {
  if (states.empty()) return;
  const auto pick = [&](const std::string& path) {
    const std::vector<double> all = file.read_numbers(path);
    std::vector<double> some;
    for (const Index s : states) some.push_back(all.at(static_cast<std::size_t>(s)));
    return some;
  };
  arrays.add("state_time", pick("/rockfold/states/time"));
  arrays.add("state_step", pick("/rockfold/states/step"));
  std::vector<std::vector<float>> displacement;
  for (const Index s : states)
    displacement.push_back(point_field(file, surface, "displacement", s, 3));
  const std::vector<Vec3> middle = block_middles(surface);
  if (const auto whole = whole_motions(displacement, surface, middle)) {
    std::vector<float> relative;
    for (const Vec3& m : middle)
      for (int d = 0; d < 3; ++d) relative.push_back(static_cast<float>(m[d] - origin[d]));
    arrays.add("block_middle", relative);
    arrays.add("block_motion", *whole);
  } else {
    add_point_displacement(displacement, arrays);
  }
  if (file.exists(field_path(surface, "nodal_von_mises")))
    add_point_stress(file, surface, states, arrays);
  else if (file.exists("/rockfold/states/block_stress"))
    add_block_stress(file, surface, states, arrays);
}

}  // namespace rockfold
