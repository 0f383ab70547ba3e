#include "src/sweep/sweep_runs.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/files/load_files.hpp"
#include "src/base/archive.hpp"
#include "src/model/read/read_model.hpp"
#include "src/model/text/overrides.hpp"
#include "src/report/documents/documents.hpp"
#include "src/sweep/sampling.hpp"

namespace fs = std::filesystem;

namespace rockfold::sweep {

namespace {

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> overrides_of(const Options& options, const SweepSpec& spec,
                                      const std::vector<std::string>& values) {
  std::vector<std::string> all = options.overrides;
  for (std::size_t p = 0; p < values.size(); ++p)
    for (std::string& change : changes_of(spec.parameters[p], values[p]))
      all.push_back(std::move(change));
  return all;
}

/// A parameter drawn from a distribution of numbers that need not be whole.
bool draws_fractions(const Parameter& parameter) {
  const auto* variable = std::get_if<Variable>(&parameter.values);
  return variable != nullptr && !variable->integer && variable->kind != Variable::Kind::constant;
}

/// What is wrong with the keys of the changes, whatever their values are: unknown ones, and fractions where whole numbers must be.
std::vector<Diagnostic> wrong_keys(const SweepSpec& spec, const std::vector<std::string>& changes,
                                   const Error& error) {
  std::vector<Diagnostic> wrong;
  std::vector<const Parameter*> parameter_of;
  for (const Parameter& p : spec.parameters)
    parameter_of.resize(parameter_of.size() + changes_of(p, "").size(), &p);
  const std::size_t first = changes.size() - parameter_of.size();
  for (Diagnostic found : error.diagnostics())
    for (std::size_t i = 0; i < changes.size(); ++i) {
      if (found.place.file != override_name(changes[i])) continue;
      const bool fraction = i >= first && draws_fractions(*parameter_of[i - first]) &&
                            found.message.find("must be an integer") != std::string::npos;
      if (fraction) found.message += "; integer = true in its [[parameter]] draws whole numbers";
      if (fraction || found.message.starts_with("unknown key")) wrong.push_back(found);
      break;
    }
  return wrong;
}

/// That the model is there, is TOML and has what the keys name: else every run would fail with the same words.
std::string require_model(const Options& options, const SweepSpec& spec,
                          const std::vector<std::string>& values) {
  std::error_code ignored;
  if (!fs::is_regular_file(spec.model, ignored))
    throw Error(ErrorKind::io, "no such file", Place{spec.model, 0, 0, "model"});
  const auto changes = overrides_of(options, spec, values);
  const ReadModel read = try_read_model(spec.model, changes, Purpose::cut, file_bodies);
  if (read.wrong)
    if (auto wrong = wrong_keys(spec, changes, *read.wrong); !wrong.empty())
      throw Error(ErrorKind::model, std::move(wrong));
  return text_of(spec.model);
}

Identity identity_of(const Options& options, const SweepSpec& spec, const std::string& model,
                     const std::vector<std::vector<std::string>>& values) {
  Identity identity{model, spec.command, {}, "", static_cast<Index>(values.size()), {}};
  for (const std::string& change : options.overrides) identity.model += "\n# --set " + change;
  for (const Parameter& p : spec.parameters)
    identity.keys.push_back(
        p.keys.empty() ? p.key : fmt::format("{} = {}", p.key, fmt::join(p.keys, ", ")));
  for (const Result& r : spec.results) identity.paths.push_back(r.name + " = " + r.path);
  Hash hash;
  for (const auto& row : values)
    for (const std::string& text : row)
      hash.add(std::as_bytes(std::span(text.c_str(), text.size() + 1)));
  identity.values = fmt::format("{:016x}", hash.value());
  return identity;
}

/// What a path picks; nothing if there is no such place.
std::optional<Json> picked(const Json& document, const std::string& path) {
  const Json* at = &document;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    begin = end + 1;
    if (at->is_object()) {
      if (!at->contains(part)) return {};
      at = &at->at(part);
      continue;
    }
    if (!at->is_array()) return {};
    std::int64_t n = 0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), n);
    if (error == std::errc{} && stop == part.data() + part.size()) {
      if (n < 0) n += std::ssize(*at);
      if (n < 0 || n >= std::ssize(*at)) return {};
      at = &at->at(static_cast<std::size_t>(n));
      continue;
    }
    const auto found = std::find_if(at->begin(), at->end(), [&](const Json& entry) {
      return entry.is_object() && entry.value("name", Json()) == part;
    });
    if (found == at->end()) return {};
    at = &*found;
  }
  return *at;
}

/// As a record keeps it. Lists and tables are no result.
std::string result_text(const std::optional<Json>& value) {
  return !value || value->is_structured() ? "" : value->dump();
}

std::string last_line(const std::string& text) {
  std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t before = text.rfind('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, end + 1 - begin);
}

std::string why_it_failed(const Json& document, const Ended& end, const std::string& stderr_text) {
  if (document.is_object() && document.contains("error")) {
    const Json& error = document["error"];
    const std::string key = error.value("key", "");
    return (key.empty() ? "" : key + ": ") + error.value("message", "");
  }
  const std::string said = last_line(stderr_text);
  if (end.signal != 0) return fmt::format("killed by signal {}", end.signal);
  return fmt::format("exit status {}{}", end.exit_status, said.empty() ? "" : ": " + said);
}

}  // namespace

SweepRuns::SweepRuns(const Options& options, const SweepSpec& spec, std::string folder)
    : options_(options),
      spec_(spec),
      folder_(std::move(folder)),
      values_(sample(spec)),
      identity_(
          identity_of(options, spec, require_model(options, spec, values_.front()), values_)) {}

/// What a run under way and its files are called.
std::string SweepRuns::stem_of(Index run) const {
  return (fs::path(folder_) / "runs" / fmt::format("{:06}", run)).string();
}

Job SweepRuns::job_of(Index run) const {
  const std::string stem = stem_of(run);
  Job job{run,
          {spec_.command, spec_.model, "--json", "--quiet", "--threads"},
          stem + ".json",
          stem + ".log"};
  job.arguments.push_back(std::to_string(std::max(1, options_.threads)));
  for (const std::string& change : overrides_of(options_, spec_, values_[run - 1]))
    job.arguments.insert(job.arguments.end(), {"--set", change});
  for (std::size_t p = 0; p < spec_.parameters.size(); ++p)
    if (sets_seed_option(spec_.parameters[p]))
      job.arguments.insert(job.arguments.end(), {seed_option, values_[run - 1][p]});
  if (options_.yes) job.arguments.emplace_back("--yes");
  for (const std::string& load : options_.ignored)
    job.arguments.insert(job.arguments.end(), {"--ignore", load});
  clear(run, Left::nothing);
  if (spec_.command != "theory") {
    // Drawings and tables of the model stand beside a result: each run has a folder for them.
    fs::create_directory(stem + ".files");
    job.arguments.insert(job.arguments.end(), {"--no-result", "-o", stem + ".files/result.vtkhdf"});
  }
  return job;
}

void SweepRuns::clear(Index run, Left left) const {
  const std::string stem = stem_of(run);
  std::error_code ignored;
  fs::remove_all(stem + ".files", ignored);
  if (left == Left::answer) return;
  fs::remove(stem + ".json", ignored);
  fs::remove(stem + ".log", ignored);
}

RunRecord SweepRuns::outcome(const Ended& end) const {
  const std::string stem = stem_of(end.run);
  RunRecord row{end.run, "failed", end.seconds, "", {}};
  const Json document = Json::parse(text_of(stem + ".json"), nullptr, false);
  if (end.limit != Limit::none) {
    row.status = "limit";
    row.error = end.limit == Limit::time
                    ? fmt::format("longer than limits.time, {:g} s", spec_.time_limit)
                    : fmt::format("more than limits.memory, {:g} bytes", spec_.memory_limit);
  } else if (end.exit_status == 0 && document.is_object()) {
    row.status = "done";
    for (const Result& result : spec_.results)
      row.results.push_back(result_text(picked(document, result.path)));
  } else {
    row.error = why_it_failed(document, end, text_of(stem + ".log"));
  }
  return row;
}

}  // namespace rockfold::sweep
