#pragma once

namespace rockfold {

/// How many threads host and kernels use. 0 = OMP_NUM_THREADS, or as many as the machine gives us: its cores, or
/// fewer where a container may use only some of their time. To be called before host or kernels start.
void use_threads(int threads);

}  // namespace rockfold
