#include "src/model/text/table_reader.hpp"

#include <algorithm>

#include "src/model/read/read_value.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

bool contains(const std::vector<std::string>& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// a, b or c, each in quotes.
std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "\"" : i + 1 < words.size() ? ", \"" : " or \"") + words[i] + "\"";
  return text;
}

bool printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(),
                      [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

}  // namespace

TableReader::TableReader(const Value& value, std::string path, Diagnostics& out)
    : table_(std::get_if<Table>(&value.data)),
      spot_(value.spot),
      path_(std::move(path)),
      out_(out),
      label_before_(out.label()) {
  if (!table_) out_.add(spot_, path_, "found " + described(value) + ", must be a table of keys");
}

TableReader::~TableReader() {
  if (table_) {
    report_unknown();
    report_missing();
  }
  out_.set_label(label_before_);
}

void TableReader::know(std::string_view key) {
  if (contains(known_, key)) return;
  known_.emplace_back(key);
  supported_.emplace_back(key);
}

bool TableReader::has(std::string_view key) {
  know(key);
  return entry(key) != nullptr;
}

const Value* TableReader::find(const std::string& key, const std::string& expected) {
  know(key);
  const auto* found = entry(key);
  if (!found && !expected.empty()) missing({key}, "is missing, " + expected);
  return found ? &found->value : nullptr;
}

bool TableReader::read(const std::string& key, Real& target, const Range& range, Need need) {
  const auto* value = find(key, need == Need::required ? range.text() : "");
  const auto x = value ? real_from(*value, path_of(key), range, out_) : std::nullopt;
  if (x) target = *x;
  return x.has_value();
}

bool TableReader::read(const std::string& key, std::optional<Real>& target, const Range& range) {
  Real x = 0;
  const bool good = read(key, x, range, Need::optional);
  if (good) target = x;
  return good;
}

bool TableReader::read(const std::string& key, Index& target, const IntegerRange& range,
                       Need need) {
  const auto* value = find(key, need == Need::required ? range.text() : "");
  const auto n = value ? integer_from(*value, path_of(key), range, out_) : std::nullopt;
  if (n) target = *n;
  return n.has_value();
}

bool TableReader::read(const std::string& key, bool& target, Need need) {
  const auto* value = find(key, need == Need::required ? "must be true or false" : "");
  const auto b = value ? boolean_from(*value, path_of(key), out_) : std::nullopt;
  if (b) target = *b;
  return b.has_value();
}

bool TableReader::read(const std::string& key, std::string& target, Need need) {
  const auto* value = find(key, need == Need::required ? "must be a text in quotes" : "");
  const auto text = value ? text_from(*value, path_of(key), out_) : std::nullopt;
  if (text) target = *text;
  return text.has_value();
}

bool TableReader::read(const std::string& key, Vec3& target, const Range& range, Need need) {
  const auto* value = find(key, need == Need::required ? "must be 3 numbers [x, y, z]" : "");
  const auto v = value ? vector_from(*value, path_of(key), range, out_) : std::nullopt;
  if (v) target = *v;
  return v.has_value();
}

bool TableReader::read_direction(const std::string& key, Vec3& target) {
  const auto* value = find(key, "must be 3 numbers [x, y, z]");
  const auto v = value ? direction_from(*value, path_of(key), out_) : std::nullopt;
  if (v) target = *v;
  return v.has_value();
}

std::optional<std::size_t> TableReader::choose(const std::string& key, const Choice& choice,
                                               Need need) {
  const std::string expected = "must be " + alternatives(choice.words);
  const auto* value = find(key, need == Need::required ? expected : "");
  const auto word = value ? text_from(*value, path_of(key), out_) : std::nullopt;
  if (!word) return {};
  const auto found = std::find(choice.words.begin(), choice.words.end(), *word);
  if (found != choice.words.end()) return found - choice.words.begin();
  if (contains(choice.not_yet, *word)) {
    wrong(key, described(*value) + " is not supported yet, " + expected);
  } else {
    auto all = choice.words;
    all.insert(all.end(), choice.not_yet.begin(), choice.not_yet.end());
    auto nearest = nearest_word(*word, all);
    if (choice.words.size() == 1 && nearest == choice.words[0]) nearest.clear();  // said already
    wrong(key, "found " + described(*value) + ", " + expected +
                   (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  }
  return {};
}

std::string TableReader::read_name(Names& names, const std::string& fallback) {
  std::string name = fallback;
  if (has("name") && !read("name", name)) {
    names.set_incomplete();
  } else if (name.empty() || !printable(name)) {
    wrong("name", "found " + described({name, {}}) + ", must be one line of text, not empty");
    names.set_incomplete();
  } else if (const auto first = names.find(name); first != none) {
    const auto line = std::to_string(names.spot(first).line);
    wrong("name", "\"" + name + "\" is already the name of " + names.path(first) +
                      (names.spot(first).line > 0 ? " (line " + line + ")" : ""));
  }
  names.add(name, spot_, path_);
  if (has("name")) out_.set_label(printable(name) ? name : "");
  return name;
}

std::string TableReader::read_prefix(const std::string& fallback) {
  std::string name;
  if (!read("name", name, Need::optional)) return fallback;
  if (name.empty() || !printable(name)) {
    wrong("name", "found " + described({name, {}}) + ", must be one line of text, not empty");
    return fallback;
  }
  out_.set_label(name);
  return name;
}

std::string TableReader::add_name(Names& names, const std::string& wanted) {
  std::string name = wanted;
  for (int number = 2; names.find(name) != none; ++number)
    name = wanted + "_" + std::to_string(number);
  names.add(name, spot_, path_);
  return name;
}

bool TableReader::read_reference(const std::string& key, const Names& names, Index& target) {
  target = names.empty() ? none : 0;
  std::string name;
  if (!read(key, name, Need::optional)) return !has(key);
  target = names.find(name);
  if (target != none) return true;
  if (names.complete() && !out_.explained(names.section())) {
    wrong(key, "unknown " + names.kind() + " \"" + name + "\"" +
                   (names.empty() ? "; the model has no [[" + names.section() + "]]"
                                  : suggestion(name, names.all(), "the model has")));
    if (names.empty()) out_.explain(names.section());
  }
  out_.explain(path_of(key));
  return false;
}

bool TableReader::read_optional_reference(const std::string& key, const Names& names,
                                          Index& target) {
  target = none;
  return !has(key) || read_reference(key, names, target);
}

bool TableReader::not_yet(const std::string& key, const std::string& instead) {
  known_.push_back(key);
  const auto* found = entry(key);
  if (!found) return false;
  out_.add(found->spot, path_of(key),
           '"' + key + "\" is not supported yet" + (instead.empty() ? "" : "; " + instead));
  return true;
}

void TableReader::missing(std::vector<std::string> keys, const std::string& message) {
  missing_.push_back({std::move(keys), message});
}

void TableReader::wrong(const std::string& key, const std::string& message) {
  const auto* found = entry(key);
  out_.add(found ? found->value.spot : spot_, path_of(key), message);
}

void TableReader::unreadable(const std::string& key, const std::string& message) {
  const auto* found = entry(key);
  out_.add_unreadable(found ? found->value.spot : spot_, path_of(key), message);
}

Place TableReader::place_of(const std::string& key) {
  const auto* found = entry(key);
  return out_.place(found ? found->value.spot : spot_, path_of(key));
}

bool TableReader::is_missing(const std::string& key) const {
  return std::any_of(missing_.begin(), missing_.end(),
                     [&](const auto& m) { return contains(m.keys, key); });
}

/// What an unknown key is or belongs to.
std::string TableReader::about_unknown(const std::string& key, const Value& value,
                                       const std::string& nearest) const {
  const bool section =
      std::holds_alternative<Table>(value.data) || std::holds_alternative<Array>(value.data);
  if (section && out_.is_section(key) && !path_.empty())
    return ": it belongs to the model, before the first table in brackets, or as [" + key +
           "] or [[" + key + "]]";
  if (key == "unit_weight") return ": it is a density with its unit, density = \"26 kN/m3\"";
  return nearest.empty() ? suggestion(key, supported_, "the keys here are")
                         : ", did you mean \"" + nearest + "\"?";
}

void TableReader::report_unknown() {
  for (const auto& [key, spot, value] : table_->entries) {
    if (contains(known_, key)) continue;
    const auto nearest = nearest_word(key, known_);
    if (given_up_ && !is_missing(nearest)) continue;
    if (!nearest.empty()) out_.explain(path_of(nearest));
    out_.add(spot, path_of(key),
             "unknown key " + described({key, {}}) + about_unknown(key, value, nearest));
  }
}

void TableReader::report_missing() {
  for (const auto& [keys, message] : missing_)
    if (std::none_of(keys.begin(), keys.end(),
                     [&](const auto& key) { return out_.explained(path_of(key)); }))
      out_.add(spot_, path_of(keys.front()), message);
}

}  // namespace rockfold
