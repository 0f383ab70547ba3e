// What a strength reduction found, as text.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/report/progress_line.hpp"
#include "src/report/summaries/summary.hpp"

namespace rockfold {
namespace {

/// Ids that a line has room for.
constexpr std::size_t most_ids = 12;

std::string failing_text(const std::vector<Index>& blocks) {
  std::vector<Index> ids;
  for (std::size_t i = 0; i < std::min(blocks.size(), most_ids); ++i) ids.push_back(blocks[i] + 1);
  const std::string more =
      blocks.size() > most_ids ? fmt::format(" and {} more", blocks.size() - most_ids) : "";
  return fmt::format("it fails in {} block{}: {}{}", grouped(std::ssize(blocks)),
                     blocks.size() == 1 ? "" : "s", fmt::join(ids, ", "), more);
}

}  // namespace

std::string bounds_text(const Reduction& reduction) {
  const auto stands = reduction.stands(), fails = reduction.fails();
  std::string text = "is";
  if (stands) text += fmt::format(" at least {:.4g}", *stands);
  if (stands && fails) text += " and";
  if (fails) text += fmt::format(" below {:.4g}", *fails);
  return text;
}

std::string search_summary(const Reduction& reduction) {
  const std::size_t trials = reduction.trials.size();
  return fact("factor of safety",
              trials == 0 ? "not known: the search ended before its first trial"
                          : fmt::format("the search was not finished: it {} ({} trial{})",
                                        bounds_text(reduction), trials, trials == 1 ? "" : "s"));
}

std::string reduction_summary(const RunReport& report) {
  const Reduction& reduction = *report.reduction;
  const auto factor = reduction.factor();
  const std::size_t trials = reduction.trials.size();
  std::string text =
      fact("factor of safety", (factor ? fmt::format("{:.4g}, by strength reduction: it ", *factor)
                                       : std::string("outside of reduction.factors: it ")) +
                                   bounds_text(reduction) +
                                   fmt::format(" ({} trial{})", trials, trials == 1 ? "" : "s"));
  if (reduction.fails())
    text += fact("", failing_text(failing_blocks(report.model, report.blocks, report.run)));
  return text +
         fact("", fmt::format("what follows, and the result, is the motion with tan(friction) "
                              "and cohesion divided by {:.4g}",
                              reduction.shown()));
}

}  // namespace rockfold
