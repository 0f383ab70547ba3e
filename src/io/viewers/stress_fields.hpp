// Fields of stress for viewers: the stress, its principal values, von Mises' stress and the strength ratio.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "src/io/viewers/vtkhdf.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Rows of a grid's stress: row i has the stress of `source[i]`, or of i where `source` is empty.
struct StressRows {
  bool at_points = false;                       ///< else of cells
  std::string prefix = {};                      ///< of the fields' names
  std::span<const std::array<Real, 6>> stress;  ///< Pa
  std::span<const Index> source;                ///< into `stress`
  std::span<const Index> material;              ///< of each row, into Model::materials
};

class StressFields {
 public:
  explicit StressFields(const std::vector<Material>& materials);

  /// Appends a state's fields `stress`, `principal_stress`, `von_mises` and, where a material has one, `strength_ratio`.
  void append(hdf5::File& file, vtkhdf::Grid& grid, const StressRows& rows,
              std::int64_t state) const;
  /// What append() writes, in bytes.
  std::int64_t state_bytes(std::size_t rows) const;

 private:
  std::vector<Material> materials_;
  bool with_strength_ = false;
};

}  // namespace rockfold
