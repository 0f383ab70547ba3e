// Seeds that once failed in a long run: run each time. A change of a generator makes its list void; write down what the model was.
#pragma once

#include <utility>
#include <vector>

namespace rockfold::test::corpus {

/// Of nasty_model.
inline const std::vector<unsigned> nasty_seeds{};

/// Kind and seed of nasty_model_of_kind.
inline const std::vector<std::pair<int, unsigned>> nasty_kind_seeds{};

/// Of terrain_model.
inline const std::vector<unsigned> terrain_seeds{};

/// Of mesh_model.
inline const std::vector<unsigned> mesh_seeds{};

}  // namespace rockfold::test::corpus
