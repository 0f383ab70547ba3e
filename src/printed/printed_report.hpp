// `rockfold report`: a result as one printable HTML document that needs no network.
#pragma once

#include <cstdint>
#include <string>

namespace rockfold {

struct PrintedFacts {
  std::int64_t bytes = 0;
  bool views = false;  ///< pictures of the model are in it
};

/// Throws Error(io) where the result cannot be read (missing, not ours, of a later format, damaged), where it lacks what a report
/// tells of, and where the report cannot be written.
PrintedFacts write_report(const std::string& result, const std::string& report);

}  // namespace rockfold
