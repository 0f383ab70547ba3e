// What of a model a stage of the program uses.
#pragma once

#include <string>
#include <vector>

namespace rockfold {

/// Keys as "material.density"; "traction" means all keys of [[traction]]. A key that no stage of a command names does not
/// act in that command, and the user is told so.
struct StageKeys {
  std::string stage;  ///< "key blocks"; as messages say where something acts
  std::vector<std::string> keys;

  bool uses(const std::string& path) const {
    for (const std::string& key : keys)
      if (path.starts_with(key) && (path.size() == key.size() || path[key.size()] == '.'))
        return true;
    return false;
  }
};

}  // namespace rockfold
