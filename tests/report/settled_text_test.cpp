// What a summary and a report say of rock that was let go before a step went on.
#include <gtest/gtest.h>

#include "src/report/documents/document_parts.hpp"
#include "src/report/documents/settled.hpp"

namespace rockfold {
namespace {

AnalysisStage dig() {
  AnalysisStage stage;
  stage.name = "dig";
  stage.excavate = 2;
  return stage;
}

Settled after(Index steps) {
  Settled settled;
  settled.steps = steps;
  return settled;
}

TEST(SettledText, NamesTheBlockThatMovedMostAndWhatMovesOn) {
  Settled settled = after(13);
  settled.largest = 0.0015;
  settled.block = 20;
  settled.moving = 1;
  settled.fastest = 4;
  EXPECT_EQ(settled_text(settled_json(settled, dig())),
            "stage 2 let go over 13 quasi-static steps before \"dig\" goes on: block 21 moved "
            "0.0015 m, most of all; 1 block moves on, block 5 first of all");
}

TEST(SettledText, SaysThatNothingMoved) {
  EXPECT_EQ(settled_text(settled_json(after(11), dig())),
            "stage 2 let go over 11 quasi-static steps before \"dig\" goes on: nothing moved; all "
            "came to rest");
}

TEST(SettledText, SaysWhereARunWasInterrupted) {
  const std::string text = settling_text(settling_json(after(7), dig()));
  EXPECT_NE(text.find("interrupted after 7 quasi-static steps in which stage 2 is let go before "
                      "\"dig\" goes on: nothing moved"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("are of then, monitors and stored states end before"), std::string::npos);
}

}  // namespace
}  // namespace rockfold
