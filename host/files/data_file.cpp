#include "host/files/data_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

namespace rockfold {

namespace {

[[noreturn]] void fail(const Place& place, const std::string& message) {
  throw Error(ErrorKind::io, message, place);
}

}  // namespace

std::string read_data_file(const Place& place) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto status = fs::status(place.file, error);
  if (!fs::exists(status))
    fail(place, "cannot be opened: " +
                    (error ? error.message() : std::generic_category().message(ENOENT)));
  if (fs::is_directory(status)) fail(place, "cannot be read: it is a folder");
  // A device or a pipe may never end.
  if (!fs::is_regular_file(status)) fail(place, "cannot be read: it is no regular file");
  const auto size = fs::file_size(place.file, error);
  if (error) fail(place, "cannot be read: " + error.message());
  if (size == 0) throw Error(ErrorKind::model, "is empty", place);
  std::ifstream stream(place.file, std::ios::binary);
  if (!stream) fail(place, "cannot be opened: " + std::generic_category().message(errno));
  std::string bytes;
  try {
    bytes.resize(size);
  } catch (const std::bad_alloc&) {
    fail(place, "is too large for the memory: " + std::to_string(size) + " bytes");
  }
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size))
    fail(place, "cannot be read to its end");
  return bytes;
}

}  // namespace rockfold
