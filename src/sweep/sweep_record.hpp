// What a sweep keeps in its folder, DIR/sweep.journal: one JSON document a line, appended to as runs end. The first line says what
// is varied; a line that a kill cut short is none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/sweep/sweep_spec.hpp"

namespace rockfold::sweep {

/// What a run came to.
struct RunRecord {
  Index run = 0;       ///< from 1
  std::string status;  ///< "done", "failed", "limit"
  Real seconds = 0;
  std::string error;
  /// [results] as texts of JSON: a number, a word in quotes, true, null; "" where the document has no such place.
  std::vector<std::string> results;
};

/// What makes two sweeps the same one.
struct Identity {
  std::string model;  ///< text of the model and of what overrides it
  std::string command;
  std::vector<std::string> keys;  ///< of the parameters
  std::string values;             ///< a hash of those of all runs
  Index runs = 0;
  std::vector<std::string> paths;  ///< of the results
};

/// As it stands in the journal, with its newline.
std::string line_of(const RunRecord& run);
/// Throws nlohmann::json::exception.
RunRecord run_from_line(const std::string& line);

/// The folder of one part of a sweep whose parts are computed apart.
std::string part_folder(const std::string& folder, Index part);
/// Of all parts that there are in a sweep's folder.
std::vector<std::string> part_folders(const std::string& folder);
/// What stands in the journal of a folder; nothing where there is none. Throws Error(usage) where it is of another sweep.
std::vector<RunRecord> read_runs(const std::string& folder, const Identity& identity);

class SweepRecord {
 public:
  /// Makes the folder and the journal, or goes on with those that are there. Throws Error(usage) where the folder holds another
  /// sweep, naming what differs, Error(io) where it cannot be written or another process is at work in it.
  SweepRecord(const std::string& folder, const Identity& identity);
  SweepRecord(const SweepRecord&) = delete;
  SweepRecord& operator=(const SweepRecord&) = delete;
  ~SweepRecord();

  const std::vector<RunRecord>& runs() const { return runs_; }  ///< in the order of their ends
  void add(const RunRecord& run);

 private:
  void append(const std::string& line);

  std::string path_;
  int file_ = -1;
  std::vector<RunRecord> runs_;
};

}  // namespace rockfold::sweep
