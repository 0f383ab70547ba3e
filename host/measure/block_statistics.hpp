// Statistics of the blocks: how large they are, of which shape, which are flagged, and what excavation takes away.
#pragma once

#include <array>
#include <vector>

#include "host/measure/block_shapes.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

constexpr std::array<int, 6> percentiles{10, 25, 50, 75, 90, 100};
using Percentiles = std::array<Real, percentiles.size()>;

/// One bin of the distribution of volumes: from ≤ volume < to; five bins a decade, edges at 10^(k/5) m³.
struct VolumeBin {
  Real from = 0, to = 0;  ///< m³
  Index blocks = 0;
  Real volume = 0;  ///< m³, of these blocks together
};

/// What a block's flags mean, bit by bit.
constexpr std::uint8_t flag_small_volume = 1;  ///< volume < cut.min_volume
constexpr std::uint8_t flag_elongated = 2;     ///< aspect ratio > cut.max_aspect_ratio

struct BlockStatistics {
  std::vector<BlockShape> shape;    ///< [B]
  std::vector<std::uint8_t> flags;  ///< [B]; empty where the model asks for none

  Real volume = 0;       ///< m³, of all blocks
  Real mean_volume = 0;  ///< m³
  /// m³: the least volume that `percentiles` per cent of the blocks, by number, do not exceed.
  Percentiles volume_by_number{};
  /// m³: the same by volume, i.e. blocks up to this one make that share of the rock.
  Percentiles volume_by_volume{};
  /// m: the in-situ block sizes, cube roots of volume_by_volume.
  Percentiles size_by_volume{};
  std::vector<VolumeBin> histogram;  ///< ascending, without gaps

  struct OfClass {
    Index blocks = 0;
    Real volume = 0;  ///< m³
  };
  std::array<OfClass, shape_class_count> of_class{};
  Real mean_alpha = 0, mean_beta = 0;  ///< weighted by volume

  Index small_blocks = 0, elongated_blocks = 0;  ///< flagged
};

/// Deterministic; in parallel where it pays.
BlockStatistics block_statistics(const BlockArrays& blocks, const CutSpec& spec);

/// What a stage of the excavation takes away.
struct StageReport {
  Index stage = 0;
  Index blocks = 0;
  Real volume = 0;  ///< m³
  /// m²: faces of blocks that are there for longer which it lays open.
  Real new_free_area = 0;
};

/// The stages of the model in ascending order, also those that take no block away.
std::vector<StageReport> stage_reports(const BlockArrays& blocks, const Model& model);

}  // namespace rockfold
