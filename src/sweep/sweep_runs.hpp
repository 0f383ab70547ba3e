// The runs of a sweep: what each is started with, and what it came to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/app/command_line.hpp"
#include "src/sweep/processes/run_pool.hpp"
#include "src/sweep/sweep_record.hpp"
#include "src/sweep/sweep_spec.hpp"

namespace rockfold::sweep {

/// What is left of a run that has ended.
enum class Left : std::uint8_t { nothing, answer };

class SweepRuns {
 public:
  /// Draws the values. Throws Error where the model cannot be read or does not have what the keys name: else every run would fail with
  /// the same words.
  SweepRuns(const Options& options, const SweepSpec& spec, std::string folder);

  const std::vector<std::vector<std::string>>& values() const {
    return values_;
  }  ///< [runs][parameters]
  const Identity& identity() const { return identity_; }

  Job job_of(Index run) const;
  RunRecord outcome(const Ended& end) const;
  /// Removes what a run wrote, or all but its document and its log.
  void clear(Index run, Left left) const;

 private:
  std::string stem_of(Index run) const;

  const Options& options_;
  const SweepSpec& spec_;
  std::string folder_;
  std::vector<std::vector<std::string>> values_;
  Identity identity_;
};

}  // namespace rockfold::sweep
