// A model and the files that it names, as one: what is wrong in any of them is told together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/model/read/read_model.hpp"

namespace rockfold {

/// read_model and load_files. Throws what they throw; where the model is wrong, the files that it names rightly are read all the
/// same, and what is wrong with them follows. `text`: what stands in the model file, where it is known.
Model read_whole_model(const std::string& path, const std::optional<std::string>& text,
                       const std::vector<std::string>& overrides, Purpose purpose);

}  // namespace rockfold
