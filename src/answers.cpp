#include "src/answers.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "generated/version.hpp"
#include "src/design_files.hpp"
#include "src/examples.hpp"
#include "src/output_path.hpp"
#include "src/report/design_summary.hpp"
#include "src/report/documents.hpp"
#include "src/report/summary.hpp"
#include "src/report/table.hpp"

namespace rockfold {

namespace {

constexpr std::size_t demo_keyblocks = 10;

RunReport run_report(const Answer& answer) {
  return {answer.model, answer.blocks,    *answer.covers,
          *answer.run,  answer.keyblocks, answer.design};
}

Json answer_document(const Answer& answer) {
  const DocumentHead head{command_name(answer.options.command), answer.model.title,
                          answer.options.seed};
  if (answer.run) return run_document(head, run_report(answer));
  if (answer.keyblocks)
    return support_document(head, answer.model, answer.blocks, *answer.keyblocks, *answer.design);
  return cut_document_without_blocks(head, answer.totals, answer.blocks, *answer.measures);
}

LongList long_list(const Answer& answer) {
  if (answer.run || answer.keyblocks) return {};
  return {"blocks", answer.blocks.block_count(), [&](Index b) {
            return block_json(answer.model, answer.blocks, answer.measures->blocks, b);
          }};
}

std::string answer_text(const Answer& answer, const PhaseSeconds& seconds) {
  const bool demo = answer.options.command == Command::demo;
  std::string text = (answer.model.title.empty() ? answer.model.path : answer.model.title) + "\n\n";
  text += cut_summary(answer.totals, answer.blocks);
  const auto most = demo ? demo_keyblocks : all_keyblocks;
  if (answer.options.command == Command::cut)
    text.append("\n").append(measure_summary(*answer.measures));
  if (answer.keyblocks)
    text.append("\n").append(support_summary(*answer.keyblocks, answer.blocks, most));
  if (answer.design) text += design_summary(answer.model, *answer.keyblocks, *answer.design);
  if (answer.run) text.append("\n").append(run_summary(run_report(answer)));
  text.append("\n").append(fact("result", answer.path + "  (rockfold info, or ParaView)"));
  if (answer.design)
    for (const auto& path : design_paths(answer.model, answer.path))
      text += fact("drawing or table", path);
  for (const auto& path : answer.options.exports) text += fact("export", path);
  if (demo) text += fact("model", "rockfold examples slope  writes slope.toml");
  return text + fact("time", fmt::format("{:.2f} s", seconds.back().second));
}

void print_document(Json document, const std::vector<std::string>& warnings,
                    const PhaseSeconds& seconds, const LongList& list = {}) {
  finish_document(document, warnings, seconds);
  write_document(stdout, document, list);
}

void put(const std::string& text) {
  std::fputs(text.c_str(), stdout);
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
  if (answer.options.json)
    print_document(answer_document(answer), terminal.warnings(), seconds, long_list(answer));
  else if (!answer.options.quiet)
    put(answer_text(answer, seconds));
}

void print_theory(const Options& options, const Model& model, const TheoryReport& report,
                  Terminal& terminal, const PhaseSeconds& seconds) {
  const DocumentHead head{command_name(options.command), model.title, options.seed};
  if (options.json)
    print_document(theory_document(head, report), terminal.warnings(), seconds);
  else if (!options.quiet)
    put((model.title.empty() ? model.path : model.title) + "\n\n" + theory_summary(report) + "\n" +
        fact("time", fmt::format("{:.2f} s", seconds.back().second)));
}

void print_check(const Options& options, const Model& model,
                 const std::vector<NamedExtent>& extents, Terminal& terminal) {
  if (options.json)
    print_document(check_document({"check", model.title, options.seed}, model, extents),
                   terminal.warnings(), {});
  else if (!options.quiet)
    put(check_summary(model, extents));
}

void print_info(const Options& options, const ResultInfo& info) {
  if (options.json)
    print_document(info_document(info, options.input), {}, {});
  else
    put(info_summary(info, options.input));
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
  if (options.json)
    print_document(document, {}, {});
  else
    put(text);
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
  clock.add("contact", 0.0);
  clock.add("assemble", run.seconds.assemble);
  clock.add("solve", run.seconds.solve);
  clock.add("output", run.seconds.output);
}

}  // namespace rockfold
