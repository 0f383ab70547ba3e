// Bytes as text that fits into a page: deflated, then base64.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rockfold {

/// zlib's format (RFC 1950), which browsers name "deflate".
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes);

/// The inverse of gzip, for data that is `size` bytes long.
std::string gunzipped(std::span<const std::uint8_t> bytes, std::size_t size);

/// RFC 4648, on one line.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace rockfold
