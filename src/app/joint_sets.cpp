#include "src/app/joint_sets.hpp"

#include <filesystem>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/files/data_file.hpp"
#include "host/files/faults.hpp"
#include "host/files/foreign_format.hpp"
#include "host/survey/joint_sets.hpp"
#include "src/app/answers.hpp"
#include "src/base/error.hpp"
#include "src/io/exports/text_file.hpp"
#include "src/report/documents/sets_document.hpp"
#include "src/report/drawings/survey_net.hpp"
#include "src/report/error_text.hpp"
#include "src/report/sets_model.hpp"
#include "src/report/summaries/sets_summary.hpp"
#include "src/report/summaries/summary.hpp"

namespace rockfold {

namespace {

Survey read_survey(const Options& options, Terminal& terminal) {
  const Place place{options.input, 0, 0, ""};
  const std::string text = read_data_file(place);
  if (auto foreign = foreign_format(text, FileUse::table); !foreign.empty())
    Faults(place).fail(std::move(foreign));
  JointTable table;
  table.left_hand = options.left_hand;
  Survey survey;
  std::vector<Diagnostic> warnings;
  survey.rows = read_survey_table(text, table, place, survey.columns, &warnings);
  for (const Diagnostic& warning : warnings) terminal.warn(diagnostic_line(warning));
  return survey;
}

/// A model in which somebody has written more is not ours to replace.
void require_replaceable(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!file || !std::getline(file, line) || line.starts_with(sets_model_begins)) return;
  throw Error(ErrorKind::usage,
              fmt::format("{}: is there, and no list of joint sets that could be replaced", path));
}

void write_text(const std::string& path, const std::string& text) {
  TextFile file(path);
  file.print("{}", text);
  file.finish();
}

void warn_of_sets(const SurveyReport& report, Real blind_zone, Terminal& terminal) {
  if (report.blind > 0)
    terminal.warn(fmt::format(
        "{} of {} joints make less than {:g} deg with their scanline: how many there are of such "
        "joints is not to be relied on; a line across them would tell",
        report.blind, report.poles.size(), blind_zone));
}

}  // namespace

int tell_joint_sets(const Options& options, Terminal& terminal) {
  if (!options.output.empty()) require_replaceable(options.output);
  const Survey survey = read_survey(options, terminal);
  SurveyRules rules;
  if (options.scanline) rules.scanline = {options.scanline->first, options.scanline->second};
  rules.blind_zone = options.blind_zone;
  rules.count = options.set_count;
  rules.own_sets = !options.find_sets;
  const SurveyReport report = find_joint_sets(survey, rules);
  warn_of_sets(report, rules.blind_zone, terminal);
  std::string files;
  if (!options.output.empty()) {
    write_text(options.output, sets_model(report, options.input));
    files +=
        fact("model", options.output + "  (joint sets; spacings that are not known are left out)");
  }
  if (!options.picture.empty()) {
    write_text(options.picture, survey_net(report, options.input));
    files += fact("picture", options.picture);
  }
  const SetsHead head{options.input, survey.columns.name_heading, rules.blind_zone};
  print_made(options, terminal.warnings(), sets_document(head, report),
             sets_summary(head, report) + files);
  return 0;
}

}  // namespace rockfold
