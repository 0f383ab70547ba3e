// What a device is asked for, as Kokkos tells its tools: for tests and benchmarks.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace rockfold::device {

struct Launches {
  std::map<std::string, std::int64_t>
      kernels;              ///< by their labels; short loops on processors are none
  std::int64_t copies = 0;  ///< of arrays

  std::int64_t count(const std::string& label) const;
};

/// Counts while it lives; one at a time. Other tools do not hear of these launches.
class LaunchCounter {
 public:
  LaunchCounter();
  ~LaunchCounter();
  LaunchCounter(const LaunchCounter&) = delete;
  LaunchCounter& operator=(const LaunchCounter&) = delete;

  const Launches& seen() const;
};

}  // namespace rockfold::device
