// Compression on all threads: HDF5's own filters run on one.
#pragma once

#include <cstdint>
#include <span>

namespace rockfold::hdf5 {

/// 1 is nearly as small as 6 on shuffled ids and coordinates and three times as fast.
constexpr unsigned deflate_level = 1;

/// How the rows of a data set are cut into chunks. Example: 10 rows of 3 doubles by 4: chunks of 4, 4 and 2 rows; the
/// last is filled up with zeros.
struct ChunkedRows {
  std::span<const std::uint8_t> data;  ///< all rows to write, as the file is to hold them
  std::int64_t element_bytes = 1;      ///< of one number
  std::int64_t row_bytes = 1;
  std::int64_t rows_a_chunk = 1;
  std::int64_t first_row = 0;  ///< of those to write
  std::span<const std::uint8_t> before =
      {};                          ///< rows that stand in the chunk of the first one already
  unsigned level = deflate_level;  ///< of deflate
  double worthwhile =
      2.0 / 3;  ///< a chunk that does not get smaller than this share is stored as it is
};

/// Writes the rows to a data set that was made with that chunk size and with the filters shuffle, deflate. `at` is an element of it; rows
/// count along dimension `along`, and all others are as large as a chunk. Chunks that would hardly become smaller (coordinates of
/// irregular blocks) are stored as they are: that saves most of the time, of readers too. False if HDF5 cannot write; then its error
/// stack says why.
bool write_packed(std::int64_t dataset, std::span<const unsigned long long> at, std::size_t along,
                  const ChunkedRows& rows);

}  // namespace rockfold::hdf5
