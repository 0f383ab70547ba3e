// What is said of a model that joints would cut into more blocks than a site has.
#pragma once

#include <string>

#include "src/base/types.hpp"

namespace rockfold {

struct Complex;
struct Model;

/// Throws Error(model) at the set, joints or table that most of the joints belong to: how many blocks they make, and what to do.
[[noreturn]] void ask_about_blocks(const Model& model, const Complex& complex, Real blocks);

/// "about 1,100,000": two digits, thousands parted.
std::string about_blocks(Real blocks);

}  // namespace rockfold
