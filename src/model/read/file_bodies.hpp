// The closed bodies of one mesh file, of which bodies = "separate" makes a solid each.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

struct FileBody {
  std::string name;  ///< as the file calls it; empty: it does not
  std::shared_ptr<const TriangleSurface> surface;
};

/// Reads them in the order of the file (host/files/load_files.hpp: file_bodies). `place` names the file and the key that names it.
/// Throws Error(model or io).
using BodyReader = std::function<std::vector<FileBody>(const Place& place)>;

}  // namespace rockfold
