#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "src/io/hdf5/hdf5_file.hpp"
#include "src/io/result_file.hpp"
#include "src/io/result_reader.hpp"

namespace rockfold {
namespace {

using hdf5::File;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::io, what, Place{path, 0, 0, {}});
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
  if (file.exists("/rockfold/states/hash"))
    for (const std::int64_t hash : file.read_integers("/rockfold/states/hash"))
      info.hash.push_back(static_cast<std::uint64_t>(hash));
  info.hash.resize(std::min(info.hash.size(), info.time.size()));
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
  const std::unique_ptr<File> file = open_result(path);
  try {
    ResultInfo info = read(*file);
    info.file_bytes = static_cast<std::int64_t>(std::filesystem::file_size(path));
    return info;
  } catch (const Error& error) {
    fail(path, fmt::format("is damaged ({})", error.what()));
  }
}

std::optional<std::string> read_run_document(const std::string& path) {
  const std::unique_ptr<File> file = open_result(path);
  if (!file->exists("/rockfold/run/document")) return {};
  const std::vector<std::byte> bytes = file->read_bytes("/rockfold/run/document");
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::optional<RunOrigin> read_stored_origin(const std::string& path) {
  const std::unique_ptr<File> file = open_result(path);
  if (!file->exists("/rockfold/run/origin")) return {};
  try {
    return unpacked_origin(file->read_bytes("/rockfold/run/origin"));
  } catch (const std::runtime_error& error) {
    fail(path, fmt::format("is damaged ({})", error.what()));
  }
}

}  // namespace rockfold
