// Opens a result file for those who read its arrays (src/io/result_file.hpp says what stands where).
#pragma once

#include <memory>
#include <string>

#include "src/io/hdf5_file.hpp"

namespace rockfold {

/// Throws Error(io) where the file is missing, no HDF5, not one of ours, of a later format, or cut short.
std::unique_ptr<hdf5::File> open_result(const std::string& path);

}  // namespace rockfold
