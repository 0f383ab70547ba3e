#include "src/io/result_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "src/io/hdf5/native_arrays.hpp"

namespace rockfold {
namespace {

using hdf5::File;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::io, what, Place{path, 0, 0, {}});
}

/// HDF5 files start with these bytes (ours without a user block before them).
bool has_signature(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  char start[8] = {};
  in.read(start, sizeof start);
  return std::string_view(start, sizeof start) == std::string_view("\x89HDF\r\n\x1a\n", 8);
}

void check_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail(path, "no such file");
  if (error) fail(path, "cannot be read: " + error.message());
  if (status.type() != fs::file_type::regular) fail(path, "is no file");
  if (!std::ifstream(path, std::ios::binary))
    fail(path, std::string("cannot be read: ") + std::strerror(errno));
  if (!has_signature(path))
    fail(path, path.ends_with(".toml") ? "is no HDF5 file but a model: a result (.vtkhdf) is wanted"
                                       : "is no HDF5 file");
}

void check_format(const File& file, const std::string& path) {
  if (!file.exists("/rockfold") || !file.has_attribute("/rockfold", "format_version"))
    fail(path, "is an HDF5 file, but no result of Rockfold");
  const double version = file.number_attribute("/rockfold", "format_version");
  if (version > result_format_version)
    fail(path, fmt::format("has result format {}; this program reads formats up to {}", version,
                           result_format_version));
}

}  // namespace

std::unique_ptr<File> open_result(const std::string& path) {
  check_file(path);
  std::unique_ptr<File> file;
  try {
    file = std::make_unique<File>(path, File::Mode::read, path);
  } catch (const Error& error) {
    fail(path, fmt::format("is damaged or cut short ({})", error.what()));
  }
  check_format(*file, path);
  return file;
}

std::vector<Index> read_indices(const File& file, const std::string& dataset, Index least,
                                std::size_t end) {
  std::vector<Index> indices;
  for (const std::int64_t i : file.read_integers(dataset)) {
    if (i < least || i >= static_cast<std::int64_t>(end)) throw std::out_of_range(dataset);
    indices.push_back(static_cast<Index>(i));
  }
  return indices;
}

std::vector<Index> read_begins(const File& file, const std::string& dataset, std::size_t count) {
  std::vector<Index> begin = read_indices(file, dataset, 0, count + 1);
  if (begin.empty() || !std::is_sorted(begin.begin(), begin.end()))
    throw std::out_of_range(dataset);
  return begin;
}

std::vector<Vec3> read_points(const File& file, const std::string& dataset) {
  const std::vector<double> xyz = file.read_numbers(dataset);
  if (xyz.size() % 3 != 0) throw std::out_of_range(dataset);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  return points;
}

}  // namespace rockfold
