// What src/web built, compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rockfold {

struct PageBundle {
  std::span<const std::uint8_t> gzip;  ///< empty: built without npm
  std::size_t size = 0;                ///< of the text
};

/// The page of `view` without data.
PageBundle page_bundle();
/// The script that draws a report's views.
PageBundle views_bundle();

}  // namespace rockfold
