// The bytes of a file.
#pragma once

#include <string>

#include "src/base/error.hpp"

namespace rockfold {

/// The whole of the file `place.file`. Throws Error(io) if it cannot be read, is a folder or a device or has no
/// room in memory, Error(model) if it is empty.
std::string read_data_file(const Place& place);

}  // namespace rockfold
