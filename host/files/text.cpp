#include "host/files/text.hpp"

#include <charconv>
#include <cstdlib>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "src/model/text/numbers/range.hpp"

namespace rockfold {

namespace {

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

Lines::Lines(std::string_view text, char continuation) : rest_(text), continuation_(continuation) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (rest_.substr(0, 3) == byte_order_mark) rest_.remove_prefix(3);
}

bool Lines::next() {
  if (rest_.empty()) return false;
  number_ += 1 + std::exchange(more_, 0);
  const auto after = [&](std::size_t end) {
    return end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1);
  };
  auto end = rest_.find_first_of("\r\n");
  while (end != std::string_view::npos && end > 0 && rest_[end - 1] == continuation_ &&
         trimmed(rest_).front() != '#') {
    end = rest_.find_first_of("\r\n", after(end));
    ++more_;
  }
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : after(end));
  return true;
}

std::string_view Words::next() {
  while (at_ < line_.size() && separates(line_[at_])) ++at_;
  const std::size_t begin = at_;
  while (at_ < line_.size() && !separates(line_[at_])) ++at_;
  column_ = begin + 1;
  return line_.substr(begin, at_ - begin);
}

std::string_view Words::rest() const {
  std::string_view rest = line_.substr(at_);
  while (!rest.empty() && separates(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && separates(rest.back())) rest.remove_suffix(1);
  return rest;
}

std::optional<Real> parse_number(std::string_view word) {
  word = without_plus(word);
  Real value = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ptr != end || word.empty()) return {};
  if (result.ec == std::errc{}) return value;
  if (result.ec != std::errc::result_out_of_range) return {};
  return std::strtod(std::string(word).c_str(), nullptr);  // infinite, or rounded to 0
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ptr != end || word.empty() || result.ec != std::errc{}) return {};
  return value;
}

std::string coordinate_fault(std::string_view name, Real value) {
  const Range range = coordinate();
  return range.holds(value) ? "" : fmt::format("{} is {:g}: {}", name, value, range.refusal(value));
}

Real parse_coordinate(std::string_view word, std::string_view name, int line, int column,
                      Faults& faults) {
  const auto value = parse_number(word);
  if (!value) {
    faults.add(line, column,
               word.empty()
                   ? fmt::format("{} is missing: there must be three numbers, x, y and z", name)
                   : fmt::format("{} must be a number, is {}", name, quoted(word)));
    return 0;
  }
  const auto fault = coordinate_fault(name, *value);
  if (fault.empty()) return *value + 0.0;  // no negative zeros: they would compare as other bits
  faults.add(line, column, fault);
  return 0;
}

Vec3 parse_point(Words& words, int line, Faults& faults) {
  Vec3 point{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto word = words.next();
    point[d] =
        parse_coordinate(word, std::string_view("xyz").substr(d, 1), line, words.column(), faults);
    if (word.empty()) break;  // said once
  }
  return point;
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace rockfold
