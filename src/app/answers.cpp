#include "src/app/answers.hpp"

#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "generated/version.hpp"
#include "src/app/certificates.hpp"
#include "src/app/examples.hpp"
#include "src/app/process/limits.hpp"
#include "src/app/process/signals.hpp"
#include "src/check/key_use.hpp"
#include "src/io/partial_file.hpp"
#include "src/report/documents/documents.hpp"
#include "src/report/documents/marks.hpp"
#include "src/report/error_text.hpp"
#include "src/report/shaken_blocks.hpp"
#include "src/report/summaries/design_summary.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"
#include "src/store/design_files.hpp"
#include "src/store/output_path.hpp"

namespace rockfold {

namespace {

RunReport run_report(const Answer& answer) {
  return {answer.model,     answer.blocks, *answer.covers,  *answer.run,
          answer.keyblocks, answer.design, answer.reduction};
}

Json answer_document(const Answer& answer, BlockList list = BlockList::whole) {
  const DocumentHead head{command_name(answer.options.command), answer.model.title,
                          answer.options.seed};
  if (answer.options.command == Command::stability) {
    Json document = stability_document(head, answer.blocks, *answer.stability);
    add_specks(document, answer.totals);
    add_body_fit(document, answer.model);
    return document;
  }
  if (!answer.run && !answer.keyblocks) {
    Json cut = cut_document_without_blocks(head, answer.totals, answer.blocks, *answer.measures);
    add_body_fit(cut, answer.model);
    return cut;
  }
  Json document = answer.run ? run_document(head, run_report(answer), list)
                             : support_document(head, answer.model, answer.blocks,
                                                *answer.keyblocks, *answer.design, list);
  if (answer.stability) document["stability"] = stability_json(*answer.stability);
  add_specks(document, answer.totals);
  add_body_fit(document, answer.model);
  return document;
}

LongList long_list(const Answer& answer) {
  if (answer.run || answer.keyblocks || answer.stability) return {};
  return {"blocks", answer.blocks.block_count(), [&](Index b) {
            return block_json(answer.model, answer.blocks, answer.measures->blocks, b);
          }};
}

/// What of the model the command did not use.
std::string unused_fact(const std::vector<std::string>& unused) {
  return unused.empty() ? "" : fact("not used here", fmt::format("{}", fmt::join(unused, ", ")));
}

std::string page_fact(const std::string& path) {
  return fact("page", path + "  (open it in a browser: double-click, or file://" +
                          std::filesystem::absolute(path).string() + ")");
}

std::string report_fact(const std::string& path) {
  return fact("report", path + "  (open it in a browser and print it)");
}

/// As exact as it is.
std::string estimate_facts(const Estimate& estimate, bool contact) {
  const std::string tried = estimate.steps > 0 ? fmt::format(" ({} of {} steps were tried)",
                                                             estimate.tried, estimate.steps)
                                               : "";
  return fact("estimate",
              fmt::format("`rockfold {}` takes about {} and {}{}{}", estimate.command,
                          size_text(estimate.memory),
                          estimate.seconds < 120 ? fmt::format("{:.2g} s", estimate.seconds)
                                                 : fmt::format("{:.2g} min", estimate.seconds / 60),
                          contact ? " or more: contact costs more once blocks slide" : "", tried)) +
         (estimate.not_tried_from
              ? fact("",
                     fmt::format("supports or loads that begin to move at t = {:.4g} s are not in "
                                 "it: steps from there on may take longer",
                                 *estimate.not_tried_from))
              : "");
}

std::string page_summary(const std::string& path, const PageFacts& facts) {
  std::string text = page_fact(path);
  text += fact("size", fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(facts.bytes)));
  text += fact("blocks", facts.shown_blocks == facts.blocks
                             ? fmt::format("{}", facts.blocks)
                             : fmt::format("{} of {}: the others lie inside the rock",
                                           facts.shown_blocks, facts.blocks));
  return text + fact("states", fmt::format("{}", facts.states));
}

std::string answer_text(const Answer& answer, const PhaseSeconds& seconds) {
  const bool demo = answer.options.command == Command::demo;
  std::string text = (answer.model.title.empty() ? answer.model.path : answer.model.title) + "\n\n";
  if (answer.model.body_fit) text += bodies_summary(*answer.model.body_fit);
  text += cut_summary(answer.totals, answer.blocks);
  if (answer.options.command == Command::cut)
    text.append("\n").append(measure_summary(*answer.measures));
  if (answer.options.command == Command::stability)
    text.append("\n").append(stability_summary(*answer.stability, answer.blocks));
  if (answer.keyblocks)
    text.append("\n").append(support_summary(*answer.keyblocks, answer.blocks, answer.stability));
  if (answer.design) text += design_summary(answer.model, *answer.keyblocks, *answer.design);
  if (answer.reduction) text.append("\n").append(reduction_summary(run_report(answer)));
  if (answer.run) text.append("\n").append(run_summary(run_report(answer)));
  if (answer.run && has_confirmed(run_report(answer)))
    text.append("\n").append(confirmed_summary(run_report(answer)));
  if (answer.run && is_shaken(run_report(answer)))
    text.append("\n").append(shaken_summary(run_report(answer)));
  text += "\n";
  if (!answer.options.no_result) {
    text += fact("result", answer.path + "  (rockfold info, or ParaView 5.13)");
    text += fact("", xdmf_path(answer.path) + "  (ParaView 5.11 and 5.12)");
  }
  const Made made{answer.design != nullptr, answer.run != nullptr};
  for (const DesignFile& file : design_files(answer.model, answer.path, made))
    text += fact("drawing or table", file.path);
  for (const auto& path : answer.options.exports) text += fact("export", path);
  if (!answer.options.certificate.empty() && has_certificate(*answer.stability))
    text += fact("certificate", answer.options.certificate + "  (rockfold verify)");
  if (demo && has_page()) text += page_fact(page_path(answer.options));
  if (answer.options.report) text += report_fact(report_path(answer.options));
  if (demo) text += fact("model", "rockfold examples slope  writes slope.toml");
  text += unused_fact(answer.unused);
  return text + fact("time", fmt::format("{:.2f} s", seconds.back().second));
}

void put(const std::string& text) {
  std::fputs(text.c_str(), stdout);
}

void write_document_file(const std::string& path, const Json& document, const LongList& list) {
  PartialFile target(path);
  std::FILE* file = std::fopen(target.aside().c_str(), "wb");
  if (file) write_document(file, document, list);
  const bool good = file && std::ferror(file) == 0;
  if ((file && std::fclose(file) != 0) || !good)
    throw Error(ErrorKind::io, "cannot be written", Place{path, 0, 0, ""});
  target.take_name();
}

/// A document on stdout or the summary, and the document in a file where --json-file asks for it.
template <class MakeDocument, class MakeSummary>
void deliver(const Options& options, const std::vector<std::string>& warnings,
             const PhaseSeconds& seconds, const LongList& list, const MakeDocument& make_document,
             const MakeSummary& make_summary) {
  if (options.json || !options.json_file.empty()) {
    Json document = make_document();
    finish_document(document, warnings, seconds);
    if (!options.json_file.empty()) write_document_file(options.json_file, document, list);
    if (options.json) {
      answer_begins();
      return write_document(stdout, document, list);
    }
  }
  if (!options.quiet) put(make_summary());
}

void add_limit(Json& document, const std::optional<Error>& limit) {
  if (limit) document["error"] = error_document(*limit)["error"];
}

/// Below a summary; the document says it itself.
void tell_limit(const Options& options, const std::optional<Error>& limit, Terminal& terminal) {
  if (!limit) return;
  std::fflush(stdout);
  for (const std::string& line : error_lines(*limit))
    if (options.json)
      terminal.log(line);
    else
      terminal.error_line(line);
}

Json examples_document() {
  Json list = Json::array();
  for (const auto& example : examples())
    list.push_back({{"name", example.name}, {"summary", example.summary}});
  return list;
}

std::string examples_text() {
  std::vector<std::vector<std::string>> rows;
  for (const auto& example : examples())
    rows.push_back({std::string(example.name), std::string(example.summary)});
  return table_text({{"name", "", true}, {"shows", "", true}}, rows) +
         "\n  rockfold examples NAME  writes NAME.toml and the files that it names\n";
}

/// Writes the model and the files that it names; returns their names, the model's first.
std::vector<std::string> write_example(const Example& example) {
  std::vector<std::pair<std::string, std::string>> files{
      {fmt::format("{}.toml", example.name), std::string(example.text)}};
  for (const auto& file : example.files) files.emplace_back(file.name, file.text);
  write_new_files(files);
  std::vector<std::string> names;
  for (auto& [name, text] : files) names.push_back(std::move(name));
  return names;
}

}  // namespace

void print_answer(const Answer& answer, Terminal& terminal, const PhaseSeconds& seconds) {
  const auto document = [&] {
    Json made = answer_document(answer);
    made["unused"] = answer.unused;
    add_limit(made, answer.limit);
    return made;
  };
  deliver(answer.options, terminal.warnings(), seconds, long_list(answer), document,
          [&] { return answer_text(answer, seconds); });
  tell_limit(answer.options, answer.limit, terminal);
}

void print_search(const Options& options, const Model& model, const Reduction& reduction,
                  const std::optional<Error>& limit, Terminal& terminal) {
  const auto document = [&] {
    Json made =
        search_document({command_name(options.command), model.title, options.seed}, reduction);
    add_limit(made, limit);
    return made;
  };
  deliver(options, terminal.warnings(), {}, {}, document, [&] {
    return (model.title.empty() ? model.path : model.title) + "\n\n" + search_summary(reduction);
  });
  tell_limit(options, limit, terminal);
}

std::string stored_answer(const Answer& answer, const std::vector<std::string>& warnings) {
  Json document = answer_document(answer, BlockList::left_out);
  document["unused"] = answer.unused;
  document["warnings"] = warnings;
  document["setup"] = setup_json(answer.model, answer.keyblocks != nullptr, answer.run != nullptr);
  document["marks"] = marks_json(answer.model, answer.blocks);
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string whole_answer(const Answer& answer, const Terminal& terminal) {
  Json document = answer_document(answer);
  document["unused"] = answer.unused;
  finish_document(document, terminal.warnings(), {});
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void print_made(const Options& options, const std::vector<std::string>& warnings,
                const Json& document, const std::string& summary) {
  deliver(
      options, warnings, {}, {}, [&] { return document; }, [&] { return summary; });
}

void print_finished(const Options& options, const std::string& text) {
  Json stored = Json::parse(text);
  deliver(
      options, stored.value("warnings", std::vector<std::string>{}), {}, {}, [&] { return stored; },
      [&] {
        return fact("finished",
                    fmt::format("{} steps, t = {:g} s", stored["totals"].value("steps", 0),
                                stored["totals"].value("time", 0.0))) +
               fact("result", options.input + "  (rockfold info, or ParaView)");
      });
}

PageChoice page_choice(const Options& options) {
  return {options.every, options.surface_only};
}

void print_page(const Options& options, const std::string& path, const PageFacts& facts) {
  const auto document = [&] {
    Json made = head_json({"view", "", options.seed});
    made["page"] = path;
    made["bytes"] = facts.bytes;
    made["blocks"] = facts.shown_blocks;
    made["triangles"] = facts.triangles;
    made["states"] = facts.states;
    return made;
  };
  deliver(options, {}, {}, {}, document, [&] { return page_summary(path, facts); });
}

void print_report(const Options& options, const std::string& path, const PrintedFacts& facts) {
  const auto document = [&] {
    Json made = head_json({"report", "", options.seed});
    made["report"] = path;
    made["bytes"] = facts.bytes;
    made["views"] = facts.views;
    return made;
  };
  deliver(options, {}, {}, {}, document, [&] {
    return report_fact(path) +
           fact("size", fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(facts.bytes))) +
           (facts.views ? "" : fact("views", "none: this result or this program has none"));
  });
}

void print_theory(const Options& options, const Model& model, const TheoryReport& report,
                  Terminal& terminal, const PhaseSeconds& seconds) {
  const auto unused = unused_keys(options, model);
  const auto document = [&] {
    Json made = theory_document({command_name(options.command), model.title, options.seed}, report);
    made["unused"] = unused;
    return made;
  };
  deliver(options, terminal.warnings(), seconds, {}, document, [&] {
    return (model.title.empty() ? model.path : model.title) + "\n\n" + theory_summary(report) +
           "\n" + unused_fact(unused) +
           fact("time", fmt::format("{:.2f} s", seconds.back().second));
  });
}

void print_check(const Options& options, const Model& model,
                 const std::vector<NamedExtent>& extents, const Estimate* estimate,
                 Terminal& terminal) {
  const auto document = [&] {
    Json made = check_document({"check", model.title, options.seed}, model, extents);
    if (estimate)
      made["estimate"] = {{"command", estimate->command},
                          {"memory", estimate->memory},
                          {"seconds", estimate->seconds},
                          {"steps", estimate->steps},
                          {"steps_tried", estimate->tried}};
    if (estimate && estimate->not_tried_from)
      made["estimate"]["not_tried_from"] = *estimate->not_tried_from;
    return made;
  };
  deliver(options, terminal.warnings(), {}, {}, document, [&] {
    return check_summary(model, extents) +
           (estimate ? estimate_facts(*estimate, has_contact(model)) : "");
  });
}

void print_info(const Options& options, const ResultInfo& info) {
  Options always = options;  // what was asked for is the answer, and there is no other
  always.quiet = false;
  const auto hashes = [&] {
    std::string text;
    if (!options.hashes) return text;
    const auto texts = hash_texts(info);
    for (std::size_t s = 0; s < texts.size(); ++s)
      text += fmt::format("  step {:<8} {}\n", info.step[s], texts[s]);
    return text;
  };
  deliver(
      always, {}, {}, {}, [&] { return info_document(info, options.input); },
      [&] { return info_summary(info, options.input) + hashes(); });
}

int hand_out_examples(const Options& options) {
  Json document = head_json({"examples", "", options.seed});
  std::string text;
  if (options.input.empty()) {
    document["examples"] = examples_document();
    text = examples_text();
  } else {
    const auto& example = find_example(options.input);
    const auto files = write_example(example);
    document["written"] = files.front();
    document["files"] = files;
    if (!options.quiet) {
      text = fmt::format("{}: {}\n", files.front(), example.summary);
      if (files.size() > 1)
        text += fmt::format("with it: {}\n", fmt::join(files.begin() + 1, files.end(), ", "));
    }
  }
  Options always = options;
  always.quiet = false;
  deliver(
      always, {}, {}, {}, [&] { return document; }, [&] { return text; });
  return 0;
}

ResultHeader result_header(const Options& options) {
  return {command_name(options.command), version, commit};
}

void keep_states(ResultWriter& writer, ErrorKind why, Terminal& terminal) {
  if (writer.state_count() == 0) return;
  writer.finish();
  const Index states = writer.state_count();
  const std::string kept = states == 1 ? "the state" : "the " + std::to_string(states) + " states";
  if (why == ErrorKind::io)
    terminal.warn(fmt::format("no more results could be written; {} holds {} before that",
                              writer.path(), kept));
  else
    terminal.warn(
        fmt::format("the analysis failed; {} holds {} before it did", writer.path(), kept));
}

void add_run_seconds(PhaseClock& clock, const RunResult& run) {
  clock.add("contact", run.seconds.contact);
  clock.add("assemble", run.seconds.assemble);
  clock.add("solve", run.seconds.solve);
  clock.add("output", run.seconds.output);
}

}  // namespace rockfold
