#include "src/page/page_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rockfold {

namespace {

using hdf5::File;

const std::string group = "/rockfold/contacts/";
const std::string counts = "/rockfold/states/contact_count";

/// Where the points of each stored state begin. [S+1]
std::vector<std::int64_t> begins(const File& file) {
  std::vector<std::int64_t> begin{0};
  for (const double count : file.read_numbers(counts))
    begin.push_back(begin.back() + static_cast<std::int64_t>(count));
  return begin;
}

/// What an array of /rockfold/contacts has for these states.
std::vector<float> of_states(const File& file, const std::string& name,
                             const std::vector<std::int64_t>& begin,
                             const std::vector<Index>& states) {
  std::vector<float> values;
  for (const Index s : states) {
    const std::int64_t first = begin.at(static_cast<std::size_t>(s));
    const std::int64_t rows = begin.at(static_cast<std::size_t>(s) + 1) - first;
    if (rows == 0) continue;
    const std::vector<float> some = file.read_rows(group + name, first, rows);
    values.insert(values.end(), some.begin(), some.end());
  }
  return values;
}

/// In double precision until the model's middle is the origin.
std::vector<float> places(const File& file, const std::vector<std::int64_t>& begin,
                          const std::vector<Index>& states, const Vec3& origin) {
  const std::vector<double> all = file.read_numbers(group + "place");
  std::vector<float> some;
  for (const Index s : states)
    for (auto i = 3 * begin.at(static_cast<std::size_t>(s));
         i < 3 * begin.at(static_cast<std::size_t>(s) + 1); ++i)
      some.push_back(static_cast<float>(all.at(static_cast<std::size_t>(i)) -
                                        origin[static_cast<std::size_t>(i % 3)]));
  return some;
}

template <typename T>
std::vector<T> whole_numbers(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

void add_levels(const std::string& name, const std::vector<float>& values, PageArrays& arrays) {
  constexpr float most = 1000;
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) return;
  std::vector<std::uint16_t> all;
  for (const float v : values) {
    const float share = high > low ? (v - low) / (high - low) : 0;
    all.push_back(std::isfinite(v) ? static_cast<std::uint16_t>(std::lround(share * most)) : 65535);
  }
  arrays.add(name + "_range", std::vector<float>{low, high});
  arrays.add_smooth(name, all);
}

std::int64_t contact_points(const File& file, const std::vector<Index>& states) {
  if (!file.exists(counts)) return 0;
  const auto begin = begins(file);
  std::int64_t sum = 0;
  for (const Index s : states)
    sum += begin.at(static_cast<std::size_t>(s) + 1) - begin.at(static_cast<std::size_t>(s));
  return sum;
}

void add_contacts(const File& file, const std::vector<Index>& states, const Vec3& origin,
                  PageArrays& arrays) {
  if (contact_points(file, states) == 0) return;
  const auto begin = begins(file);
  const auto read = [&](const std::string& name) { return of_states(file, name, begin, states); };
  std::vector<std::uint32_t> count;
  for (const Index s : states)
    count.push_back(static_cast<std::uint32_t>(begin.at(static_cast<std::size_t>(s) + 1) -
                                               begin.at(static_cast<std::size_t>(s))));
  arrays.add("contact_count", count);
  arrays.add("contact_place", places(file, begin, states, origin));
  arrays.add_smooth("contact_block", whole_numbers<std::uint32_t>(read("first_block")));
  std::vector<std::uint16_t> joint;
  for (const float origin_of_joint : read("joint"))
    joint.push_back(static_cast<std::uint16_t>(origin_of_joint + 1));
  arrays.add_smooth("contact_joint", joint);
  arrays.add("contact_state", whole_numbers<std::uint8_t>(read("state")));
  add_levels("contact_gap", read("gap"), arrays);
  add_levels("contact_slip", read("slip"), arrays);
  add_levels("contact_normal", read("normal_stress"), arrays);
  const std::vector<float> shear = read("shear_stress");
  std::vector<float> length;
  for (std::size_t i = 0; i + 2 < shear.size(); i += 3)
    length.push_back(std::hypot(shear[i], shear[i + 1], shear[i + 2]));
  add_levels("contact_shear", length, arrays);
}

}  // namespace rockfold
