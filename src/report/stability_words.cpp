#include "src/report/stability_words.hpp"

#include <algorithm>

#include <fmt/ranges.h>

namespace rockfold {

namespace {

/// "blocks 12, 14"
std::string blocks_text(const RigidMass& mass, const std::vector<Index>& bodies) {
  std::vector<std::string> ids;
  for (const Index b : bodies) ids.push_back(fmt::format("{}", mass.bodies[b].block + 1));
  return fmt::format("block{} {}", ids.size() == 1 ? "" : "s", fmt::join(ids, ", "));
}

/// "blocks 12, 14 push block 9 out along bedding"
std::string motion_text(const RigidMass& mass, const MovingBlock& m) {
  const std::string own = blocks_text(mass, {m.body});
  const std::string on = m.slides_on.empty() ? "" : fmt::format("{}", fmt::join(m.slides_on, ", "));
  if (!m.pushed_by.empty())
    return fmt::format("{} push{} {} {}{}", blocks_text(mass, m.pushed_by),
                       m.pushed_by.size() == 1 ? "es" : "", own, m.turns ? "over" : "out",
                       on.empty() ? "" : " along " + on);
  if (on.empty()) return fmt::format("{} {}", own, m.turns ? "turns freely" : "falls");
  return fmt::format("{} {} on {}", own, m.turns ? "turns" : "slides", on);
}

}  // namespace

std::string motion_words(const RigidMass& mass, const std::vector<MovingBlock>& moving) {
  constexpr std::size_t most = 3;
  std::vector<std::string> told;
  for (std::size_t k = 0; k < std::min(most, moving.size()); ++k)
    told.push_back(motion_text(mass, moving[k]));
  const std::size_t more = moving.size() - told.size();
  return fmt::format(
      "{}{}", fmt::join(told, "; "),
      more > 0 ? fmt::format("; and {} more move{}", more, more == 1 ? "s" : "") : "");
}

std::string whole_mass_words(const StabilityReport& report) {
  const Sliding& sliding = report.sliding;
  const std::string how =
      report.at_sliding.empty() ? "" : ": " + motion_words(report.mass, report.at_sliding);
  switch (sliding.answer) {
    case Sliding::Answer::stands:
      return "stands without friction and cohesion";
    case Sliding::Answer::falls:
      return "fails at any strength" + how;
    case Sliding::Answer::not_found:
      return fmt::format("no factor of safety found; it is {:.2f} at most", report.bound.factor);
    case Sliding::Answer::fails:
      break;
  }
  const bool stands = sliding.factor >= 1;
  return fmt::format("{}: factor of safety {:.2f}{}{}", stands ? "stands" : "fails", sliding.factor,
                     how, sliding.stands_below ? "" : " (it may fail at less)");
}

}  // namespace rockfold
