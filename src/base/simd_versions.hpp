// What the inner loops on a core are compiled with: see kernels/operator/simd.hpp.
#pragma once

// Function versions are chosen when the program starts, before the sanitizers are ready: not both.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ROCKFOLD_SIMD_VERSIONS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ROCKFOLD_SIMD_VERSIONS
#endif

// What is written never overlaps what is read.
#if defined(__clang__)
#define ROCKFOLD_NO_ALIAS _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define ROCKFOLD_NO_ALIAS _Pragma("GCC ivdep")
#else
#define ROCKFOLD_NO_ALIAS
#endif
