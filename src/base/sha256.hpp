// SHA-256 (FIPS 180-4): names a text so that anyone can check that it is the same, as with `sha256sum`.
#pragma once

#include <string>
#include <string_view>

namespace rockfold {

/// 64 hexadecimal digits.
std::string sha256(std::string_view text);

}  // namespace rockfold
