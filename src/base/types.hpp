// The scalar types, fixed-size vectors and index types that every folder shares.
#pragma once

#include <array>
#include <cstdint>

namespace rockfold {

using Real = double;
/// Counts and ids of anything stored in a flat array. −1 means "none".
using Index = std::int32_t;

using Vec3 = std::array<Real, 3>;
/// Three rows.
using Mat3 = std::array<Vec3, 3>;

constexpr Index none = -1;

}  // namespace rockfold
