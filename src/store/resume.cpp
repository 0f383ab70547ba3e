#include "src/store/resume.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "generated/version.hpp"
#include "host/files/load_files.hpp"
#include "src/base/error.hpp"

namespace fs = std::filesystem;

namespace rockfold {

namespace {

[[noreturn]] void fail(ErrorKind kind, const Place& place, const std::string& what) {
  throw Error(kind, what, place);
}

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string line_at(const std::string& text, std::size_t begin) {
  return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
}

/// Names the first line in which they differ.
void require_same_text(const std::string& path, const std::string& then, const std::string& now) {
  if (then == now) return;
  const auto same = static_cast<std::size_t>(
      std::mismatch(then.begin(), then.end(), now.begin(), now.end()).first - then.begin());
  const auto before = then.rfind('\n', same == 0 ? 0 : same - 1);
  const std::size_t begin = same == 0 || before == std::string::npos ? 0 : before + 1;
  const auto line = 1 + std::count(then.begin(), then.begin() + static_cast<long>(begin), '\n');
  fail(ErrorKind::model, Place{path, static_cast<int>(line), 1, {}},
       fmt::format("the model has changed since the run was started: found '{}', was '{}'; run it "
                   "anew, or bring the old text back",
                   line_at(now, std::min(begin, now.size())), line_at(then, begin)));
}

/// Lengths may change on the way; anything else would change what has been computed.
void require_changes_of_length(const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    const std::string key = text.substr(0, text.find('='));
    if (key.ends_with(".end_time") || key.ends_with(".steps") || key == "output.checkpoint_every")
      continue;
    fail(ErrorKind::usage, Place{"--set " + text, 0, 0, key},
         "would change what the run has computed; `resume` takes analysis.end_time, "
         "analysis.steps, those of a [[step]], and output.checkpoint_every");
  }
}

/// The model's path from where the program runs now.
std::string present_path(const RunOrigin& origin) {
  std::error_code ignored;
  const fs::path then = fs::path(origin.folder) / origin.model;
  return fs::equivalent(origin.model, then, ignored) ? origin.model : then.string();
}

Options options_of_run(const Options& now, const RunOrigin& origin) {
  Options options = now;
  options.command = origin.command == "demo" ? Command::demo : Command::run;
  options.output = now.input;
  options.input = origin.model.empty() ? "" : present_path(origin);
  options.exports = origin.exports;
  options.table = origin.table;
  options.report = origin.report;
  options.ignored = origin.ignored;
  options.overrides = origin.overrides;
  options.overrides.insert(options.overrides.end(), now.overrides.begin(), now.overrides.end());
  options.seed = origin.seed;
  std::error_code ignored;
  if (options.input.empty()) return options;
  if (fs::exists(options.input, ignored))
    require_same_text(options.input, origin.text, text_of(options.input));
  options.model_text = origin.text;
  return options;
}

void require_same_program(const RunOrigin& origin, const std::string& path) {
  if (origin.version == version && origin.commit == commit) return;
  fail(
      ErrorKind::io, Place{path, 0, 0, {}},
      fmt::format("was begun by rockfold {} ({}), this is {} ({}): go on with that one, or run the "
                  "model anew",
                  origin.version, origin.commit, version, commit));
}

StoredState state_from(const std::string& result, const JournalState& state) {
  try {
    return unpacked_state(read_state(result, state));
  } catch (const std::runtime_error& error) {
    fail(ErrorKind::io, Place{journal_path(result), 0, 0, {}},
         fmt::format("is damaged: step {} cannot be read ({})", state.step, error.what()));
  }
}

CheckpointFacts facts_of(const std::string& result, const JournalContents& journal) {
  if (!journal.checkpoint) return make_checkpoint_facts(0, 0, 0);
  try {
    return checkpoint_facts(*journal.checkpoint);
  } catch (const std::runtime_error& error) {
    fail(ErrorKind::io, Place{checkpoint_path(result), 0, 0, {}},
         fmt::format("cannot be gone on from ({})", error.what()));
  }
}

}  // namespace

RunOrigin run_origin(const Options& options, const Model& model) {
  RunOrigin origin;
  origin.version = version;
  origin.commit = commit;
  origin.command = command_name(options.command);
  origin.model = options.input;
  origin.folder = fs::current_path().string();
  if (!options.input.empty()) origin.text = options.model_text.value_or(text_of(options.input));
  origin.overrides = options.overrides;
  origin.ignored = options.ignored;
  origin.exports = options.exports;
  origin.table = options.table;
  origin.report = options.report;
  origin.seed = options.seed;
  for (const std::string& file : files_named_by(model)) origin.inputs.push_back(fingerprint(file));
  return origin;
}

std::optional<Resumption> find_run(const Options& options) {
  const std::string& result = options.input;
  require_changes_of_length(options.overrides);
  std::optional<JournalContents> journal = read_journal(result);
  if (!journal) {
    if (std::filesystem::exists(journal_path(result)) && !std::filesystem::exists(result))
      fail(ErrorKind::io, Place{journal_path(result), 0, 0, {}},
           "is of a run that was stopped before it had kept anything: run its model again");
    std::optional<RunOrigin> origin = read_stored_origin(result);
    if (options.overrides.empty()) return {};
    if (!origin)
      fail(ErrorKind::io, Place{result, 0, 0, {}}, "holds no run that could go on: run its model");
    journal.emplace().origin = std::move(*origin);  // from the start, to another end
  }
  if (options.seed && options.seed != journal->origin.seed)
    fail(ErrorKind::usage, Place{}, "--seed would change what the run has computed");
  require_same_program(journal->origin, journal_path(result));
  return Resumption{options_of_run(options, journal->origin), std::move(*journal)};
}

void require_same_inputs(const RunOrigin& origin, const Model& model) {
  const std::vector<std::string> files = files_named_by(model);
  for (std::size_t i = 0; i < std::min(files.size(), origin.inputs.size()); ++i) {
    const RunOrigin::Input now = fingerprint(files[i]), then = origin.inputs[i];
    if (now.hash != then.hash || now.bytes != then.bytes)
      fail(
          ErrorKind::model, Place{files[i], 0, 0, {}},
          fmt::format("has changed since the run was started: found {} bytes, hash {:016x}; was {} "
                      "bytes, hash {:016x}",
                      now.bytes, now.hash, then.bytes, then.hash));
  }
}

std::unique_ptr<RunJournal> open_journal(const Options& options, const Model& model,
                                         const std::string& result, const Resumption* resumption,
                                         const StoreState& store,
                                         const std::vector<std::byte>& search) {
  if (!resumption || resumption->journal.end == 0) {
    RunOrigin origin = run_origin(options, model);
    origin.search = search;
    return std::make_unique<RunJournal>(result, origin);
  }
  const JournalContents& journal = resumption->journal;
  const auto states = static_cast<std::size_t>(facts_of(result, journal).states);
  if (states > journal.states.size())
    fail(ErrorKind::io, Place{journal_path(result), 0, 0, {}},
         fmt::format("is damaged: {} states can be read, the checkpoint has {}",
                     journal.states.size(), states));
  auto opened = std::make_unique<RunJournal>(result, journal, states);
  for (std::size_t s = 0; s < states; ++s) store(state_from(result, journal.states[s]));
  return opened;
}

Checkpoints checkpoints_in(RunJournal& journal, const Model& model, const Resumption* resumption) {
  Checkpoints checkpoints;
  checkpoints.save = [&journal](std::span<const std::byte> bytes) {
    journal.save_checkpoint(bytes);
  };
  checkpoints.every = model.output.checkpoint_every;
  if (resumption && resumption->journal.checkpoint)
    checkpoints.from = *resumption->journal.checkpoint;
  return checkpoints;
}

std::string unfinished_run(const std::string& result) {
  try {
    const std::optional<JournalContents> journal = read_journal(result);
    if (!journal) return "";
    const CheckpointFacts facts = facts_of(result, *journal);
    if (facts.steps == 0) return "";
    return fmt::format(
        "{}: the run that ended at step {}, {:.6g} s, is thrown away; `rockfold resume {}` would "
        "have gone on with it",
        journal_path(result), facts.steps, facts.time, result);
  } catch (const Error&) {
    return "";  // nothing that could go on
  }
}

ResultInfo info_of_result(const std::string& path) {
  const std::optional<JournalContents> journal = read_journal(path);
  std::error_code ignored;
  if (!journal) return read_result_info(path);
  ResultInfo info;
  if (fs::exists(path, ignored)) info = read_result_info(path);
  if (info.step.size() < journal->states.size()) {
    info = {};
    info.command = journal->origin.command;
    info.version = journal->origin.version;
    info.commit = journal->origin.commit;
    info.model_text = journal->origin.text;
    for (const JournalState& state : journal->states) {
      info.step.push_back(state.step);
      info.time.push_back(state.time);
      info.hash.push_back(state.hash);
    }
  }
  const CheckpointFacts facts = facts_of(path, *journal);
  info.unfinished = ResultInfo::Unfinished{journal_path(path), facts.steps, facts.time};
  return info;
}

}  // namespace rockfold
