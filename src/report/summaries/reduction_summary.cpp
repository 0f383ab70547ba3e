// What a strength reduction found, as text.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/report/design_names.hpp"
#include "src/report/joint_strength.hpp"
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

/// The joints' strength that the factor was found with.
std::string strength_text(const RunReport& report) {
  const auto weaker = materials_that_lose_strength(report.model, report.blocks);
  if (weaker.empty()) return "found with joints that keep their strength as they slip";
  return "found with joints that lose strength at the first slip: " + strength_loss_text(weaker);
}

/// What block theory has of the least safe of the failing blocks, if it has any of them.
std::string block_theory_fact(const RunReport& report, const std::vector<Index>& failing) {
  const Keyblock* least = nullptr;
  const auto safety = [](const Keyblock& key) {
    return std::isfinite(key.factor_of_safety) ? key.factor_of_safety : 0;
  };
  for (const auto* list : {&report.keyblocks->keyblocks, &report.keyblocks->stable})
    for (const Keyblock& key : *list)
      if (std::all_of(
              key.members.begin(), key.members.end(),
              [&](Index b) { return std::binary_search(failing.begin(), failing.end(), b); }) &&
          (!least || safety(key) < safety(*least)))
        least = &key;
  if (!least) return "";
  const std::string block = "block " + block_ids(least->members);
  if (!std::isfinite(least->factor_of_safety))
    return fact("", "block theory: nothing holds " + block);
  std::string text = fmt::format("block theory has {:.2f} for {}", least->factor_of_safety, block);
  if (least->residual_factor_of_safety < least->factor_of_safety)
    text += fmt::format(", {:.2f} on joints that have slipped", least->residual_factor_of_safety);
  return fact("", text);
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
  text += fact("", strength_text(report));
  if (reduction.fails()) {
    const std::vector<Index> failing = failing_blocks(report.model, report.blocks, report.run);
    text += fact("", failing_text(failing));
    if (report.keyblocks) text += block_theory_fact(report, failing);
  }
  return text +
         fact("", fmt::format("what follows, and the result, is the motion with tan(friction) "
                              "and cohesion divided by {:.4g}",
                              reduction.shown()));
}

}  // namespace rockfold
