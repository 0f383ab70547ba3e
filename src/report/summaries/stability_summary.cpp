// The summary of the whole mass: its factor, what proves it, and how blocks move at it.
#include <algorithm>
#include <cmath>

#include <fmt/ranges.h>

#include "src/base/vector.hpp"
#include "src/report/progress_line.hpp"
#include "src/report/stability_words.hpp"
#include "src/report/summaries/keyblock_words.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {

namespace {

std::string bound_text(const StabilityReport& report) {
  const Bound& bound = report.bound;
  if (report.mass.bodies.empty()) return "none: no block may move";
  if (std::isinf(bound.factor)) return "none: the mass stands without friction and cohesion";
  if (bound.factor >= most_factor)
    return fmt::format("more than {:g}: forces that press on each other hold the mass",
                       most_factor);
  if (bound.factor == 0) return "0: no strength of the joints balances the mass";
  return fmt::format("{:.4f}  ({:.6f} to {:.6f}{}): the upper limit of any factor of safety",
                     bound.factor, bound.below.factor, bound.above.factor,
                     report.bound_proved ? " proved" : ", not proved");
}

std::string sliding_text(const Sliding& sliding) {
  switch (sliding.answer) {
    case Sliding::Answer::stands:
      return "none: nothing moves";
    case Sliding::Answer::falls:
      return "0: it moves at any strength that was tried, without dilation";
    case Sliding::Answer::not_found:
      return "not found: the mass on springs came to no rest and to no steady motion; try "
             "[reduction]";
    case Sliding::Answer::fails:
      break;
  }
  return fmt::format("{:.4f}  without dilation; {}{}", sliding.factor,
                     sliding.proved() ? "a state of collapse, proved" : "not proved",
                     sliding.stands_below ? "" : "; the whole mass may fail at less");
}

std::string moving_table(const StabilityReport& report, const std::vector<MovingBlock>& moving,
                         const BlockArrays& blocks, std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < std::min(most, moving.size()); ++k) {
    const MovingBlock& m = moving[k];
    const Index b = report.mass.bodies[m.body].block;
    Vec3 v = m.velocity;
    for (Real& x : v) x = std::round(1e3 * x) / 1e3 + 0.0;  // no "-0.000"
    std::vector<std::string> pushed_by;
    for (const Index other : m.pushed_by)
      pushed_by.push_back(fmt::format("{}", report.mass.bodies[other].block + 1));
    rows.push_back({fmt::format("{}", b + 1), fixed_text(blocks.volume[b], 2),
                    fmt::format("{:.3f} {:.3f} {:.3f}", v[0], v[1], v[2]),
                    fixed_text(norm(m.velocity), 3), fixed_text(norm(m.spin), 3),
                    joined_names(m.slides_on), joined_names(m.parts_from),
                    joined_names(pushed_by)});
  }
  std::string text = table_text({{"block", ""},
                                 {"volume", "m3"},
                                 {"velocity", "x y z"},
                                 {"speed", "of the fastest"},
                                 {"turns", "rad/m"},
                                 {"slides on", "", true},
                                 {"parts from", "", true},
                                 {"pushed by", "", true}},
                                rows);
  if (moving.size() > most)
    text += fmt::format("  … and {} more: --json lists them\n", moving.size() - most);
  return text;
}

}  // namespace

std::string stability_summary(const StabilityReport& report, const BlockArrays& blocks,
                              std::size_t most) {
  std::string text =
      fact("blocks that may move",
           fmt::format("{}, which touch in {} area{}", report.mass.bodies.size(),
                       report.mass.contacts.size(), report.mass.contacts.size() == 1 ? "" : "s"));
  text += fact("bound", bound_text(report));
  if (report.mass.bodies.empty()) return text;
  text += fact("sliding", sliding_text(report.sliding));
  const bool slides = !report.at_sliding.empty();
  const std::vector<MovingBlock>& moving = slides ? report.at_sliding : report.at_bound;
  if (moving.empty()) return text;
  text += fact(slides ? "how it fails" : "at the bound", motion_words(report.mass, moving));
  return text + "\n" + moving_table(report, moving, blocks, most);
}

}  // namespace rockfold
