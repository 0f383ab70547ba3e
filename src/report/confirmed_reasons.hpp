// Why a block did otherwise than block theory says, most likely.
#pragma once

#include <vector>

#include "src/report/confirmed.hpp"

namespace rockfold {

enum class Reason { held, batch, time, rock, loads, in_situ_stress, strength, neighbours, support };

/// Whether block theory, of a model with [support], counts what acts in none of its steps.
bool has_other_loads(const Model& model);

class Reasons {
 public:
  explicit Reasons(const RunReport& report);
  /// The first that applies, from what certainly is one to what may be.
  Reason of(const Confirmed& c) const;

 private:
  Reason of_stay(const Confirmed& c) const;
  Reason of_motion(const Confirmed& c) const;
  bool other_loads() const;
  bool has_tensile_strength() const;
  bool slips_once_moved(Index block) const;

  const RunReport& report_;
  std::vector<std::uint8_t> beside_loose_rock_;  ///< [B] 1: beside an infinite block that moved
};

constexpr const char* reason_name(Reason reason) {
  switch (reason) {
    case Reason::held:
      return "held";
    case Reason::batch:
      return "batch";
    case Reason::time:
      return "time";
    case Reason::rock:
      return "rock";
    case Reason::loads:
      return "loads";
    case Reason::in_situ_stress:
      return "in_situ_stress";
    case Reason::strength:
      return "strength";
    case Reason::neighbours:
      return "neighbours";
    case Reason::support:
      return "support";
  }
  return "";
}

}  // namespace rockfold
