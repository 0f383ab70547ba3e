// Errors of the model that only geometry shows.
#pragma once

#include <string>

#include "src/base/error.hpp"

namespace rockfold {

/// Throws Error(model) at the entry's place, with `key` as the key's path.
[[noreturn]] inline void refuse(const Place& place, const std::string& key,
                                const std::string& message) {
  throw Error(ErrorKind::model, message, {place.file, place.line, place.column, key});
}

}  // namespace rockfold
