// The summary of the whole mass: its factor, what proves it, and how blocks move at it.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/base/vector.hpp"
#include "src/report/progress_line.hpp"
#include "src/report/summaries/keyblock_words.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {

namespace {

std::string bound_text(const StabilityReport& report) {
  const Bound& bound = report.bound;
  if (report.mass.bodies.empty()) return "none: no block may move";
  if (std::isinf(bound.factor)) return "none: the mass stands without friction and cohesion";
  if (bound.factor == 0) return "0: no strength of the joints balances the mass";
  return fmt::format(
      "{:.4f}  ({:.6f} to {:.6f} proved): no factor of safety but its upper limit; without "
      "dilation the mass may fail at less",
      bound.factor, bound.below.factor, bound.above.factor);
}

std::string moving_table(const StabilityReport& report, const BlockArrays& blocks,
                         std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < std::min(most, report.moving.size()); ++k) {
    const MovingBlock& m = report.moving[k];
    const Index b = report.mass.bodies[m.body].block;
    const Vec3& v = m.velocity;
    rows.push_back({fmt::format("{}", b + 1), fixed_text(blocks.volume[b], 2),
                    fmt::format("{:.3f} {:.3f} {:.3f}", v[0], v[1], v[2]), fixed_text(norm(v), 3),
                    fixed_text(norm(m.spin), 3), joined_names(m.slides_on),
                    joined_names(m.parts_from)});
  }
  std::string text = table_text({{"block", ""},
                                 {"volume", "m3"},
                                 {"direction", "x y z"},
                                 {"speed", "of the fastest"},
                                 {"turns", "rad/m"},
                                 {"slides on", "", true},
                                 {"parts from", "", true}},
                                rows);
  if (report.moving.size() > most)
    text += fmt::format("  … and {} more: --json lists them\n", report.moving.size() - most);
  return text;
}

}  // namespace

std::string stability_summary(const StabilityReport& report, const BlockArrays& blocks,
                              std::size_t most) {
  std::string text = fact("blocks that may move",
                          fmt::format("{}, which touch in {} areas", report.mass.bodies.size(),
                                      report.mass.contacts.size()));
  text += fact("bound", bound_text(report));
  if (report.moving.empty()) return text;
  text += fact("at it", report.moving.size() == 1
                            ? "one block moves:"
                            : fmt::format("{} blocks move at once:", report.moving.size()));
  return text + "\n" + moving_table(report, blocks, most);
}

}  // namespace rockfold
