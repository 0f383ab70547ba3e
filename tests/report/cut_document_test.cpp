// What the document of `cut` says of flags, stages and dead ends.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "src/report/documents/documents.hpp"
#include "src/report/summaries/summary.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {
namespace {

/// Two slabs of 1 and 7 m³ of a box of 8 m³.
struct Slabs {
  Model model = box_model({0, 0, 0}, {1, 1, 8});
  Blocks blocks;

  Slabs() {
    model.solids[0].material = none;
    add_joint(model, Vec3{0, 0, 1}, {0, 0, 1});
    blocks = cut(model);
  }
  RockMeasures measures() const { return measure_rock(blocks.cutting, blocks.arrays, model); }
  Json document() const {
    return cut_document({"cut", "", {}}, model, blocks.cutting.totals, blocks.arrays, measures());
  }
};

TEST(CutDocument, FlagsBlocksOnlyWhereTheModelAsks) {
  Slabs slabs;
  Json document = slabs.document();
  EXPECT_FALSE(document["blocks"][0].contains("flags"));
  EXPECT_EQ(document["flagged"], (Json{{"small_volume", 0}, {"elongated", 0}}));
  slabs.model.cut.min_volume = 2;
  slabs.model.cut.max_aspect_ratio = 6.5;
  document = slabs.document();
  EXPECT_EQ(document["blocks"].size(), 2u);  // flagged, not deleted
  EXPECT_EQ(document["blocks"][0]["flags"], Json::array({"small_volume"}));
  EXPECT_EQ(document["blocks"][1]["flags"], Json::array({"elongated"}));
  EXPECT_NEAR(document["blocks"][1]["aspect_ratio"].get<Real>(), 7, 1e-9);
  EXPECT_EQ(document["flagged"]["small_volume"], 1);
  EXPECT_NE(measure_summary(slabs.measures()).find("1 small, 1 elongated"), std::string::npos);
}

TEST(CutDocument, TellsStagesAndDeadEnds) {
  Slabs slabs;
  EXPECT_EQ(slabs.document()["stages"], Json::array());
  EXPECT_EQ(slabs.document()["blocks"][1]["stage"], 0);
  EXPECT_EQ(slabs.document()["blocks"][1]["dead_end_area"], 0.0);
  slabs.model.excavations.resize(1);
  slabs.blocks.arrays.stage = {1, 0};
  slabs.blocks.arrays.dead_end_area = {0, 0.25};
  const Json document = slabs.document();
  ASSERT_EQ(document["stages"].size(), 1u);
  EXPECT_EQ(document["stages"][0]["stage"], 1);
  EXPECT_EQ(document["stages"][0]["blocks"], 1);
  EXPECT_NEAR(document["stages"][0]["volume"].get<Real>(), 1, 1e-12);
  EXPECT_NEAR(document["stages"][0]["new_free_area"].get<Real>(), 1, 1e-12);
  EXPECT_EQ(document["blocks"][0]["stage"], 1);
  EXPECT_EQ(document["blocks"][1]["dead_end_area"], 0.25);
  EXPECT_NE(measure_summary(slabs.measures()).find("laid open"), std::string::npos);
}

}  // namespace
}  // namespace rockfold::test
