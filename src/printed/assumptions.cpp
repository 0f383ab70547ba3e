// What the numbers of a report rest on, and what they do not say.
#include <fmt/format.h>

#include "src/printed/sections.hpp"

namespace rockfold {

namespace {

void add_of_blocks(std::vector<std::string>& items) {
  items.insert(items.end(), {"Joints are planes, discs or polygons where the model puts them; "
                             "where they really lie is known as well as they were mapped.",
                             "Faces and openings narrower than 1e-9 of the model's size are passed "
                             "over; all else is cut exactly."});
}

void add_of_support(std::vector<std::string>& items, const Json& s) {
  items.insert(items.end(),
               {"Block theory: blocks are rigid and fail by falling, sliding or turning as they "
                "stand; what they do after a finite motion is not followed.",
                "Joints fail by Mohr–Coulomb's law over their whole area at once; cohesion is not "
                "lost by and by. Blocks load each other only in groups that fail together.",
                "Factors of safety are those of limit equilibrium, the lesser of all modes found; "
                "bolts hold blocks, not the rock around their ends."});
  if (!s.at("rotation").get<bool>()) items.emplace_back("Rotations were not looked for.");
  if (s.at("clamping").get<bool>())
    items.emplace_back(
        "In-situ stress is counted on where it clamps blocks (support.clamping): it may be lost "
        "where rock relaxes.");
}

void add_of_run(std::vector<std::string>& items, const Json& a) {
  items.emplace_back(
      a.at("kinematics") == "small"
          ? "Displacements are taken as small: strain is linear, geometry and loads stay as at the "
            "start."
          : "Displacements and rotations may be large; strain within the rock is finite strain.");
  items.emplace_back(
      "Intact rock is linear elastic: strength ratios tell where it would fail, and it does not "
      "fail in the analysis.");
  if (a.contains("joints"))
    items.emplace_back(
        a.at("joints") == "welded" ? "Joints are welded: they do nothing in the analysis."
        : a.at("contact").get<bool>()
            ? "Blocks touch at joints through springs of the joints' stiffness with Mohr–Coulomb's "
              "law; they do not break."
            : "Blocks are apart at joints and do not touch each other in this analysis.");
  items.emplace_back(
      "Accuracy is that of the cover's spacing and order and of the time step; a finer one shows "
      "how much it matters.");
}

}  // namespace

void add_assumptions(Html& html, const ReportSource& source) {
  const Json& setup = source.answer.at("setup");
  html.heading(2, "Assumptions and limits");
  std::vector<std::string> items;
  add_of_blocks(items);
  if (setup.contains("support")) add_of_support(items, setup.at("support"));
  if (setup.contains("analysis")) add_of_run(items, setup.at("analysis"));
  if (source.answer.contains("bolts") || source.answer.contains("shotcrete"))
    items.emplace_back(
        "Bolts are bars that bend at joints alone and bear no pressure along themselves; shotcrete "
        "holds at joints by its edge, and does not bend.");
  html.list(items);
}

}  // namespace rockfold
