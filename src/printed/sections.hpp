// The parts of a printed report, each from what the result file holds.
#pragma once

#include <string>
#include <vector>

#include "src/printed/format.hpp"
#include "src/printed/html.hpp"
#include "src/report/drawings/net.hpp"

namespace rockfold {

/// What a result file tells of its command.
struct ReportSource {
  std::string file;  ///< its name, without folders
  std::string title, command, version, commit;
  std::string model;  ///< the model's text
  Json answer;        ///< the command's document, with setup, warnings and unused
  /// Of the joints between blocks, one an orientation and joint, with the joint's name.
  struct Pole {
    std::string joint;
    Vec3 normal{};
  };
  std::vector<Pole> poles;

  /// Key blocks and support stand at the top of what `support` answers, and inside of what `run` and `demo` do; null without.
  const Json& support() const;
  bool has_run() const { return answer.contains("energy"); }
};

/// How a key block moves, by its mode and direction: "slides".
std::string mode_words(const Json& key);

void add_summary(Html& html, const ReportSource& source);
void add_model(Html& html, const ReportSource& source);
/// The table of joint sets and their stereonet.
void add_joints(Html& html, const ReportSource& source);
/// Of `cut`.
void add_block_sizes(Html& html, const ReportSource& source);
void add_keyblocks(Html& html, const ReportSource& source);
/// Bolts, shotcrete and patterns; classification.
void add_support_design(Html& html, const ReportSource& source);
void add_classification(Html& html, const ReportSource& source);
/// Of a run: what it came to, monitors, energies and contacts over time.
void add_analysis(Html& html, const ReportSource& source);
/// Of a run with bolts or shotcrete, what they bear (`bolts` and `shotcrete` of the document).
void add_bolt_forces(Html& html, const Json& bolts);
void add_shotcrete_forces(Html& html, const Json& shotcrete);
void add_assumptions(Html& html, const ReportSource& source);
/// What the program warned of and did not use.
void add_warnings(Html& html, const ReportSource& source);
void add_model_text(Html& html, const ReportSource& source);

}  // namespace rockfold
