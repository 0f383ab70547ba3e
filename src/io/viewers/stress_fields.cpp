#include "src/io/viewers/stress_fields.hpp"

#include <algorithm>

#include "src/io/viewers/stress_measures.hpp"

namespace rockfold {

StressFields::StressFields(const std::vector<Material>& materials) : materials_(materials) {
  with_strength_ = std::any_of(materials_.begin(), materials_.end(), has_strength);
}

void StressFields::append(hdf5::File& file, vtkhdf::Grid& grid, const StressRows& rows,
                          std::int64_t state) const {
  const std::size_t count = rows.material.size();
  std::vector<std::array<float, 6>> stress(count);
  std::vector<std::array<float, 3>> principal(count);
  std::vector<float> mises(count), ratio(with_strength_ ? count : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& s = rows.stress[rows.source.empty() ? i : static_cast<std::size_t>(rows.source[i])];
    for (int k = 0; k < 6; ++k) stress[i][k] = static_cast<float>(s[k]);
    const Vec3 p = principal_stresses(s);
    for (int d = 0; d < 3; ++d) principal[i][d] = static_cast<float>(p[d]);
    mises[i] = static_cast<float>(von_mises(s));
    if (with_strength_)
      ratio[i] = static_cast<float>(strength_ratio(s, materials_[rows.material[i]]));
  }
  const auto add = [&](const char* name, const auto& values) {
    if (rows.at_points)
      vtkhdf::append_point_field(file, grid, rows.prefix + name, state, values);
    else
      vtkhdf::append_cell_field(file, grid, rows.prefix + name, state, values);
  };
  add("stress", stress);
  add("principal_stress", principal);
  add("von_mises", mises);
  if (with_strength_) add("strength_ratio", ratio);
}

std::int64_t StressFields::state_bytes(std::size_t rows) const {
  return vtkhdf::state_bytes(rows, 6 + 3 + 1 + (with_strength_ ? 1 : 0));
}

}  // namespace rockfold
