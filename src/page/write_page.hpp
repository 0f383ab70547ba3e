// `rockfold view`: a result as one HTML page that opens from the file system and needs no network.
#pragma once

#include <string>

#include "src/base/types.hpp"

namespace rockfold {

struct PageChoice {
  Index every = 1;            ///< shows each N-th stored state, and the last
  bool surface_only = false;  ///< leaves out blocks all of whose faces lie in joints
};

/// What was written.
struct PageFacts {
  std::int64_t bytes = 0;
  Index blocks = 0, shown_blocks = 0, triangles = 0, states = 0;
};

/// Whether this program was built with the page's script (needs npm).
bool has_page();

/// Throws Error(io) where the result cannot be read (missing, not ours, of a later format, damaged) or is too large for a
/// page, and where the page cannot be written; Error(usage) where the program has no page.
PageFacts write_page(const std::string& result, const std::string& page, const PageChoice& choice);

}  // namespace rockfold
