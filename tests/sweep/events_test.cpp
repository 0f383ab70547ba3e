// In which runs events happen, and what a null says of them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "src/sweep/sweep_events.hpp"

namespace rockfold::sweep {
namespace {

using Results = std::vector<std::vector<std::string>>;

/// A sweep of runs whose results are a, b, as texts of JSON.
struct Runs {
  SweepSpec spec;
  std::vector<std::vector<std::string>> values;
  std::vector<RunRecord> rows;

  explicit Runs(const Results& results) {
    spec.results = {{"a", "totals.a"}, {"b", "totals.b"}};
    for (const auto& result : results) {
      values.emplace_back();
      rows.push_back({static_cast<Index>(values.size()), "done", 1, "", result});
    }
  }
  void fail(std::size_t run) { rows[run - 1] = {static_cast<Index>(run), "failed", 1, "why", {}}; }
  Event& event(const std::string& when, NullMeans null = NullMeans::did_not_happen) {
    return spec.events.emplace_back(Event{"it", when, parse_condition(when), null});
  }
  SweepTable table() const { return {spec, values, rows}; }
};

/// Networks of which some have no block that could move: no factor there is none below 1.
const Results factors{{"0.8", "1"}, {"null", "1"}, {"1.7", "1"}, {"null", "1"}, {"0.9", "1"}};

TEST(Null, DoesNotHappenAndStaysInTheDenominator) {
  Runs runs(factors);
  const Event& event = runs.event("a < 1");
  EXPECT_EQ(happened(runs.table(), event), (std::vector<int>{1, 0, 0, 0, 1}));
  const EventCount count = count_event(runs.table(), event);
  EXPECT_EQ(count.chance.met, 2);
  EXPECT_EQ(count.chance.count, 5);
  EXPECT_EQ(count.null_runs, 2);
  EXPECT_EQ(null_note(runs.table(), event),
            "2 of 5 runs have no number there (null): counted as not happened (null = \"false\")");
}

TEST(Null, IsLeftOutWhereTheEventSaysSo) {
  Runs runs(factors);
  const Event& event = runs.event("a < 1", NullMeans::left_out);
  EXPECT_EQ(happened(runs.table(), event), (std::vector<int>{1, -1, 0, -1, 1}));
  const EventCount count = count_event(runs.table(), event);
  EXPECT_EQ(count.chance.met, 2);
  EXPECT_EQ(count.chance.count, 3);
  EXPECT_EQ(count.null_runs, 2);
  EXPECT_EQ(null_note(runs.table(), event),
            "2 of 5 runs have no number there (null): left out (null = \"exclude\")");
}

TEST(Null, OfAllRunsIsNoneOfThem) {
  Runs runs(Results{{"null", "1"}, {"null", "1"}});
  EXPECT_EQ(count_event(runs.table(), runs.event("a < 1")).chance.count, 2);
  EXPECT_EQ(count_event(runs.table(), runs.event("a < 1", NullMeans::left_out)).chance.count, 0);
}

/// Three-valued logic: a null counts where nothing else decides.
TEST(Null, DecidesNothingThatAnotherComparisonDecides) {
  struct Case {
    const char* when;
    int as_false, excluded;
  };
  // a is null, b is 1.
  for (const auto& [when, as_false, excluded] :
       {Case{"a < 1 and b > 0", 0, -1}, Case{"a < 1 and b > 5", 0, 0}, Case{"a < 1 or b > 0", 1, 1},
        Case{"a < 1 or b > 5", 0, -1}, Case{"b > 5 and a < 1 or b > 0", 1, 1},
        Case{"a != 1", 0, -1}, Case{"b > 0 or a < 1 and b > 5", 1, 1}}) {
    Runs runs(Results{{"null", "1"}});
    EXPECT_EQ(happened(runs.table(), runs.event(when)).front(), as_false) << when;
    EXPECT_EQ(happened(runs.table(), runs.event(when, NullMeans::left_out)).front(), excluded)
        << when;
  }
}

TEST(Null, IsAPlaceThatOnlySomeDocumentsHave) {
  Runs runs(Results{{"", "1"}, {"0.5", "1"}});
  EXPECT_EQ(happened(runs.table(), runs.event("a < 1")), (std::vector<int>{0, 1}));
}

/// A path that is misspelt must not look like safety.
TEST(Event, OfAResultThatNoDocumentHasIsNotCounted) {
  Runs runs(Results{{"", "1"}, {"", "1"}});
  const Event& event = runs.event("a < 1 or b > 0");
  EXPECT_EQ(happened(runs.table(), event), (std::vector<int>{-1, -1}));
  EXPECT_EQ(count_event(runs.table(), event).chance.count, 0);
  EXPECT_EQ(null_note(runs.table(), event), "a result that it compares is in no run's document");
}

TEST(Event, CountsRunsThatAreDone) {
  Runs runs(factors);
  runs.fail(1);
  runs.fail(2);
  const Event& event = runs.event("a < 1");
  EXPECT_EQ(happened(runs.table(), event), (std::vector<int>{-1, -1, 0, 0, 1}));
  const EventCount count = count_event(runs.table(), event);
  EXPECT_EQ(count.chance.met, 1);
  EXPECT_EQ(count.chance.count, 3);
  EXPECT_EQ(count.null_runs, 1);
  EXPECT_EQ(count_event(Runs(Results{}).table(), event).chance.count, 0);
}

TEST(Event, IsToldAlikeInSummaryTableAndDocument) {
  Runs runs(factors);
  runs.fail(3);
  runs.event("a < 1");
  runs.event("a < 1", NullMeans::left_out).name = "given one";
  const SweepTable table = runs.table();
  const Json document = sweep_document(table, "out");
  const Json& all = document["events"][0];
  EXPECT_EQ(all["met"], 2);
  EXPECT_EQ(all["count"], 4);
  EXPECT_EQ(all["probability"], 0.5);
  EXPECT_EQ(all["null"], "false");
  EXPECT_EQ(all["null_runs"], 2);
  EXPECT_LT(all["clopper_pearson"]["low"], all["low"]);
  const Json& given = document["events"][1];
  EXPECT_EQ(given["count"], 2);
  EXPECT_EQ(given["null"], "exclude");
  EXPECT_EQ(document["results"][0]["count"], 2);
  EXPECT_EQ(document["results"][0]["null_runs"], 2);
  const std::string summary = sweep_summary(table, "out");
  EXPECT_NE(summary.find("2 of 4"), std::string::npos) << summary;
  EXPECT_NE(summary.find("2 of 2"), std::string::npos) << summary;
  EXPECT_NE(summary.find("2 of 4 runs have no number there (null): counted as not happened"),
            std::string::npos)
      << summary;
  EXPECT_NE(summary.find("run 3"), std::string::npos) << summary;
  EXPECT_EQ(csv_text(table),
            "run,status,seconds,error,a,b,it,given one\n"
            "1,done,1.000,,0.8,1,true,true\n2,done,1.000,,,1,false,\n3,failed,1.000,why,,,,\n"
            "4,done,1.000,,,1,false,\n5,done,1.000,,0.9,1,true,true\n");
}

TEST(Event, SaysWhatANullMeans) {
  const std::string text =
      "model = \"m.toml\"\ncommand = \"cut\"\nparameter = [{key = \"k\", values = [1]}]\n"
      "result = [{name = \"a\", path = \"b\"}]\nevent = [{name = \"e\", when = \"a > 1\"";
  EXPECT_EQ(parse_sweep(text + "}]", "s.toml").events[0].null, NullMeans::did_not_happen);
  EXPECT_EQ(parse_sweep(text + ", null = \"false\"}]", "s.toml").events[0].null,
            NullMeans::did_not_happen);
  EXPECT_EQ(parse_sweep(text + ", null = \"exclude\"}]", "s.toml").events[0].null,
            NullMeans::left_out);
  EXPECT_THROW(parse_sweep(text + ", null = \"true\"}]", "s.toml"), Error);
}

TEST(RankCorrelations, AreToldOfParametersThatAreNoSeeds) {
  Runs runs(Results{{"1", "1"}, {"2", "1"}, {"3", "1"}});
  runs.spec.parameters = {{"joint.k.dip", std::vector<std::string>{}},
                          {"joint_set.j.random.seed", std::vector<std::string>{}}};
  runs.values = {{"10", "5"}, {"20", "6"}, {"30", "7"}};
  const Json ranks = sweep_document(runs.table(), "out")["results"][0]["rank_correlation"];
  EXPECT_EQ(ranks.size(), 1U);
  EXPECT_EQ(ranks["joint.k.dip"], 1);
  EXPECT_EQ(sweep_summary(runs.table(), "out").find("seed"), std::string::npos);
}

}  // namespace
}  // namespace rockfold::sweep
