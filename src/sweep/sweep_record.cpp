#include "src/sweep/sweep_record.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace rockfold::sweep {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(ErrorKind kind, const std::string& path, const std::string& what) {
  throw Error(kind, what, Place{path, 0, 0, ""});
}

Json json_of(const Identity& identity) {
  return {{"sweep", 1},
          {"model", identity.model},
          {"command", identity.command},
          {"parameters", identity.keys},
          {"runs", identity.runs},
          {"values", identity.values},
          {"results", identity.paths}};
}

Json json_of(const RunRecord& run) {
  return {{"run", run.run},
          {"status", run.status},
          {"seconds", run.seconds},
          {"error", run.error},
          {"results", run.results}};
}

RunRecord record_of(const Json& json) {
  return {json.at("run").get<Index>(), json.at("status").get<std::string>(),
          json.at("seconds").get<Real>(), json.at("error").get<std::string>(),
          json.at("results").get<std::vector<std::string>>()};
}

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// "" if they are the same.
std::string difference(const Json& then, const Json& now) {
  for (const auto& [key, value] : now.items()) {
    if (then.value(key, Json()) == value) continue;
    if (key == "model" || key == "values") return "other " + key;
    return fmt::format("other {}: {} there, {} here", key, then.value(key, Json()).dump(),
                       value.dump());
  }
  return "";
}

struct Journal {
  std::vector<RunRecord> runs;
  std::int64_t whole = 0;  ///< bytes of whole lines
};

Journal read_journal(const std::string& folder, const std::string& path, const Identity& identity) {
  std::ifstream in(path, std::ios::binary);
  Journal journal;
  std::string line;
  std::set<Index> known;
  for (bool first = true; std::getline(in, line) && !in.eof(); first = false) {
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded()) break;
    if (first) {
      const std::string other =
          json.contains("sweep") ? difference(json, json_of(identity)) : "no sweep";
      if (!other.empty())
        fail(ErrorKind::usage, folder,
             "holds another sweep (" + other + "): name another folder with -o");
    } else {
      RunRecord run = record_of(json);
      if (known.insert(run.run).second) journal.runs.push_back(std::move(run));
    }
    journal.whole += static_cast<std::int64_t>(line.size()) + 1;
  }
  return journal;
}

std::string journal_of(const std::string& folder) {
  return (fs::path(folder) / "sweep.journal").string();
}

}  // namespace

std::string line_of(const RunRecord& run) {
  return line_of(json_of(run));
}

RunRecord run_from_line(const std::string& line) {
  return record_of(Json::parse(line));
}

std::string part_folder(const std::string& folder, Index part) {
  return (fs::path(folder) / "parts" / fmt::format("{:06}", part)).string();
}

std::vector<std::string> part_folders(const std::string& folder) {
  std::vector<std::string> folders;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "parts", ignored))
    folders.push_back(entry.path().string());
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::vector<RunRecord> read_runs(const std::string& folder, const Identity& identity) {
  return read_journal(folder, journal_of(folder), identity).runs;
}

SweepRecord::SweepRecord(const std::string& folder, const Identity& identity)
    : path_(journal_of(folder)) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(ErrorKind::io, folder, "cannot be made: " + error.message());
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0)
    fail(ErrorKind::io, path_, std::string("cannot be written: ") + std::strerror(errno));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    fail(ErrorKind::io, path_, "another sweep is at work in this folder");
  Journal journal = read_journal(folder, path_, identity);
  runs_ = std::move(journal.runs);
  if (ftruncate(file_, journal.whole) != 0)
    fail(ErrorKind::io, path_, std::string("cannot be written: ") + std::strerror(errno));
  if (journal.whole == 0) append(line_of(json_of(identity)));
}

SweepRecord::~SweepRecord() {
  if (file_ >= 0) close(file_);
}

void SweepRecord::append(const std::string& line) {
  const off_t before = lseek(file_, 0, SEEK_END);
  if (write(file_, line.data(), line.size()) == static_cast<ssize_t>(line.size())) return;
  const std::string why = std::strerror(errno);
  [[maybe_unused]] const int ignored = ftruncate(file_, before);
  fail(ErrorKind::io, path_, "cannot write: " + why);
}

void SweepRecord::add(const RunRecord& run) {
  append(line_of(json_of(run)));
  runs_.push_back(run);
}

}  // namespace rockfold::sweep
