// Which cells are one body: over glue wider than the tolerance, and through slivers (decision 5, rules 5 and 6).
#pragma once

#include <vector>

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// Marks the fragments of glue narrower than the tolerance. Returns those between wide cells that are within a factor 100 of it.
std::vector<Index> mark_narrow_glue(Complex& complex);

/// m: of glue or a joint. Of those that are no doubt wide some value from doubt_factor · tolerance on.
Real width_of(const Complex& complex, const Fragment& f);

/// [cells] the part that each wide cell belongs to, by its smallest cell; slivers: none.
std::vector<Index> wide_parts(const Complex& complex);

/// Gives each sliver to a part that has one beside it: over its largest piece of glue, else of a joint. Equal areas are told
/// apart by where the parts' centroids are. O(areas of slivers), times how many slivers lie behind each other.
void give_slivers(const Complex& complex, std::vector<Index>& part);

}  // namespace rockfold
