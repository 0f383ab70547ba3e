#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "src/io/hdf5_file.hpp"
#include "src/io/native_arrays.hpp"
#include "src/io/result_file.hpp"

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

std::int64_t total(const File& file, const char* name) {
  return file.has_attribute("/rockfold/totals", name)
             ? static_cast<std::int64_t>(file.number_attribute("/rockfold/totals", name))
             : 0;
}

/// Rows of one of the file's own data sets; 0 if it is not there.
std::int64_t rows(const File& file, const std::string& path) {
  return file.exists(path) ? file.shape(path).at(0) : 0;
}

void read_states(const File& file, ResultInfo& info) {
  if (!file.exists("/rockfold/states")) return;
  info.time = file.read_numbers("/rockfold/states/time");
  for (const double step : file.read_numbers("/rockfold/states/step"))
    info.step.push_back(static_cast<Index>(step));
  // The time is written last: what comes after it is of a state that was never whole.
  info.step.resize(std::min(info.step.size(), info.time.size()));
}

ResultInfo read(const File& file) {
  ResultInfo info;
  info.title = file.text_attribute("/rockfold", "title");
  info.command = file.text_attribute("/rockfold", "command");
  info.version = file.text_attribute("/rockfold", "version");
  info.commit = file.text_attribute("/rockfold", "commit");
  info.units = file.text_attribute("/rockfold", "units");
  info.model_text = file.read_text("/rockfold/model");
  info.blocks = total(file, "blocks");
  info.faces = total(file, "faces");
  info.vertices = total(file, "vertices");
  info.joint_faces = rows(file, "/VTKHDF/Joints/CellData/joint");
  if (file.has_attribute("/rockfold/totals", "volume"))
    info.volume = file.number_attribute("/rockfold/totals", "volume");
  info.elements = total(file, "elements");
  info.pieces = total(file, "pieces");
  info.covers = total(file, "physical_covers");
  info.block_theory = file.exists("/rockfold/block_theory");
  read_states(file, info);
  // Not the virtual data sets of /xdmf: they hold nothing of their own, and there are as many as
  // states.
  for (auto& dataset : file.datasets({"/VTKHDF", "/rockfold", "/xdmf/connectivity"}))
    info.datasets.push_back({std::move(dataset.path), std::move(dataset.type),
                             std::move(dataset.shape), dataset.bytes});
  return info;
}

}  // namespace

ResultInfo read_result_info(const std::string& path) {
  check_file(path);
  std::unique_ptr<File> file;
  try {
    file = std::make_unique<File>(path, File::Mode::read, path);
  } catch (const Error& error) {
    fail(path, fmt::format("is damaged or cut short ({})", error.what()));
  }
  check_format(*file, path);
  try {
    ResultInfo info = read(*file);
    info.file_bytes = static_cast<std::int64_t>(std::filesystem::file_size(path));
    return info;
  } catch (const Error& error) {
    fail(path, fmt::format("is damaged ({})", error.what()));
  }
}

}  // namespace rockfold
