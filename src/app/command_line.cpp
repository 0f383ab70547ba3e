#include "src/app/command_line.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "generated/version.hpp"
#include "host/survey/mixture.hpp"
#include "src/app/help_text.hpp"
#include "src/base/error.hpp"
#include "src/io/exports/export.hpp"
#include "src/model/text/nearest.hpp"
#include "src/model/text/numbers/units.hpp"

namespace rockfold {

namespace {

constexpr std::uint64_t most_tasks = 1'000'000;  // Slurm's own limit of an array is 4 million
constexpr int most_threads = 4096;  // above any machine of today; catches a mistyped number

[[noreturn]] void reject(const std::string& what) {
  throw Error(ErrorKind::usage, what);
}

std::uint64_t whole_number(const std::string& option, const std::string& text, std::uint64_t least,
                           std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc{} || end != text.data() + text.size() || value < least || value > most)
    reject(fmt::format("{}: '{}' is no whole number from {} to {}", option, text, least, most));
  return value;
}

/// "600", "10 min", "4 GB"; `unit` as for number_with_unit().
Real amount(const std::string& option, const std::string& text, const char* unit) {
  Real number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool alone = failure == std::errc{} && end == text.data() + text.size();
  const Real value = alone ? number : number_with_unit(text, unit).value_or(0);
  if (!(value > 0) || !std::isfinite(value))
    reject(fmt::format("{}: '{}' is no number of {} above 0{}", option, text, unit,
                       other_units(unit)));
  return value;
}

/// Every option may stand before or after the command.
void add_common_options(CLI::App& app, Options& options) {
  app.set_help_flag("--help,-h");
  app.add_flag("--json", options.json);
  app.add_flag("--quiet,-q", options.quiet);
  app.add_flag("--yes,-y", options.yes);
  app.add_option_function<std::string>("--threads", [&options](const std::string& text) {
    if (options.threads > 0) reject("--threads is given twice");  // before and after the command
    options.threads = static_cast<int>(whole_number("--threads", text, 1, most_threads));
  });
  app.add_option_function<std::string>("--seed", [&options](const std::string& text) {
    if (options.seed) reject("--seed is given twice");
    options.seed = whole_number("--seed", text, 0, std::numeric_limits<std::uint64_t>::max());
  });
  app.add_option_function<std::vector<std::string>>(
         "--set",
         [&options](const std::vector<std::string>& more) {
           options.overrides.insert(options.overrides.end(), more.begin(), more.end());
         })
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option_function<std::vector<std::string>>(
         "--ignore",
         [&options](const std::vector<std::string>& more) {
           options.ignored.insert(options.ignored.end(), more.begin(), more.end());
         })
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option_function<std::string>("--max-time", [&options](const std::string& text) {
    options.max_time = amount("--max-time", text, "s");
  });
  app.add_option_function<std::string>("--max-memory", [&options](const std::string& text) {
    options.max_memory = amount("--max-memory", text, "bytes");
  });
  app.add_option_function<std::string>("--json-file", [&options](const std::string& name) {
    if (!options.json_file.empty()) reject("--json-file is given twice");
    if (name.empty()) reject("--json-file needs the name of a file");
    options.json_file = name;
  });
  app.add_option_function<std::string>("--log", [&options](const std::string& name) {
    if (!options.log_file.empty()) reject("--log is given twice");
    if (name.empty()) reject("--log needs the name of a file");
    options.log_file = name;
  });
  app.add_option_function<std::string>("--progress-fd", [&options](const std::string& text) {
    options.progress_descriptor =
        static_cast<int>(whole_number("--progress-fd", text, 1, std::numeric_limits<int>::max()));
  });
}

void add_output_option(CLI::App& command, Options& options) {
  command.add_option("-o,--output", options.output)->check([](const std::string& name) {
    return name.empty() ? std::string("needs the name of a file") : std::string();
  });
}

void add_view_options(CLI::App& command, Options& options) {
  add_output_option(command, options);
  command.add_option_function<std::string>("--every", [&options](const std::string& text) {
    options.every =
        static_cast<Index>(whole_number("--every", text, 1, std::numeric_limits<Index>::max()));
  });
  command.add_flag("--surface-only", options.surface_only);
}

/// "3/10"
std::pair<Index, Index> part_from(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos)
    reject(fmt::format("--part: '{}' is no part as 3/10, the third of ten", text));
  const auto parts = whole_number("--part", text.substr(slash + 1), 1, most_tasks);
  return {static_cast<Index>(whole_number("--part", text.substr(0, slash), 1, parts)),
          static_cast<Index>(parts)};
}

void add_sweep_options(CLI::App& command, Options& options) {
  add_output_option(command, options);
  const auto number = [&](const char* name, int& target, std::uint64_t most) {
    command.add_option_function<std::string>(name, [name, &target, most](const std::string& text) {
      target = static_cast<int>(whole_number(name, text, 1, most));
    });
  };
  number("--workers", options.workers, most_threads);
  number("--slurm", options.slurm_tasks, most_tasks);
  command.add_option_function<std::string>(
      "--part", [&options](const std::string& text) { options.part = part_from(text); });
  command.add_flag("--gather", options.gather);
}

/// "045/10", of a line that goes down by 10 deg.
std::pair<Real, Real> line_from(const std::string& text) {
  const auto number = [](const std::string& part) -> std::optional<Real> {
    Real value = 0;
    const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (failure != std::errc{} || end != part.data() + part.size()) return {};
    return value;
  };
  const auto slash = text.find('/');
  const auto trend = number(text.substr(0, slash));
  const auto plunge =
      slash == std::string::npos ? std::optional<Real>{} : number(text.substr(slash + 1));
  if (!trend || !plunge || !(*trend >= 0 && *trend <= 360) || !(std::abs(*plunge) <= 90))
    reject(
        fmt::format("--scanline: '{}' is no trend and plunge as 045/10: 0 to 360 and -90 to 90 "
                    "degrees",
                    text));
  return {*trend, *plunge};
}

/// deg
Real blind_zone_from(const std::string& text) {
  Real value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc{} || end != text.data() + text.size() || !(value > 0 && value < 90))
    reject(fmt::format("--blind-zone: '{}' is no angle above 0 and below 90 degrees", text));
  return value;
}

void add_sets_options(CLI::App& command, Options& options) {
  const auto file = [&](const std::string& name, const std::string& ending, std::string& target) {
    return [name, ending, &target](const std::string& text) {
      if (!text.ends_with(ending) || text == ending)
        reject(
            fmt::format("{}: '{}' must be the name of a file that ends in {}", name, text, ending));
      target = text;
    };
  };
  command.add_option_function<std::string>("-o,--output",
                                           file("--output", ".toml", options.output));
  command.add_option_function<std::string>("--picture", file("--picture", ".svg", options.picture));
  command.add_option_function<std::string>(
      "--scanline", [&](const std::string& text) { options.scanline = line_from(text); });
  command.add_option_function<std::string>(
      "--blind-zone", [&](const std::string& text) { options.blind_zone = blind_zone_from(text); });
  command.add_option_function<std::string>("--sets", [&](const std::string& text) {
    options.find_sets = true;
    if (text != "auto") options.set_count = whole_number("--sets", text, 1, most_sets);
  });
  command.add_flag("--left-hand", options.left_hand);
}

/// What one call of `sweep` cannot do together.
void require_one_mode(const Options& options) {
  const int modes = (options.part.first > 0) + (options.slurm_tasks > 0) + options.gather;
  if (modes > 1) reject("--part, --slurm and --gather exclude each other");
  if (options.no_result && options.report)
    reject("--no-result leaves nothing that --report could be made of");
}

void add_commands(CLI::App& app, Options& options) {
  for (const auto& help : command_helps()) {
    auto* sub = app.add_subcommand(help.name, help.brief);
    sub->allow_extras();
    if (*help.input) sub->add_option("input", options.input);
    if (writes_results(help.command)) {
      sub->add_option_function<std::vector<std::string>>(
             "--export",
             [&options](const std::vector<std::string>& more) {
               options.exports.insert(options.exports.end(), more.begin(), more.end());
             })
          ->type_size(1)
          ->allow_extra_args(false);
      add_output_option(*sub, options);
      sub->add_flag("--force", options.force);
      if (lists_keyblocks(help.command))
        sub->add_option_function<std::string>("--table", [&options](const std::string& name) {
          if (name.empty()) reject("--table needs the name of a file");
          if (!name.ends_with(".csv"))
            reject(fmt::format("--table: the table is CSV; '{}' must end in .csv", name));
          options.table = name;
        });
      if (help.command == Command::stability)
        sub->add_option_function<std::string>("--certificate", [&options](const std::string& name) {
          if (name.empty()) reject("--certificate needs the name of a file");
          options.certificate = name;
        });
      if (may_leave_result(help.command)) sub->add_flag("--no-result", options.no_result);
    }
    if (help.command == Command::view) add_view_options(*sub, options);
    if (help.command == Command::report) add_output_option(*sub, options);
    if (makes_report(help.command)) sub->add_flag("--report", options.report);
    if (help.command == Command::sweep) add_sweep_options(*sub, options);
    if (help.command == Command::sets) add_sets_options(*sub, options);
    if (help.command == Command::check) sub->add_flag("--estimate", options.estimate);
    if (help.command == Command::info) sub->add_flag("--hashes", options.hashes);
    add_common_options(*sub, options);
    sub->callback([&options, &help] { options.command = help.command; });
  }
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const auto& help : command_helps()) names.emplace_back(help.name);
  return names;
}

[[noreturn]] void reject_command(const std::string& word) {
  reject(fmt::format("unknown command '{}'{}", word,
                     suggestion(word, command_names(), "the commands are")));
}

[[noreturn]] void reject_argument(const CLI::App& command, const std::string& word) {
  if (word.size() < 2 || word[0] != '-')
    reject(fmt::format("unexpected argument '{}' after '{}'", word, command.get_name()));
  std::vector<std::string> names;
  for (const auto* option : command.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  const auto typed = word.substr(0, word.find('='));
  reject(fmt::format("unknown option '{}'{}", typed, suggestion(typed, names, "the options are")));
}

/// CLI11 leaves over what it does not know; these are the messages for it.
void reject_unknown(const CLI::App& app) {
  const auto given = app.get_subcommands();
  if (given.empty()) {
    for (const auto& word : app.remaining())
      if (word.empty() || word[0] != '-') reject_command(word);
    for (const auto& word : app.remaining()) reject_argument(app, word);
    reject("no command given" + suggestion("", command_names(), "the commands are"));
  }
  if (given.size() > 1)
    reject(fmt::format("two commands given: '{}' and '{}'", given[0]->get_name(),
                       given[1]->get_name()));
  for (const auto& word : app.remaining()) reject_argument(app, word);
  for (const auto& word : given[0]->remaining()) reject_argument(*given[0], word);
}

void require_input(const Options& options) {
  const auto& help = command_help(options.command);
  if (options.input.empty() && *help.input && *help.input != '[')
    reject(fmt::format("no file given: rockfold {} {}", help.name, help.input));
}

/// A model from standard input has no name that its result could have.
void require_output(const Options& options) {
  if (options.input != "-" || !writes_results(options.command)) return;
  if (options.output.empty() && !options.no_result)
    reject(
        "a model from standard input has no name: say with -o where its result goes, or that "
        "there is none with --no-result");
}

std::string help_asked(const CLI::App& app) {
  const auto given = app.get_subcommands();
  if (given.empty()) return program_help();
  for (const auto& help : command_helps())
    if (given.back()->get_name() == help.name) return command_help_text(help);
  return program_help();
}

/// `rockfold help`, `rockfold help COMMAND`, as of other programs.
std::string help_on(const std::string& word) {
  for (const auto& help : command_helps())
    if (word == help.name) return command_help_text(help);
  if (!word.empty() && word[0] != '-') reject_command(word);
  return program_help();
}

}  // namespace

std::string command_name(Command command) {
  return command_help(command).name;
}

bool wants_json(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--") return false;
    if (std::string_view(argv[i]) == "--json") return true;
  }
  return false;
}

Options parse_command_line(int argc, const char* const* argv) {
  int word = 1;
  while (word < argc && argv[word][0] == '-') ++word;
  if (word < argc && std::string_view(argv[word]) == "help")
    throw Notice{help_on(word + 1 < argc ? argv[word + 1] : "")};
  Options options;
  CLI::App app("", "rockfold");
  app.allow_extras();
  app.require_subcommand(0);
  add_common_options(app, options);
  app.set_version_flag("--version,-V", fmt::format("rockfold {} ({})\n", version, commit));
  add_commands(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw Notice{help_asked(app)};
  } catch (const CLI::CallForVersion& version_asked) {
    throw Notice{version_asked.what()};
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string what = error.what();
    const bool too_many = what.find("At Most") != std::string::npos;
    reject(what.substr(0, what.find(':')) + (too_many ? " is given twice" : " needs a value"));
  } catch (const CLI::ParseError& error) {
    reject(error.what());
  }
  reject_unknown(app);
  require_input(options);
  require_output(options);
  require_one_mode(options);
  for (const auto& path : options.exports) export_format(path);  // throws for one that is not known
  return options;
}

}  // namespace rockfold
