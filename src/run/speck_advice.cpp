#include "src/run/speck_advice.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "host/cut/cut.hpp"

namespace rockfold {

std::string speck_advice(const BlockArrays& blocks, const CutSpec& cut, Index block) {
  const auto& volume = blocks.volume;
  if (volume.empty()) return "";
  const Real mean =
      std::accumulate(volume.begin(), volume.end(), Real{0}) / static_cast<Real>(volume.size());
  const auto is_speck = [&](Real v) { return v < speck_share * mean; };
  const auto count = std::count_if(volume.begin(), volume.end(), is_speck);
  if (count == 0) return "";
  if (block == none || !is_speck(volume[block]))
    block = static_cast<Index>(std::min_element(volume.begin(), volume.end()) - volume.begin());
  const std::string others = count == 1   ? ""
                             : count == 2 ? " (and so has 1 other)"
                                          : fmt::format(" (and so have {} others)", count - 1);
  const std::string what =
      fmt::format(". Block {} has {:.2g} m3, less than a millionth of the mean block's {:.2g} m3{}",
                  block + 1, volume[block], mean, others);
  return what + (cut.specks == Specks::keep
                     ? ": cut.specks = \"merge\" joins such blocks to their neighbours"
                     : ": cut.specks = \"merge\" has left it, a larger cut.min_volume may not");
}

}  // namespace rockfold
