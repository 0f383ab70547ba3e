#include "src/model/text/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include "src/base/error.hpp"
#include "src/model/text/nearest.hpp"
#include "src/model/text/parse_toml.hpp"

namespace rockfold {

namespace {

struct Override {
  std::string text;
  std::vector<std::string> path;
  std::optional<Value> value;  ///< none: what is there goes
};

[[noreturn]] void reject(const std::string& text, const std::string& why) {
  throw Error(ErrorKind::usage, override_name(text) + ": " + why);
}

/// Splits "a.b[2].c" at the front of `text`; leaves what follows, which starts with '='.
class PathParser {
 public:
  explicit PathParser(const std::string& text) : text_(text) {}

  std::vector<std::string> parse() {
    std::vector<std::string> parts{part()};
    while (at_ < text_.size() && text_[at_] != '=') {
      if (text_[at_] == '.') {
        ++at_;
        parts.push_back(part());
      } else if (text_[at_] == '[') {
        parts.push_back(bracketed());
      } else {
        reject(text_, "the key path has \"" + text_.substr(at_, 1) +
                          "\" where '.', '[' or '=' should stand");
      }
    }
    if (at_ == text_.size()) reject(text_, "must be key.path=value, has no '='");
    if (parts.size() > most_parts)
      reject(text_, "the key path has more than " + std::to_string(most_parts) + " parts");
    return parts;
  }

  std::string rest() const { return text_.substr(at_ + 1); }

 private:
  std::string part() {
    if (at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'')) return quoted();
    const auto end = std::min(text_.find_first_of(".[]=\"'", at_), text_.size());
    std::string word = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    if (word.empty()) reject(text_, "the key path has an empty part, must be key.path=value");
    return word;
  }

  std::string quoted() {
    const auto end = text_.find(text_[at_], at_ + 1);
    if (end == std::string::npos) reject(text_, "the key path has an open quote");
    std::string word = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return word;
  }

  std::string bracketed() {
    ++at_;
    std::string word = part();
    if (at_ >= text_.size() || text_[at_] != ']') reject(text_, "the key path has an open bracket");
    ++at_;
    return word;
  }

  static std::string trimmed(std::string word) {
    word.erase(0, word.find_first_not_of(' '));
    word.erase(word.find_last_not_of(' ') + 1);
    return word;
  }

  static constexpr std::size_t most_parts = 20;  // no key of a model has over 7; bounds recursion
  const std::string& text_;
  std::size_t at_ = 0;
};

/// The text as a TOML string.
std::string toml_string(const std::string& text) {
  constexpr const char* digits = "0123456789ABCDEF";
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7F) {
      result += std::string("\\u00") + digits[code / 16] + digits[code % 16];
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + '"';
}

/// The one value of the document `v = …`.
std::optional<Value> parsed(const std::string& text, int source) {
  try {
    Value document = parse_toml("v = " + text, source, "");
    auto& entries = std::get<Table>(document.data).entries;
    if (entries.size() == 1) return std::move(entries[0].value);
  } catch (const Error&) {
    // no TOML
  }
  return {};
}

Override parse_override(const std::string& text, int source) {
  PathParser parser(text);
  Override result{text, parser.parse(), {}};
  if (parser.rest().empty()) return result;
  auto value = parsed(parser.rest(), source);
  if (!value) value = parsed(toml_string(parser.rest()), source);
  if (!value) reject(text, "the value is no UTF-8 text");
  result.value = std::move(value);
  return result;
}

std::string joined(const std::string& path, const std::string& part) {
  return path.empty() ? part : path + "." + part;
}

std::optional<std::size_t> number_in(const std::string& part) {
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), n);
  return error == std::errc{} && end == part.data() + part.size() ? std::optional(n) : std::nullopt;
}

std::vector<std::string> names_in(const Array& array) {
  std::vector<std::string> names;
  for (const auto& item : array) {
    const auto* table = std::get_if<Table>(&item.data);
    const auto* entry = table ? table->find("name") : nullptr;
    const auto* name = entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
    names.push_back(name ? *name : "");
  }
  return names;
}

/// The item of an array that a path part picks: by number, else by name.
std::size_t item(const Array& array, const std::string& part, const std::string& array_path,
                 const std::string& text) {
  if (const auto n = number_in(part)) {
    if (*n >= 1 && *n <= array.size()) return *n - 1;
    reject(text,
           array_path + " has " + std::to_string(array.size()) + " entries, no number " + part);
  }
  auto names = names_in(array);
  const auto found = std::find(names.begin(), names.end(), part);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.erase(std::remove(names.begin(), names.end(), ""), names.end());
  reject(text, array_path + " has no entry named \"" + part + "\"" +
                   suggestion(part, names, "the names are"));
}

/// What the i-th part of the path picks in `parent`; a key that is not there yet is made.
Value& child(Value& parent, std::size_t i, const std::string& parent_path, const Override& change) {
  const std::string& part = change.path[i];
  if (auto* array = std::get_if<Array>(&parent.data))
    return (*array)[item(*array, part, parent_path, change.text)];
  auto* table = std::get_if<Table>(&parent.data);
  if (!table)
    reject(change.text, parent_path + " is " + described(parent) + ", it has no \"" + part + "\"");
  if (auto* entry = table->find(part)) return entry->value;
  if (i + 1 < change.path.size() && number_in(change.path[i + 1]))
    reject(change.text, "the model has no " + joined(parent_path, part) + " to change an entry of");
  const Spot spot{change.value->spot.source, 0, 0};
  table->entries.push_back({part, spot, Value{Table{}, spot}});
  return table->entries.back().value;
}

/// What of a table was probably meant by a key that it does not have.
std::string suggested_key(const std::string& key, const Table& table) {
  std::vector<std::string> keys;
  for (const auto& entry : table.entries) keys.push_back(entry.key);
  return suggestion(key, keys, "the keys there are");
}

/// Takes what the path names out of `root`.
void remove(Value& root, const Override& change) {
  Value* parent = &root;
  std::string path;
  for (std::size_t i = 0;; ++i) {
    const std::string& part = change.path[i];
    const bool last = i + 1 == change.path.size();
    if (auto* array = std::get_if<Array>(&parent->data)) {
      const std::size_t n = item(*array, part, path, change.text);
      if (last) {
        array->erase(array->begin() + static_cast<std::ptrdiff_t>(n));
        return;
      }
      parent = &(*array)[n];
    } else {
      auto* table = std::get_if<Table>(&parent->data);
      auto* entry = table ? table->find(part) : nullptr;
      if (!entry)
        reject(change.text,
               "takes " + joined(path, part) +
                   " out of the model, where there is none (a value stands behind '=')" +
                   (table ? suggested_key(part, *table) : ""));
      if (last) {
        table->entries.erase(table->entries.begin() + (entry - table->entries.data()));
        return;
      }
      parent = &entry->value;
    }
    path = joined(path, part);
  }
}

}  // namespace

std::string override_name(const std::string& override_text) {
  return "--set " + override_text;
}

void apply_override(Value& root, const std::string& override_text, int source) {
  Override change = parse_override(override_text, source);
  if (!change.value) return remove(root, change);
  Value* target = &root;
  std::string path;
  for (std::size_t i = 0; i < change.path.size(); ++i) {
    target = &child(*target, i, path, change);
    path = joined(path, change.path[i]);
  }
  *target = std::move(*change.value);
}

}  // namespace rockfold
