#include "src/io/packed_rows.hpp"

#define H5_USE_110_API  // the names of 1.10 in later versions too
#include <algorithm>
#include <array>
#include <vector>

#include <hdf5.h>
#include <zlib.h>

namespace rockfold::hdf5 {
namespace {

constexpr std::int64_t chunks_at_once = 32;
/// So much of a chunk is packed first, to see what comes of it.
constexpr std::int64_t sample_bytes = 32 * 1024;
/// A chunk of which less than a third would be saved is stored as it is.
constexpr double worthwhile = 2.0 / 3;
/// Bits of the filters to leave out, in the order in which the data set has them: shuffle, deflate.
constexpr std::uint32_t no_filter = 3;

/// The first bytes of all numbers, then the second ones, …: what HDF5's shuffle does.
template <std::int64_t size>
void shuffle_numbers(const std::uint8_t* from, std::int64_t numbers, std::uint8_t* to) {
  for (std::int64_t i = 0; i < numbers; ++i)
    for (std::int64_t k = 0; k < size; ++k) to[k * numbers + i] = from[i * size + k];
}

void shuffle(const std::uint8_t* from, std::int64_t bytes, std::int64_t size, std::uint8_t* to) {
  if (size == 8)
    shuffle_numbers<8>(from, bytes / 8, to);
  else if (size == 4)
    shuffle_numbers<4>(from, bytes / 4, to);
  else
    std::copy_n(from, bytes, to);
}

/// Packs one chunk; keeps its buffers for the next.
class Packer {
 public:
  Packer(std::int64_t chunk_bytes, std::int64_t element_bytes)
      : bytes_(chunk_bytes),
        element_(element_bytes),
        filled_up_(chunk_bytes),
        shuffled_(chunk_bytes),
        packed_(compressBound(static_cast<uLong>(chunk_bytes))) {}

  /// `part` is the chunk, or less of it at the end of the data set. Does not allocate and does not throw.
  void pack(std::span<const std::uint8_t> part) {
    const std::uint8_t* chunk = part.data();
    if (static_cast<std::int64_t>(part.size()) < bytes_) {
      std::fill(std::copy(part.begin(), part.end(), filled_up_.begin()), filled_up_.end(), 0);
      chunk = filled_up_.data();
    }
    const std::int64_t sample = std::min(bytes_, sample_bytes);
    std::int64_t size = deflate(chunk, sample);
    const bool pays = static_cast<double>(size) <= worthwhile * static_cast<double>(sample);
    if (pays && sample < bytes_) size = deflate(chunk, bytes_);
    stored_ = pays ? packed_.data() : chunk;
    stored_bytes_ = pays ? size : bytes_;
    filters_left_out_ = pays ? 0 : no_filter;
  }

  bool write(hid_t dataset, int rank, std::int64_t first_row) const {
    const std::array<hsize_t, 2> at = {static_cast<hsize_t>(first_row), 0};
    return rank <= 2 && H5Dwrite_chunk(dataset, H5P_DEFAULT, filters_left_out_, at.data(),
                                       static_cast<std::size_t>(stored_bytes_), stored_) >= 0;
  }

 private:
  std::int64_t deflate(const std::uint8_t* from, std::int64_t bytes) {
    shuffle(from, bytes, element_, shuffled_.data());
    auto size = static_cast<uLongf>(packed_.size());
    compress2(packed_.data(), &size, shuffled_.data(), static_cast<uLong>(bytes), deflate_level);
    return static_cast<std::int64_t>(size);
  }

  std::int64_t bytes_, element_;
  std::vector<std::uint8_t> filled_up_, shuffled_, packed_;
  const std::uint8_t* stored_ = nullptr;
  std::int64_t stored_bytes_ = 0;
  std::uint32_t filters_left_out_ = 0;
};

}  // namespace

bool write_packed(std::int64_t dataset, int rank, const ChunkedRows& rows) {
  const std::int64_t chunk_bytes = rows.rows_a_chunk * rows.row_bytes;
  const auto bytes = static_cast<std::int64_t>(rows.data.size());
  const std::int64_t chunks = (bytes + chunk_bytes - 1) / chunk_bytes;
  std::vector<Packer> packers;
  for (std::int64_t i = 0; i < std::min(chunks, chunks_at_once); ++i)
    packers.emplace_back(chunk_bytes, rows.element_bytes);
  for (std::int64_t first = 0; first < chunks; first += chunks_at_once) {
    const std::int64_t n = std::min(chunks_at_once, chunks - first);
#pragma omp parallel for schedule(dynamic, 1) if (n > 1)
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t begin = (first + i) * chunk_bytes;
      packers[i].pack(rows.data.subspan(begin, std::min(chunk_bytes, bytes - begin)));
    }
    // HDF5 itself is called from this thread alone.
    for (std::int64_t i = 0; i < n; ++i)
      if (!packers[i].write(dataset, rank, (first + i) * rows.rows_a_chunk)) return false;
  }
  return true;
}

}  // namespace rockfold::hdf5
