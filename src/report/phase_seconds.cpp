#include "src/report/phase_seconds.hpp"

#include <algorithm>

namespace rockfold {

void PhaseClock::add(const std::string& phase, double seconds) {
  const auto known = std::find_if(seconds_.begin(), seconds_.end(),
                                  [&](const auto& p) { return p.first == phase; });
  if (known == seconds_.end())
    seconds_.emplace_back(phase, seconds);
  else
    known->second += seconds;
}

PhaseSeconds PhaseClock::seconds() const {
  auto all = seconds_;
  all.emplace_back("total", total_.seconds());
  return all;
}

}  // namespace rockfold
