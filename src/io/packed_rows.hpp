// Compression on all threads: HDF5's own filters run on one.
#pragma once

#include <cstdint>
#include <span>

namespace rockfold::hdf5 {

/// How the rows of a data set are cut into chunks. Example: 10 rows of 3 doubles by 4: chunks of 4, 4 and 2 rows; the
/// last is filled up with zeros.
struct ChunkedRows {
  std::span<const std::uint8_t> data;  ///< all rows, as the file is to hold them
  std::int64_t element_bytes = 1;      ///< of one number
  std::int64_t row_bytes = 1;
  std::int64_t rows_a_chunk = 1;
};

/// 1 is nearly as small as 6 on shuffled ids and coordinates and three times as fast.
constexpr unsigned deflate_level = 1;

/// Writes the rows to a data set of `rank` dimensions that was made with that chunk size and with the filters shuffle,
/// deflate. Chunks that would hardly become smaller (coordinates of irregular blocks) are stored as they are: that saves
/// most of the time, of readers too. False if HDF5 cannot write; then its error stack says why.
bool write_packed(std::int64_t dataset, int rank, const ChunkedRows& rows);

}  // namespace rockfold::hdf5
