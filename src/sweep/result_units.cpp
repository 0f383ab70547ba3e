// Units of the numbers in the documents (docs/user_guide.md, JSON), by the names of their keys.
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "src/sweep/sweep_plots.hpp"

namespace rockfold::sweep {

namespace {

using Named = std::pair<std::string_view, std::string_view>;

constexpr std::array units{
    Named{"volume", "m³"},
    Named{"solid_volume", "m³"},
    Named{"keyblock_volume", "m³"},
    Named{"largest_volume", "m³"},
    Named{"failed_volume", "m³"},
    Named{"joint_area", "m²"},
    Named{"dangling_joint_area", "m²"},
    Named{"dead_end_area", "m²"},
    Named{"surface_area", "m²"},
    Named{"new_free_area", "m²"},
    Named{"free_area", "m²"},
    Named{"support_force", "N"},
    Named{"missing_force", "N"},
    Named{"sliding_force", "N"},
    Named{"driving_force", "N"},
    Named{"resisting_force", "N"},
    Named{"weight", "N"},
    Named{"force", "N"},
    Named{"reaction", "N"},
    Named{"moment", "N·m"},
    Named{"support_pressure", "Pa"},
    Named{"stress", "Pa"},
    Named{"principal_stress", "Pa"},
    Named{"von_mises", "Pa"},
    Named{"normal_stress", "Pa"},
    Named{"shear_stress", "Pa"},
    Named{"largest_displacement", "m"},
    Named{"displacement", "m"},
    Named{"moved", "m"},
    Named{"opening", "m"},
    Named{"slip", "m"},
    Named{"largest_slip", "m"},
    Named{"largest_opening", "m"},
    Named{"max_penetration", "m"},
    Named{"max_opening", "m"},
    Named{"max_slip", "m"},
    Named{"velocity", "m/s"},
    Named{"speed", "m/s"},
    Named{"acceleration", "m/s²"},
    Named{"rotation", "rad"},
    Named{"time", "s"},
    Named{"since", "s"},
};

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts{""};
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

bool is_number(const std::string& part) {
  return !part.empty() && part.find_first_not_of("-0123456789") == std::string::npos;
}

}  // namespace

std::string unit_at(const std::string& path) {
  std::vector<std::string> parts = parts_of(path);
  if (parts.front() == "energy") return "J";
  // A number of a list, and the value of what has a place beside it, have the unit of the key that holds them.
  while (parts.size() > 1 && (is_number(parts.back()) || parts.back() == "value")) parts.pop_back();
  const std::string within = parts.size() > 1 ? parts[parts.size() - 2] : std::string();
  if (within == "mobilisation" || within == "stand_up") return "";  // shares; hours
  const auto found = std::find_if(units.begin(), units.end(),
                                  [&](const Named& unit) { return unit.first == parts.back(); });
  return found == units.end() ? "" : std::string(found->second);
}

}  // namespace rockfold::sweep
