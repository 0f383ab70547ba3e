#include "src/io/result_reader.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "src/io/native_arrays.hpp"

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
  if (!has_signature(path)) fail(path, "is no HDF5 file");
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

}  // namespace rockfold
