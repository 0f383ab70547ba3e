// What the program does not use it does not keep.
#pragma once

#include "src/base/types.hpp"

namespace rockfold {

/// Gives memory that was freed back to the system. The threads' heaps keep it otherwise, each for itself: after cutting a
/// million blocks that is a third of all.
void return_free_memory();

/// Bytes of a process that lie in memory; 0 where there is no such process (any more). `process` 0: this one.
Real resident_bytes(int process = 0);

}  // namespace rockfold
