#include "src/io/hdf5/packed_rows.hpp"

#define H5_USE_110_API  // the names of 1.10 in later versions too
#include <algorithm>
#include <vector>

#include <hdf5.h>
#include <zlib.h>

namespace rockfold::hdf5 {
namespace {

constexpr std::int64_t chunks_at_once = 32;
/// So much of a chunk is packed first, to see what comes of it.
constexpr std::int64_t sample_bytes = 32 * 1024;
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
  explicit Packer(const ChunkedRows& rows)
      : rows_(rows),
        bytes_(rows.rows_a_chunk * rows.row_bytes),
        put_together_(bytes_),
        shuffled_(bytes_),
        packed_(compressBound(static_cast<uLong>(bytes_))) {}

  /// The chunk is `before` and `part`, and zeros where they are less. Does not allocate and does not throw.
  void pack(std::span<const std::uint8_t> before, std::span<const std::uint8_t> part) {
    const std::uint8_t* chunk = part.data();
    if (static_cast<std::int64_t>(part.size()) < bytes_) {
      const auto from = std::copy(before.begin(), before.end(), put_together_.begin());
      std::fill(std::copy(part.begin(), part.end(), from), put_together_.end(), 0);
      chunk = put_together_.data();
    }
    const std::int64_t sample = std::min(bytes_, sample_bytes);
    std::int64_t size = deflate(chunk, sample);
    const bool pays = static_cast<double>(size) <= rows_.worthwhile * static_cast<double>(sample);
    if (pays && sample < bytes_) size = deflate(chunk, bytes_);
    stored_ = pays ? packed_.data() : chunk;
    stored_bytes_ = pays ? size : bytes_;
    filters_left_out_ = pays ? 0 : no_filter;
  }

  bool write(hid_t dataset, const std::vector<hsize_t>& at) const {
    return H5Dwrite_chunk(dataset, H5P_DEFAULT, filters_left_out_, at.data(),
                          static_cast<std::size_t>(stored_bytes_), stored_) >= 0;
  }

 private:
  std::int64_t deflate(const std::uint8_t* from, std::int64_t bytes) {
    shuffle(from, bytes, rows_.element_bytes, shuffled_.data());
    auto size = static_cast<uLongf>(packed_.size());
    compress2(packed_.data(), &size, shuffled_.data(), static_cast<uLong>(bytes),
              static_cast<int>(rows_.level));
    return static_cast<std::int64_t>(size);
  }

  const ChunkedRows& rows_;
  std::int64_t bytes_;
  std::vector<std::uint8_t> put_together_, shuffled_, packed_;
  const std::uint8_t* stored_ = nullptr;
  std::int64_t stored_bytes_ = 0;
  std::uint32_t filters_left_out_ = 0;
};

}  // namespace

bool write_packed(std::int64_t dataset, std::span<const unsigned long long> at, std::size_t along,
                  const ChunkedRows& rows) {
  const std::int64_t chunk_bytes = rows.rows_a_chunk * rows.row_bytes;
  const auto before = static_cast<std::int64_t>(rows.before.size()),
             bytes = static_cast<std::int64_t>(rows.data.size());
  const std::int64_t chunks = (before + bytes + chunk_bytes - 1) / chunk_bytes;
  const std::int64_t first_chunk = rows.first_row / rows.rows_a_chunk;
  std::vector<Packer> packers;
  for (std::int64_t i = 0; i < std::min(chunks, chunks_at_once); ++i) packers.emplace_back(rows);
  std::vector<hsize_t> place(at.begin(), at.end());
  for (std::int64_t first = 0; first < chunks; first += chunks_at_once) {
    const std::int64_t n = std::min(chunks_at_once, chunks - first);
#pragma omp parallel for schedule(dynamic, 1) if (n > 1)
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t begin = std::max<std::int64_t>(0, (first + i) * chunk_bytes - before);
      const std::int64_t end = std::min(bytes, (first + i + 1) * chunk_bytes - before);
      packers[i].pack(first + i == 0 ? rows.before : std::span<const std::uint8_t>{},
                      rows.data.subspan(begin, end - begin));
    }
    // HDF5 itself is called from this thread alone.
    for (std::int64_t i = 0; i < n; ++i) {
      place[along] =
          static_cast<hsize_t>(first_chunk + first + i) * static_cast<hsize_t>(rows.rows_a_chunk);
      if (!packers[i].write(dataset, place)) return false;
    }
  }
  return true;
}

}  // namespace rockfold::hdf5
