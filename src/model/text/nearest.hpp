// Suggestions for mistyped words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rockfold {

/// The candidate that `word` was probably meant to be, or "": at most a third of its letters (but
/// always one) are wrong, missing, superfluous or swapped with a neighbour; else the first
/// candidate that it begins, or of whose parts between '_' it is one. Case is ignored.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// `, did you mean "x"?` if a candidate is near; else `; <these>: a, b, c` (at most 20), or "" if
/// there are none.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view these);

}  // namespace rockfold
