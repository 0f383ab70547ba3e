// Opens a result file for those who read its arrays (src/io/result_file.hpp says what stands where).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "src/base/types.hpp"
#include "src/io/hdf5/hdf5_file.hpp"

namespace rockfold {

/// Throws Error(io) where the file is missing, no HDF5, not one of ours, of a later format, or cut short.
std::unique_ptr<hdf5::File> open_result(const std::string& path);

/// Numbers of rows. Throws std::out_of_range where one is less than `least`, or no less than `end`, as in a damaged file.
std::vector<Index> read_indices(const hdf5::File& file, const std::string& dataset, Index least,
                                std::size_t end);

/// Where each of some lists begins in what holds `count` entries, and where the last one ends. Throws std::out_of_range where one ends
/// before it begins, or not within these.
std::vector<Index> read_begins(const hdf5::File& file, const std::string& dataset,
                               std::size_t count);

/// Rows of three coordinates. Throws std::out_of_range where there are others.
std::vector<Vec3> read_points(const hdf5::File& file, const std::string& dataset);

}  // namespace rockfold
