// How a long phase tells how far it is. The default tells nobody; the terminal bar is in src/report.
#pragma once

#include <cstdint>
#include <string_view>

namespace rockfold {

/// Receives the progress of one phase after another. Never called by two threads at a time.
class Progress {
 public:
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  virtual ~Progress() = default;

  /// A phase starts: `total` units of `unit` ("cells", "steps", …); 0 = unknown.
  virtual void begin(std::string_view phase, std::int64_t total, std::string_view unit) {
    (void)phase, (void)total, (void)unit;
  }
  virtual void done(std::int64_t count) { (void)count; }
  virtual void end() {}
};

}  // namespace rockfold
