#include "src/report/sets_model.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rockfold {

namespace {

/// JSON's escapes are TOML's too.
std::string quoted_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return text;
}

std::string spacing_line(const MeasuredSet& set) {
  if (!set.spacing) return "# spacing = 1.0  # m, must be said: the table does not tell it\n";
  if (std::isnan(set.spacing->normal))
    return fmt::format(
        "# spacing = {:.3g}  # m, must be said: the mean along a line of unknown direction\n",
        set.spacing->along);
  const std::string line = fmt::format(
      "spacing = {{distribution = \"exponential\", mean = {:.4g}}}", set.spacing->normal);
  return set.spacing->blind
             ? fmt::format("# {}  # m, must be said: the scanline lies along the set\n", line)
             : fmt::format("{}  # m, of {} intervals\n", line, set.spacing->intervals);
}

std::string set_text(const MeasuredSet& set) {
  std::string text =
      fmt::format("\n[[joint_set]]\nname = {}\ndip = {:.2f}\ndip_direction = {:.2f}\n",
                  quoted_text(set.name), set.dip, set.dip_direction);
  if (set.extents > 0)
    text += fmt::format("# mean extent {:.3g} m of {} joints\n", set.mean_extent, set.extents);
  text += "[joint_set.random]\n";
  text += std::isfinite(set.fisher.kappa)
              ? fmt::format("fisher_kappa = {:.4g}  # {} joints\n", set.fisher.kappa, set.count)
              : fmt::format("# fisher_kappa is not known: {} joints\n", set.count);
  return text + spacing_line(set);
}

}  // namespace

std::string sets_model(const SurveyReport& report, const std::string& table) {
  std::string text = fmt::format(
      "{}{}: {} of {} joints belong to one.\n", sets_model_begins, one_line(table),
      report.poles.size() - static_cast<std::size_t>(std::count(report.set_of_row.begin(),
                                                                report.set_of_row.end(), none)),
      report.poles.size());
  for (const MeasuredSet& set : report.sets) text += set_text(set);
  return text;
}

}  // namespace rockfold
