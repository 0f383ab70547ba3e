// How summaries tell of key blocks.
#pragma once

#include <string>
#include <vector>

#include "host/keyblock/keyblock.hpp"

namespace rockfold {

/// A block that nothing holds is pushed out where its direction of motion has no more than this upwards or downwards: within 30° of
/// level. Documents carry it to the page, and the word of each key block.
constexpr Real pushed_out_within = 0.5;

/// "slides on two"; a block that nothing holds falls, or is pushed up, or out where it moves within 30° of level.
const char* mode_words(SlidingMode mode, const Vec3& direction);
const char* mode_words(const Keyblock& key);
/// "0.94", or "-" of what is not finite
std::string number_or_dash(Real value, int digits);
/// "J1, J2", or "-"
std::string joined_names(const std::vector<std::string>& names);
/// The least safe first: what falls, then by factor of safety, of equals the heavier.
void sort_by_safety(std::vector<Keyblock>& keys);

}  // namespace rockfold
