#include "src/report/stability_words.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <fmt/ranges.h>

namespace rockfold {

namespace {

/// "blocks 12, 14", of many the first four and how many more
std::string blocks_text(const RigidMass& mass, const std::vector<Index>& bodies) {
  std::vector<std::string> ids;
  constexpr std::size_t most = 4;
  for (const Index b : bodies)
    if (ids.size() < most) ids.push_back(fmt::format("{}", mass.bodies[b].block + 1));
  return fmt::format("block{} {}{}", bodies.size() == 1 ? "" : "s", fmt::join(ids, ", "),
                     bodies.size() > most ? fmt::format(" and {} more", bodies.size() - most) : "");
}

/// Blocks that go as one body, with what all of them slide on and are pushed by.
struct Group {
  std::vector<Index> bodies;  ///< sorted
  std::set<std::string> slides_on;
  std::set<Index> pushed_by;
  bool turns = false, falls = true;
};

/// In the order of their first blocks.
std::vector<Group> groups_of(const std::vector<MovingBlock>& moving) {
  std::map<Index, std::size_t> place;  // of bodies in `moving`
  for (std::size_t k = 0; k < moving.size(); ++k) place[moving[k].body] = k;
  std::vector<std::size_t> group(moving.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](std::size_t k) {
    while (group[k] != k) k = group[k] = group[group[k]];
    return k;
  };
  for (std::size_t k = 0; k < moving.size(); ++k)
    for (const Index other : moving[k].moves_with)
      if (const auto found = place.find(other); found != place.end()) {
        const std::size_t a = root(k), b = root(found->second);
        group[std::max(a, b)] = std::min(a, b);
      }
  std::map<std::size_t, Group> groups;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const MovingBlock& m = moving[k];
    Group& own = groups[root(k)];
    own.bodies.push_back(m.body);
    own.slides_on.insert(m.slides_on.begin(), m.slides_on.end());
    for (const Index other : m.pushed_by)
      if (const auto found = place.find(other);
          found == place.end() || root(found->second) != root(k))
        own.pushed_by.insert(other);
    own.turns = own.turns || m.turns;
    own.falls = own.falls && m.falls;
  }
  std::vector<Group> list;
  for (auto& [first, own] : groups) {
    std::sort(own.bodies.begin(), own.bodies.end());
    list.push_back(std::move(own));
  }
  return list;
}

/// "blocks 12, 14 push block 9 out along bedding", "blocks 3, 4 slide on bedding"
std::string motion_text(const RigidMass& mass, const Group& group) {
  const std::string own = blocks_text(mass, group.bodies);
  const std::string on = fmt::format("{}", fmt::join(group.slides_on, ", "));
  if (!group.pushed_by.empty())
    return fmt::format("{} push{} {} {}{}",
                       blocks_text(mass, {group.pushed_by.begin(), group.pushed_by.end()}),
                       group.pushed_by.size() == 1 ? "es" : "", own, group.turns ? "over" : "out",
                       on.empty() ? "" : " along " + on);
  const char* s = group.bodies.size() == 1 ? "s" : "";
  if (!on.empty()) return fmt::format("{} {}{} on {}", own, group.turns ? "turn" : "slide", s, on);
  if (group.falls && !group.turns) return fmt::format("{} fall{}", own, s);
  return fmt::format("{} {}{} freely", own, group.turns ? "turn" : "move", s);
}

}  // namespace

std::string motion_words(const RigidMass& mass, const std::vector<MovingBlock>& moving) {
  constexpr std::size_t most = 3;
  const std::vector<Group> groups = groups_of(moving);
  std::vector<std::string> told;
  std::size_t more = moving.size();
  for (std::size_t k = 0; k < std::min(most, groups.size()); ++k) {
    told.push_back(motion_text(mass, groups[k]));
    more -= groups[k].bodies.size();
  }
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
