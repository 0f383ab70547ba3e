#include "src/sweep/sweep_events.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace rockfold::sweep {

namespace {

/// Three values (Kleene 1938): `and` is the least of its parts, `or` the greatest. So a null counts only where it decides.
enum class Truth { no, unknown, yes };

bool compared(const Condition::Comparison& comparison, Real value) {
  using Operator = Condition::Operator;
  switch (comparison.op) {
    case Operator::more:
      return value > comparison.number;
    case Operator::at_least:
      return value >= comparison.number;
    case Operator::less:
      return value < comparison.number;
    case Operator::at_most:
      return value <= comparison.number;
    case Operator::equal:
      return value == comparison.number;
    case Operator::other:
      return value != comparison.number;
  }
  return false;
}

Truth truth_of(const Condition::Comparison& comparison, Real value) {
  if (std::isnan(value)) return Truth::unknown;
  return compared(comparison, value) ? Truth::yes : Truth::no;
}

/// [rows]
std::vector<Truth> truths(const SweepTable& table, const Condition& when) {
  std::vector<Truth> any(table.rows.size(), Truth::no);
  for (const auto& comparisons : when.any_of_all) {
    std::vector<Truth> all(table.rows.size(), Truth::yes);
    for (const auto& comparison : comparisons) {
      const std::vector<Real> value = numbers_of(table, comparison.name);
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = std::min(all[i], truth_of(comparison, value[i]));
    }
    for (std::size_t i = 0; i < any.size(); ++i) any[i] = std::max(any[i], all[i]);
  }
  return any;
}

bool is_told(const SweepTable& table, const Condition& when) {
  for (const auto& comparisons : when.any_of_all)
    for (const auto& comparison : comparisons)
      if (!is_answered(table, comparison.name)) return false;
  return true;
}

}  // namespace

std::vector<int> happened(const SweepTable& table, const Event& event) {
  const std::vector<Truth> truth = truths(table, event.when);
  const bool told = is_told(table, event.when);
  std::vector<int> counted(truth.size(), -1);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!told || table.rows[i].status != "done") continue;
    if (truth[i] != Truth::unknown)
      counted[i] = truth[i] == Truth::yes ? 1 : 0;
    else if (event.null == NullMeans::did_not_happen)
      counted[i] = 0;
  }
  return counted;
}

EventCount count_event(const SweepTable& table, const Event& event) {
  const std::vector<int> all = happened(table, event);
  const auto met = static_cast<Index>(std::count(all.begin(), all.end(), 1));
  const auto not_met = static_cast<Index>(std::count(all.begin(), all.end(), 0));
  EventCount count{chance_of(met, met + not_met), 0, is_told(table, event.when)};
  const std::vector<Truth> truth = truths(table, event.when);
  for (std::size_t i = 0; i < truth.size(); ++i)
    count.null_runs += table.rows[i].status == "done" && truth[i] == Truth::unknown;
  return count;
}

std::string null_note(const SweepTable& table, const Event& event) {
  const EventCount count = count_event(table, event);
  const Index done = count_of(table, "done");
  if (done > 0 && !count.told) return "a result that it compares is in no run's document";
  if (count.null_runs == 0) return "";
  const bool left_out = event.null == NullMeans::left_out;
  return fmt::format(
      "{} of {} runs have no number there (null): {}", count.null_runs, done,
      left_out ? "left out (null = \"exclude\")" : "counted as not happened (null = \"false\")");
}

}  // namespace rockfold::sweep
