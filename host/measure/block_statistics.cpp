#include "host/measure/block_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "src/base/sum.hpp"

namespace rockfold {

namespace {

/// Volumes that differ by rounding are one: percentiles of equal blocks are that block's volume, whatever is summed.
constexpr Real rounding = 1e-9;

void add_percentiles(std::vector<Real> volume, BlockStatistics& out) {
  std::sort(volume.begin(), volume.end());
  const auto n = static_cast<Real>(volume.size());
  std::size_t k = 0;
  for (std::size_t p = 0; p < percentiles.size(); ++p) {
    while (k + 1 < volume.size() &&
           static_cast<Real>(k + 1) < (percentiles[p] / 100.0 - rounding) * n)
      ++k;
    out.volume_by_number[p] = volume[k];
  }
  Sum sum;
  k = 0;
  sum += volume[0];
  for (std::size_t p = 0; p < percentiles.size(); ++p) {
    while (k + 1 < volume.size() && sum.value() < (percentiles[p] / 100.0 - rounding) * out.volume)
      sum += volume[++k];
    // The last tenths of a sum that rounds may stop before the largest block.
    out.volume_by_volume[p] = percentiles[p] == 100 ? volume.back() : volume[k];
    out.size_by_volume[p] = std::cbrt(out.volume_by_volume[p]);
  }
  out.volume_by_number.back() = volume.back();
}

constexpr int bins_a_decade = 5;

int bin_of(Real volume) {
  return static_cast<int>(std::floor(bins_a_decade * std::log10(volume) + rounding));
}

Real bin_edge(int bin) {
  return std::pow(10.0, static_cast<Real>(bin) / bins_a_decade);
}

void add_histogram(const std::vector<Real>& volume, BlockStatistics& out) {
  const auto [least, most] = std::minmax_element(volume.begin(), volume.end());
  const int first = bin_of(*least), last = bin_of(*most);
  out.histogram.resize(last - first + 1);
  std::vector<Sum> sums(out.histogram.size());
  for (int k = first; k <= last; ++k) {
    out.histogram[k - first].from = bin_edge(k);
    out.histogram[k - first].to = bin_edge(k + 1);
  }
  for (const Real v : volume) {
    const int k = bin_of(v) - first;
    ++out.histogram[k].blocks;
    sums[k] += v;
  }
  for (std::size_t k = 0; k < sums.size(); ++k) out.histogram[k].volume = sums[k].value();
}

void add_shapes(const std::vector<Real>& volume, BlockStatistics& out) {
  std::array<Sum, shape_class_count> of_class;
  Sum alpha, beta;
  for (std::size_t b = 0; b < volume.size(); ++b) {
    const BlockShape& shape = out.shape[b];
    const auto c = static_cast<std::size_t>(shape_class(shape.alpha, shape.beta));
    ++out.of_class[c].blocks;
    of_class[c] += volume[b];
    alpha += volume[b] * shape.alpha;
    beta += volume[b] * shape.beta;
  }
  for (std::size_t c = 0; c < of_class.size(); ++c) out.of_class[c].volume = of_class[c].value();
  out.mean_alpha = alpha.value() / out.volume;
  out.mean_beta = beta.value() / out.volume;
}

void add_flags(const std::vector<Real>& volume, const CutSpec& spec, BlockStatistics& out) {
  if (!spec.min_volume && !spec.max_aspect_ratio) return;
  out.flags.assign(volume.size(), 0);
  for (std::size_t b = 0; b < volume.size(); ++b) {
    if (spec.min_volume && volume[b] < *spec.min_volume) {
      out.flags[b] |= flag_small_volume;
      ++out.small_blocks;
    }
    if (spec.max_aspect_ratio && out.shape[b].aspect_ratio > *spec.max_aspect_ratio) {
      out.flags[b] |= flag_elongated;
      ++out.elongated_blocks;
    }
  }
}

}  // namespace

BlockStatistics block_statistics(const BlockArrays& blocks, const CutSpec& spec) {
  BlockStatistics out;
  if (blocks.block_count() == 0) return out;
  Sum volume;
  for (const Real v : blocks.volume) volume += v;
  out.volume = volume.value();
  out.mean_volume = out.volume / static_cast<Real>(blocks.volume.size());
  out.shape = block_shapes(blocks);
  add_percentiles(blocks.volume, out);
  add_histogram(blocks.volume, out);
  add_shapes(blocks.volume, out);
  add_flags(blocks.volume, spec, out);
  return out;
}

std::vector<StageReport> stage_reports(const BlockArrays& blocks, const Model& model) {
  struct Sums {
    Index blocks = 0;
    Sum volume, area;
  };
  std::map<Index, Sums> stages;
  for (const Excavation& e : model.excavations) stages[e.stage];
  if (!blocks.stage.empty()) {
    for (std::size_t b = 0; b < blocks.volume.size(); ++b) {
      if (blocks.stage[b] == 0) continue;
      ++stages[blocks.stage[b]].blocks;
      stages[blocks.stage[b]].volume += blocks.volume[b];
    }
    const auto gone_at = [&](Index b) {
      return blocks.stage[b] == 0 ? std::numeric_limits<Index>::max() : blocks.stage[b];
    };
    for (const auto& shared : blocks.interfaces) {
      const Index a = gone_at(shared.block[0]), b = gone_at(shared.block[1]);
      if (a != b) stages[std::min(a, b)].area += shared.area;
    }
  }
  std::vector<StageReport> reports;
  for (const auto& [stage, sums] : stages)
    reports.push_back({stage, sums.blocks, sums.volume.value(), sums.area.value()});
  return reports;
}

}  // namespace rockfold
