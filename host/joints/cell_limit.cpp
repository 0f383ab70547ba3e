#include "host/joints/cell_limit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

Place place_of_limit(const Model& model) {
  if (!model.cut.place_of_max_cells.file.empty()) return model.cut.place_of_max_cells;
  if (!model.joint_sets.empty()) return model.joint_sets.front().place;
  if (!model.joints.empty()) return model.joints.front().place;
  if (!model.joint_meshes.empty()) return model.joint_meshes.front().place;
  if (!model.joint_tables.empty()) return model.joint_tables.front().place;
  return model.solids.empty() ? Place{model.path, 0, 0, {}} : model.solids.front().place;
}

}  // namespace

CellEstimate estimate_cells(const std::vector<PlaneSet>& sets, Real volume, Real diagonal) {
  CellEstimate estimate{1, 1};
  for (const PlaneSet& set : sets) estimate.about += set.count;
  // Each cell lies between neighbours of every family: in the parallelepiped of three, in the column of two.
  const auto at_least = [&](Real cell_volume) {
    estimate.least = std::max(estimate.least, volume / cell_volume);
  };
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = i + 1; j < sets.size(); ++j) {
      const PlaneSet &a = sets[i], &b = sets[j];
      const Vec3 along = cross(a.normal, b.normal);
      if (a.fills && b.fills) at_least(a.widest * b.widest * diagonal / norm(along));
      for (std::size_t k = j + 1; k < sets.size(); ++k) {
        const PlaneSet& c = sets[k];
        const Real det = std::abs(dot(along, c.normal));
        const Real common = std::min({volume, a.volume, b.volume, c.volume});
        estimate.about += std::min(common * det / (a.spacing * b.spacing * c.spacing),
                                   a.count * b.count * c.count);
        if (a.fills && b.fills && c.fills) at_least(a.widest * b.widest * c.widest / det);
      }
    }
  estimate.about = std::max(estimate.about, estimate.least);
  return estimate;
}

void refuse_cells(const Model& model, const std::string& what) {
  refuse(place_of_limit(model), "cut.max_cells", what);
}

std::string about_cells(Real cells) {
  const Real unit = std::pow(10, std::floor(std::log10(cells)) - 1);  // two digits
  return cells < 1e6 && cells >= 10 ? fmt::format("about {:.0f}", std::round(cells / unit) * unit)
                                    : fmt::format("about {:.2g}", cells);
}

void refuse_cell_count(const Model& model, const std::string& count) {
  refuse_cells(model, fmt::format("the model makes {} cells (convex parts of blocks), at most {} "
                                  "are allowed; use larger spacings or fewer joints, or a larger "
                                  "cut.max_cells",
                                  count, model.cut.max_cells));
}

}  // namespace rockfold
