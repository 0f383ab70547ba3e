#pragma once

namespace rockfold {

/// How many threads host and kernels use. 0 = OMP_NUM_THREADS, or as many as the machine gives us: its cores, or
/// fewer where a container may use only some of their time. To be called before host or kernels start.
void use_threads(int threads);

/// Starts the program once more with the setting that keeps threads from burning time while they wait, unless the
/// user has chosen one. OpenMP reads such settings before main() and never again. To be called first of all.
void keep_waits_short(char** argv);

}  // namespace rockfold
