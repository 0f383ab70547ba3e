#include "src/sweep/sweep_spec.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "src/model/text/nearest.hpp"
#include "src/model/text/parse_toml.hpp"
#include "src/model/text/table_reader.hpp"
#include "src/sweep/formula.hpp"

namespace rockfold::sweep {

namespace {

Range above_zero(const char* unit) {
  return {.low = 0, .low_open = true, .unit = unit};
}

/// As it would stand in a model.
std::string toml_text(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value.data)) return number_text(*number);
  if (const auto* yes = std::get_if<bool>(&value.data)) return *yes ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
  const auto* list = std::get_if<Array>(&value.data);
  if (list == nullptr) return "";
  std::string all = "[";
  for (const Value& item : *list) all += (all.size() > 1 ? ", " : "") + toml_text(item);
  return all + "]";
}

void read_variable(TableReader& in, Variable& v) {
  using Kind = Variable::Kind;
  const auto kind =
      in.choose("distribution", {{"constant", "exponential", "log_normal", "power_law", "normal",
                                  "uniform", "triangular", "beta", "weibull"},
                                 {}});
  if (!kind) return in.give_up();
  v.kind = static_cast<Kind>(*kind);
  const bool bounded = v.kind == Kind::power_law || v.kind == Kind::uniform ||
                       v.kind == Kind::triangular || v.kind == Kind::beta;
  if (!bounded && v.kind != Kind::weibull)
    in.read("mean", v.mean, v.kind == Kind::log_normal ? above_zero("") : Range{});
  if (v.kind == Kind::exponential && v.mean == 0)
    in.wrong("mean", "found 0, must be above 0, or below where all values are");
  if (v.kind == Kind::normal || v.kind == Kind::log_normal)
    in.read("standard_deviation", v.standard_deviation, above_zero(""));
  if (v.kind == Kind::power_law) in.read("exponent", v.exponent, above_zero(""));
  if (v.kind == Kind::triangular) in.read("mode", v.mode, Range{});
  if (v.kind == Kind::beta) {
    in.read("alpha", v.alpha, above_zero(""));
    in.read("beta", v.beta, above_zero(""));
  }
  if (v.kind == Kind::weibull) {
    in.read("shape", v.shape, above_zero(""));
    in.read("scale", v.scale, above_zero(""));
  }
  if (v.kind == Kind::constant) return;
  const Range limit = v.kind == Kind::power_law ? above_zero("") : Range{};
  const Need need = bounded ? Need::required : Need::optional;
  in.read("min", v.min, limit, need);
  in.read("max", v.max, limit, need);
  if (!(v.min < v.max))
    in.wrong("max", "found " + number_text(v.max) + ", must be > min's " + number_text(v.min));
  if (v.kind == Kind::triangular && (v.mode < v.min || v.mode > v.max))
    in.wrong("mode", "found " + number_text(v.mode) + ", must lie from min to max");
  in.read("integer", v.integer, Need::optional);
  if (!v.integer) return;
  for (const auto& [key, end] : {std::pair{"min", v.min}, std::pair{"max", v.max}})
    if (std::isfinite(end) && end != std::round(end))
      in.wrong(key, "found " + number_text(end) + ", must be a whole number where integer = true");
}

/// `key` or `keys`, with a `name` if one is wanted.
void read_keys(TableReader& in, Parameter& parameter) {
  if (!in.has("keys")) {
    in.read("key", parameter.key);
    if (in.has("name")) parameter.keys = {parameter.key};
    in.read("name", parameter.key, Need::optional);
    return;
  }
  if (in.has("key")) in.wrong("keys", "must not stand beside key: they say the same");
  const Value* value = in.find("keys");
  const auto* list = std::get_if<Array>(&value->data);
  if (list != nullptr)
    for (const Value& item : *list)
      if (const auto* key = std::get_if<std::string>(&item.data)) parameter.keys.push_back(*key);
  if (list == nullptr || list->empty() || parameter.keys.size() != list->size()) {
    in.wrong("keys", "found " + described(*value) + ", must be a list of keys as for --set");
    return;
  }
  parameter.key = parameter.keys.front();
  in.read("name", parameter.key, Need::optional);
}

void read_correlation(TableReader& in, const SweepSpec& spec, Parameter& parameter) {
  const Value* value = in.find("correlation");
  if (value == nullptr) return;
  TableReader of(*value, in.path_of("correlation"), in.out());
  Correlation correlation;
  std::string with;
  of.read("with", with);
  of.read("rank", correlation.rank, Range{.low = -1, .high = 1});
  std::vector<std::string> drawn;
  for (const Parameter& p : spec.parameters)
    if (std::holds_alternative<Variable>(p.values)) drawn.push_back(p.key);
  const auto found = std::find_if(spec.parameters.begin(), spec.parameters.end(),
                                  [&](const Parameter& p) { return p.key == with; });
  if (!std::holds_alternative<Variable>(parameter.values))
    in.wrong("correlation", "is of values that are drawn from a distribution");
  else if (std::find(drawn.begin(), drawn.end(), with) == drawn.end())
    of.wrong("with", fmt::format("'{}' is no parameter with a distribution before this one{}", with,
                                 suggestion(with, drawn, "there are")));
  correlation.with = static_cast<std::size_t>(found - spec.parameters.begin());
  parameter.correlation = correlation;
}

bool has_numbers(const Parameter& parameter) {
  const auto* texts = std::get_if<std::vector<std::string>>(&parameter.values);
  return texts == nullptr || std::all_of(texts->begin(), texts->end(), [](const std::string& text) {
           Real number = 0;
           const auto [end, fault] =
               std::from_chars(text.data(), text.data() + text.size(), number);
           return fault == std::errc{} && end == text.data() + text.size();
         });
}

void read_expression(TableReader& in, const SweepSpec& spec, Parameter& parameter) {
  auto& expression = parameter.values.emplace<Expression>();
  if (!in.read("expression", expression.formula)) return;
  std::vector<std::string> known;
  for (const Parameter& p : spec.parameters)
    if (has_numbers(p)) known.push_back(p.key);
  try {
    for (const std::string& name : names_in(expression.formula))
      if (std::find(known.begin(), known.end(), name) == known.end())
        in.wrong("expression", fmt::format("'{}' is the name of no parameter with numbers before "
                                           "this one{}",
                                           name, suggestion(name, known, "there are")));
  } catch (const std::invalid_argument& error) {
    in.wrong("expression", error.what());
  }
}

/// Of values for --seed. Of an expression the runs tell.
void require_seeds(TableReader& in, const Parameter& parameter) {
  if (const auto* variable = std::get_if<Variable>(&parameter.values)) {
    if (!variable->integer || variable->min < 0)
      in.wrong("distribution",
               "is of fractions or of numbers < 0: seeds need integer = true and a "
               "min >= 0");
    return;
  }
  const auto* texts = std::get_if<std::vector<std::string>>(&parameter.values);
  for (const std::string& text : texts == nullptr ? std::vector<std::string>{} : *texts) {
    std::uint64_t seed = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (fault != std::errc{} || end != text.data() + text.size())
      return in.wrong("values", fmt::format("found '{}', seeds are whole numbers >= 0", text));
  }
}

void read_parameter(TableReader& in, SweepSpec& spec) {
  Parameter parameter;
  read_keys(in, parameter);
  const Value* values = in.find("values");
  if (in.has("expression")) {
    for (const char* other : {"values", "distribution"})
      if (in.has(other)) in.wrong("expression", fmt::format("must not stand beside {}", other));
    read_expression(in, spec, parameter);
  } else if (values == nullptr) {
    if (!in.has("distribution")) {
      in.missing({"values", "distribution", "expression"},
                 "must be given: values = [...], distribution or expression");
      in.give_up();
      return;
    }
    read_variable(in, parameter.values.emplace<Variable>());
  } else {
    const auto* list = std::get_if<Array>(&values->data);
    if (list == nullptr || list->empty()) {
      in.wrong("values", "found " + described(*values) + ", must be a list of at least one value");
    } else {
      auto& texts = parameter.values.emplace<std::vector<std::string>>();
      for (const Value& item : *list) texts.push_back(toml_text(item));
    }
  }
  read_correlation(in, spec, parameter);
  if (sets_seed_option(parameter)) require_seeds(in, parameter);
  spec.parameters.push_back(std::move(parameter));
}

template <typename Read>
void read_list(TableReader& root, const std::string& key, Read read) {
  const Value* value = root.find(key);
  if (value == nullptr) return;
  const auto* list = std::get_if<Array>(&value->data);
  if (list == nullptr)
    return root.wrong(key, "found " + described(*value) + ", must be [[" + key + "]]");
  for (std::size_t i = 0; i < list->size(); ++i) {
    TableReader in((*list)[i], fmt::format("{}[{}]", key, i + 1), root.out());
    read(in);
  }
}

void read_event(TableReader& in, SweepSpec& spec) {
  Event event;
  in.read("name", event.name);
  const std::vector<std::string> meanings{null_name(NullMeans::did_not_happen),
                                          null_name(NullMeans::left_out)};
  if (const auto means = in.choose("null", {meanings, {}}, Need::optional))
    event.null = static_cast<NullMeans>(*means);
  if (!in.read("when", event.text)) return;
  std::vector<std::string> known;
  for (const Result& result : spec.results) known.push_back(result.name);
  for (const Parameter& parameter : spec.parameters) known.push_back(parameter.key);
  try {
    event.when = parse_condition(event.text);
  } catch (const std::invalid_argument& error) {
    return in.wrong("when", error.what());
  }
  for (const auto& all : event.when.any_of_all)
    for (const auto& comparison : all)
      if (std::find(known.begin(), known.end(), comparison.name) == known.end())
        in.wrong("when", fmt::format("'{}' is no result or parameter{}", comparison.name,
                                     suggestion(comparison.name, known, "there are")));
  spec.events.push_back(std::move(event));
}

void require_own_names(const SweepSpec& spec, TableReader& root) {
  std::set<std::string> taken{"run", "status", "seconds", "error"};
  const auto take = [&](const char* list, const std::string& name) {
    if (!taken.insert(name).second)
      root.wrong(list, fmt::format("two columns of the table are called '{}'", name));
  };
  for (const auto& p : spec.parameters) take("parameter", p.key);
  for (const auto& r : spec.results) take("result", r.name);
  for (const auto& e : spec.events) take("event", e.name);
}

void read_root(TableReader& root, SweepSpec& spec) {
  root.read("model", spec.model);
  static const std::vector<std::string> commands{"cut", "support", "stability", "theory", "run"};
  if (const auto command = root.choose("command", {commands, {}}))
    spec.command = commands[*command];
  if (const auto sampling =
          root.choose("sampling", {{"all", "latin_hypercube", "monte_carlo"}, {}}, Need::optional))
    spec.sampling = static_cast<Sampling>(*sampling);
  const bool drawn = spec.sampling != Sampling::all;
  root.read("runs", spec.runs, IntegerRange{.low = 1}, drawn ? Need::required : Need::optional);
  Index seed = 1;
  root.read("seed", seed, IntegerRange{.low = 0}, Need::optional);
  spec.seed = static_cast<std::uint64_t>(seed);
  root.read("workers", spec.workers, IntegerRange{.low = 0}, Need::optional);
  if (const Value* limits = root.find("limits")) {
    TableReader in(*limits, "limits", root.out());
    in.read("time", spec.time_limit, above_zero("s"), Need::optional);
    in.read("memory", spec.memory_limit, above_zero("bytes"), Need::optional);
  }
  read_list(root, "parameter", [&](TableReader& in) { read_parameter(in, spec); });
  read_list(root, "result", [&](TableReader& in) {
    Result& result = spec.results.emplace_back();
    in.read("name", result.name);
    in.read("path", result.path);
  });
  read_list(root, "event", [&](TableReader& in) { read_event(in, spec); });
  for (const Parameter& p : spec.parameters)
    if (!drawn && std::holds_alternative<Variable>(p.values))
      root.wrong("sampling", fmt::format("'all' takes lists alone, but {} has a distribution: give "
                                         "values, or latin_hypercube or monte_carlo",
                                         p.key));
  if (spec.parameters.empty() && !drawn) root.wrong("", "there is no [[parameter]] to vary");
  require_own_names(spec, root);
}

}  // namespace

bool is_seed(const Parameter& parameter) {
  const std::string& key = parameter.keys.empty() ? parameter.key : parameter.keys.front();
  return key == "seed" || key == seed_option || key.ends_with(".seed");
}

bool sets_seed_option(const Parameter& parameter) {
  const auto& keys = parameter.keys;
  return keys.empty() ? parameter.key == seed_option
                      : std::find(keys.begin(), keys.end(), seed_option) != keys.end();
}

std::vector<std::string> changes_of(const Parameter& parameter, const std::string& value) {
  std::vector<std::string> changes;
  for (const std::string& key :
       parameter.keys.empty() ? std::vector{parameter.key} : parameter.keys)
    if (key != seed_option) changes.push_back(fmt::format("{}={}", key, value));
  return changes;
}

const char* null_name(NullMeans null) {
  return null == NullMeans::left_out ? "exclude" : "false";
}

SweepSpec parse_sweep(const std::string& text, const std::string& path) {
  const Value root = parse_toml(text, 0, path);
  Diagnostics out({path});
  SweepSpec spec;
  spec.path = path;
  {
    TableReader reader(root, "", out);
    read_root(reader, spec);
  }
  if (!out.empty()) throw out.error();
  spec.model = (std::filesystem::path(path).parent_path() / spec.model).string();
  return spec;
}

SweepSpec read_sweep(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code ignored;
  if (!in || std::filesystem::is_directory(path, ignored))
    throw Error(ErrorKind::io,
                in ? "cannot be read: is a directory"
                   : std::string("cannot be read: ") + std::strerror(errno),
                Place{path, 0, 0, ""});
  return parse_sweep({std::istreambuf_iterator<char>(in), {}}, path);
}

}  // namespace rockfold::sweep
