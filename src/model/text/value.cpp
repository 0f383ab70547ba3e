#include "src/model/text/value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rockfold {

namespace {

/// A quoted text on one line, cut where it is long.
std::string quoted(const std::string& text) {
  constexpr std::size_t longest = 60;  // a message should fit on a line or two
  std::size_t end = std::min(text.size(), longest);
  while (end < text.size() && end > 0 && (text[end] & 0xC0) == 0x80)
    --end;  // never inside a UTF-8 character
  std::string shown = text.substr(0, end);
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return '"' + shown + (end < text.size() ? "…\"" : "\"");
}

std::string counted(const char* what, std::size_t count, const char* of) {
  return std::string(what) + " of " + std::to_string(count) + " " + of + (count == 1 ? "" : "s");
}

struct Describe {
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(std::int64_t n) const { return std::to_string(n); }
  std::string operator()(double x) const { return number_text(x); }
  std::string operator()(const std::string& s) const { return quoted(s); }
  std::string operator()(const DateTime&) const { return "a date or time"; }
  std::string operator()(const Array& a) const { return counted("an array", a.size(), "value"); }
  std::string operator()(const Table& t) const {
    return counted("a table", t.entries.size(), "key");
  }
};

}  // namespace

Entry* Table::find(std::string_view key) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

const Entry* Table::find(std::string_view key) const {
  return const_cast<Table*>(this)->find(key);
}

std::string described(const Value& value) {
  return std::visit(Describe{}, value.data);
}

std::string number_text(double number) {
  if (!std::isfinite(number)) return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  std::string text(buffer, end);
  const auto e = text.find('e');
  if (e == std::string::npos) return text.find('.') == std::string::npos ? text + ".0" : text;
  if (text[e + 1] == '+') text.erase(e + 1, 1);  // 1e+09 → 1e09
  const std::size_t digits = e + (text[e + 1] == '-' ? 2 : 1);
  if (text[digits] == '0' && digits + 1 < text.size()) text.erase(digits, 1);  // 1e09 → 1e9
  return text;
}

}  // namespace rockfold
