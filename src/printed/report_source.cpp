#include "src/printed/report_source.hpp"

#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/io/result_reader.hpp"

namespace rockfold {

namespace {

using hdf5::File;

constexpr double joint_kind = 0;  // FaceOrigin::Kind::joint

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::io, what, Place{path, 0, 0, {}});
}

/// One for each joint plane that bounds blocks.
std::vector<ReportSource::Pole> read_poles(const File& file) {
  const std::string blocks = "/rockfold/blocks/";
  const auto names = file.read_names("/rockfold/origins/name");
  const auto kind = file.read_numbers("/rockfold/origins/kind");
  const auto origin = read_indices(file, blocks + "face_origin", 0, kind.size());
  const auto plane = file.read_numbers(blocks + "face_plane");
  const auto normal = file.read_numbers(blocks + "face_normal");
  std::vector<ReportSource::Pole> poles;
  std::set<std::pair<double, double>> seen;
  for (std::size_t f = 0; f < origin.size(); ++f) {
    const auto o = static_cast<std::size_t>(origin[f]);
    if (kind.at(o) != joint_kind || !seen.insert({origin[f], plane.at(f)}).second) continue;
    poles.push_back({names.at(o), {normal.at(3 * f), normal.at(3 * f + 1), normal.at(3 * f + 2)}});
  }
  return poles;
}

ReportSource read(const File& file, const std::string& path) {
  ReportSource source;
  source.file = std::filesystem::path(path).filename().string();
  source.title = file.text_attribute("/rockfold", "title");
  source.command = file.text_attribute("/rockfold", "command");
  source.version = file.text_attribute("/rockfold", "version");
  source.commit = file.text_attribute("/rockfold", "commit");
  source.model = file.read_text("/rockfold/model");
  if (!file.exists("/rockfold/answer"))
    fail(path, fmt::format("holds no document of its command (`{}` ended early, or was of an older "
                           "version): there is nothing to report; run the model again",
                           source.command));
  const std::vector<double> bytes = file.read_numbers("/rockfold/answer");
  source.answer = Json::parse(std::string(bytes.begin(), bytes.end()));
  if (!source.answer.contains("setup"))
    fail(path, fmt::format("was made by rockfold {} ({}), which did not store what a report tells "
                           "of; run the model again",
                           source.version, source.commit));
  source.poles = read_poles(file);
  return source;
}

}  // namespace

ReportSource read_report_source(const std::string& path) {
  const auto file = open_result(path);
  try {
    return read(*file, path);
  } catch (const Json::exception& error) {
    fail(path, fmt::format("is damaged ({})", error.what()));
  } catch (const std::out_of_range&) {
    fail(path, "is damaged (arrays that do not fit together)");
  }
}

}  // namespace rockfold
