// Many models drawn from seeds, a check of each, and a report that lets a failure be reproduced.
#pragma once

#include <functional>
#include <string>

#include "tests/cut/oracles/cutting_rules.hpp"

namespace rockfold::test {

struct SeededCase {
  std::string kind;  ///< failures are counted by kind and rule
  Faults faults;
  std::function<std::string()>
      details;  ///< asked for the first failures alone: the reduced model, …
};

/// `normal`, or the number in the environment variable.
unsigned from_environment(const char* variable, unsigned normal);

/// Checks the seeds first … first + count − 1 and goes on after a failure. Prints the first five with their details and
/// counts all. A signal that ends the program (a crash, or a seed that takes minutes) prints the seed at work.
void check_seeds(unsigned first, unsigned count, const std::function<SeededCase(unsigned)>& check);

}  // namespace rockfold::test
