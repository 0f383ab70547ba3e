#include "src/model/text/parse_toml.hpp"

// The library as headers alone, whatever the build says about an installed shared one: nothing to
// link or ship.
#undef TOML_SHARED_LIB
#undef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1
// Its parser asserts (and with NDEBUG tells clang to assume) that a header's key starts like a key
// before it looks, and then reports `[=]` as it should: without the assertions wrong input is an
// error, not an abort.
#define TOML_ASSERT(expr) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <algorithm>

#include "src/base/error.hpp"
#include "src/model/text/decimal_comma.hpp"
#include "src/model/text/file_kind.hpp"

namespace rockfold {

namespace {

/// Keys of a model have at most 4 parts. The library destroys nested tables recursively, so that a
/// key of thousands of parts (which versions before 3.4 accept) would overrun the stack.
constexpr int max_key_parts = 20;

Spot spot_of(const toml::source_region& region, int source) {
  return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

/// Copies the library's tree. Depth: at most its limit of nested values times max_key_parts.
class Converter {
 public:
  explicit Converter(int source) : source_(source) {}

  Value operator()(const toml::node& node) const {
    Value value;
    value.spot = spot_of(node.source(), source_);
    if (const auto* table = node.as_table()) {
      value.data = entries(*table);
    } else if (const auto* array = node.as_array()) {
      value.data = items(*array);
    } else {
      scalar(node, value);
    }
    return value;
  }

 private:
  Table entries(const toml::table& table) const {
    Table result;
    result.entries.reserve(table.size());
    for (const auto& [key, node] : table)
      result.entries.push_back(
          {std::string(key.str()), spot_of(key.source(), source_), (*this)(node)});
    return result;
  }

  Array items(const toml::array& array) const {
    Array result;
    result.reserve(array.size());
    for (const auto& node : array) result.push_back((*this)(node));
    return result;
  }

  static void scalar(const toml::node& node, Value& value) {
    if (const auto* text = node.as_string()) {
      value.data = text->get();
    } else if (const auto* integer = node.as_integer()) {
      value.data = integer->get();
    } else if (const auto* real = node.as_floating_point()) {
      value.data = real->get();
    } else if (const auto* boolean = node.as_boolean()) {
      value.data = boolean->get();
    } else {
      value.data = DateTime{};
    }
  }

  int source_;
};

/// The position behind the string that starts at `i`.
std::size_t skip_string(std::string_view text, std::size_t i) {
  const char quote = text[i];
  const std::string triple(3, quote);
  const bool multi_line = text.substr(i, 3) == triple;
  for (i += multi_line ? 3 : 1; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (multi_line ? text.substr(i, 3) == triple : text[i] == quote) {
      i += multi_line ? 3 : 1;
      while (multi_line && i < text.size() && text[i] == quote)
        ++i;  // """a""""" ends with its last quote
      return i;
    } else if (!multi_line && text[i] == '\n') {
      return i;
    }
  }
  return text.size();
}

[[noreturn]] void reject(std::string_view text, std::size_t at, const std::string& name,
                         const std::string& why) {
  const auto before = text.substr(0, at);
  Place place{name, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')), 0, ""};
  const auto line_begin = before.rfind('\n');
  const auto line = before.substr(line_begin == std::string_view::npos ? 0 : line_begin + 1);
  place.column = 1 + static_cast<int>(std::count_if(line.begin(), line.end(), [](unsigned char c) {
                   return (c & 0xC0) != 0x80;  // letters, not their bytes
                 }));
  throw Error(ErrorKind::model, why, place);
}

/// Refuses before the library sees them: keys of very many parts, and letters beyond ASCII outside
/// quotes, which TOML has not and the library (to 3.3) looks up in a table that ends before them.
void check_tokens(std::string_view text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  int dots = 0;
  for (std::size_t i = text.substr(0, 3) == byte_order_mark ? 3 : 0; i < text.size();) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) >= 0x80)
      reject(text, i, name, "TOML syntax: only ASCII may stand outside of quotes and comments");
    if (c == '"' || c == '\'') {
      i = skip_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '.' && ++dots >= max_key_parts)
      reject(text, i, name,
             "a key of more than " + std::to_string(max_key_parts) + " parts; none has so many");
    if (std::string_view(",={}[]\n").find(c) != std::string_view::npos) dots = 0;
    ++i;
  }
}

std::string_view line_of(std::string_view text, int number) {
  for (; number > 1; --number) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// What people write who know other formats.
std::string syntax_hint(std::string_view line) {
  std::string comma = decimal_comma_hint(decimal_comma_value(line));
  if (!comma.empty()) return comma;
  const auto first = line.find_first_not_of(" \t-");
  if (first == std::string_view::npos) return "";
  constexpr std::string_view name = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  const auto equals = line.find('='), colon = line.find(':');
  if (equals == std::string_view::npos)
    return line[first] == '['
               ? ""
               : "; a line of a model is key = value" +
                     std::string(colon == std::string_view::npos ? "" : ", without a colon");
  const auto value = line.find_first_not_of(" \t", equals + 1);
  if (value == std::string_view::npos) return "";
  if (name.find(line[value]) != std::string_view::npos) return "; text stands in quotes: \"…\"";
  if (std::string_view("0123456789.+-").find(line[value]) != std::string_view::npos &&
      line.find_first_of("abcdfghijklmnopqrstuvwxyzABCDFGHIJKLMNOPQRSTUVWXYZ%°", value) <
          line.find('#'))
    return "; a number with its unit stands in quotes: \"25 MPa\"";
  return "";
}

/// Names of files as Windows writes them.
std::string escape_hint(std::string_view description) {
  return description.find("escape sequence") == std::string_view::npos ? "" : backslash_hint;
}

/// A list of tables whose entry stands in single brackets.
std::string list_hint(std::string_view description) {
  if (description.find("as array-of-tables") == std::string_view::npos) return "";
  return "; entries of a list stand in double brackets, all of them: [[joint_set]]";
}

}  // namespace

Value parse_toml(std::string_view text, int source, const std::string& name) {
  check_tokens(text, name);
  try {
    const toml::table table = toml::parse(text, std::string_view(name));
    return Converter(source)(table);
  } catch (const toml::parse_error& error) {
    const auto spot = spot_of(error.source(), source);
    throw Error(ErrorKind::model,
                "TOML syntax: " + std::string(error.description()) +
                    list_hint(error.description()) + escape_hint(error.description()) +
                    syntax_hint(line_of(text, spot.line)),
                Place{name, spot.line, spot.column, ""});
  }
}

}  // namespace rockfold
