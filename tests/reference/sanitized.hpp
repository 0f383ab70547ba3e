// Sweeps are shorter under the sanitizers, which look for faults of memory and not of numbers and take ten times as long.
#pragma once

namespace rockfold::reference {

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// How many cases to run: `all`, or `some` under the sanitizers.
template <class Count>
constexpr Count cases(Count all, Count some) {
  return sanitized ? some : all;
}

}  // namespace rockfold::reference
