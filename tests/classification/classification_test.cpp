// Q and RMR against published cases: case G-5 … G-8.
#include "host/classification/classification.hpp"

#include <gtest/gtest.h>

namespace rockfold {
namespace {

// Case G-5.
TEST(Q, OfPublishedCases) {
  const struct {
    QParameters p;
    Real q;
  } cases[] = {{{90, 4, 3, 1, 1, 15}, 4.5},           {{90, 9, 1, 1, 1, 1}, 10},
               {{85, 6, 2, 2, 0.66, 1}, 9.35},        {{60, 12, 1.5, 4, 0.5, 2.5}, 0.375},
               {{5, 20, 1, 8, 0.33, 7.5}, 0.00275},  // RQD counts as 10
               {{100, 0.5, 4, 0.75, 1, 1}, 1066.6667}};
  for (const auto& [p, q] : cases) EXPECT_NEAR(q_value(p), q, 1e-5 * q) << q;
}

// Case G-5.
TEST(Q, OfACrusherChamberGivesSpanBoltsAndPressure) {
  const QParameters p{90, 4, 3, 1, 1, 15};
  EXPECT_NEAR(unsupported_span(4.5, 1.6), 5.8403, 1e-4);
  EXPECT_NEAR(q_bolt_length(15, 1.6), 3.40625, 1e-9);
  EXPECT_NEAR(q_bolt_length(20, 1.6), 3.875, 1e-9);
  EXPECT_NEAR(q_roof_pressure(p), 26.40e3, 5);
  EXPECT_NEAR(q_roof_pressure_simple(p), 0.40380 * 98066.5, 2);
  EXPECT_STREQ(q_class(4.5), "fair");
  EXPECT_STREQ(q_class(0.005), "exceptionally_poor");
  EXPECT_STREQ(q_class(1066), "exceptionally_good");
}

// Case G-7.
TEST(Rmr, RatingsAreThoseOfTheTables) {
  const auto expect_rows = [](Real (*rating)(Real),
                              std::initializer_list<std::pair<Real, Real>> rows) {
    for (const auto& [value, expected] : rows) EXPECT_EQ(rating(value), expected) << value;
  };
  expect_rows(strength_rating,
              {{260e6, 15}, {150e6, 12}, {70e6, 7}, {30e6, 4}, {10e6, 2}, {2e6, 1}, {0.5e6, 0}});
  expect_rows(strength_rating, {{250e6, 12}, {251e6, 15}, {100e6, 12}, {50e6, 7}, {25e6, 4}});
  expect_rows(point_load_rating, {{11e6, 15}, {8e6, 12}, {3e6, 7}, {1.5e6, 4}});
  expect_rows(point_load_rating, {{10e6, 12}, {10.1e6, 15}, {4e6, 12}, {2e6, 7}, {1e6, 4}});
  expect_rows(rqd_rating, {{95, 20}, {90, 20}, {80, 17}, {70, 13}, {30, 8}, {20, 3}});
  expect_rows(spacing_rating, {{3, 20}, {1, 15}, {0.3, 10}, {0.1, 8}, {0.05, 5}});
  expect_rows(spacing_rating,
              {{2, 15}, {2.01, 20}, {0.6, 15}, {6 * 0.1, 15}, {3 * 0.2 - 1e-16, 15}});
  const Real conditions[] = {30, 25, 20, 10, 0}, waters[] = {15, 10, 7, 4, 0};
  const Real tunnels[] = {0, -2, -5, -10, -12}, foundations[] = {0, -2, -7, -15, -25},
             slopes[] = {0, -5, -25, -50, -60};
  for (Index i = 0; i < 5; ++i) {
    EXPECT_EQ(condition_rating(i), conditions[i]);
    EXPECT_EQ(water_rating(i), waters[i]);
    EXPECT_EQ(orientation_rating(i, RmrUse::tunnel), tunnels[i]);
    EXPECT_EQ(orientation_rating(i, RmrUse::foundation), foundations[i]);
    EXPECT_EQ(orientation_rating(i, RmrUse::slope), slopes[i]);
  }
}

// Case G-7.
TEST(Rmr, ClassesStandAsLongAsPublished) {
  const std::pair<Real, int> rows[] = {{81, 1}, {80, 2}, {61, 2}, {60, 3}, {41, 3},
                                       {40, 4}, {21, 4}, {20, 5}, {0, 5}};
  for (const auto& [rmr, number] : rows) EXPECT_EQ(rmr_class(rmr), number) << rmr;
  EXPECT_EQ(stand_up_time(3).span, 5);
  EXPECT_EQ(stand_up_time(3).time, 7 * 86400);
  EXPECT_EQ(rmr_support(1).bolt_length[1], 0);
  EXPECT_EQ(rmr_support(3).bolt_length[0], 4);
  EXPECT_EQ(rmr_support(3).bolt_spacing, (std::array<Real, 2>{1.5, 2}));
  EXPECT_EQ(rmr_support(4).rib_spacing, 1.5);
  EXPECT_EQ(rmr_support(5).shotcrete_face, 0.05);
}

// Case G-7: bolt length, spacing, shotcrete in the crown, on walls, at the face (m), and spacing of ribs.
TEST(Rmr, SupportIsThatOfTheTable) {
  using Pair = std::array<Real, 2>;
  const struct {
    Pair length, spacing, crown, walls;
    Real face, ribs;
  } rows[] = {{{0, 0}, {0, 0}, {0, 0}, {0, 0}, 0, 0},
              {{3, 3}, {2.5, 2.5}, {0.05, 0.05}, {0, 0}, 0, 0},
              {{4, 4}, {1.5, 2}, {0.05, 0.1}, {0.03, 0.03}, 0, 0},
              {{4, 5}, {1, 1.5}, {0.1, 0.15}, {0.1, 0.1}, 0, 1.5},
              {{5, 6}, {1, 1.5}, {0.15, 0.2}, {0.15, 0.15}, 0.05, 0.75}};
  for (int number = 1; number <= 5; ++number) {
    SCOPED_TRACE(number);
    const RmrSupport support = rmr_support(number);
    const auto& row = rows[number - 1];
    EXPECT_EQ(support.bolt_length, row.length);
    EXPECT_EQ(support.bolt_spacing, row.spacing);
    EXPECT_EQ(support.shotcrete_crown, row.crown);
    EXPECT_EQ(support.shotcrete_walls, row.walls);
    EXPECT_EQ(support.shotcrete_face, row.face);
    EXPECT_EQ(support.rib_spacing, row.ribs);
  }
}

TEST(Rmr, OrientationOfJointsForATunnel) {
  // Dip, dip direction, drive north: with the dip very favourable or favourable, against it fair or unfavourable, along the
  // strike very unfavourable or fair; gentle dips fair.
  const struct {
    Real dip, direction;
    Index row;
  } cases[] = {{60, 0, 0},  {30, 10, 1},  {60, 180, 2}, {30, 170, 3},
               {60, 90, 4}, {30, 270, 2}, {10, 90, 2},  {10, 0, 2}};
  for (const auto& c : cases)
    for (const Real drive : {0.0, 130.0, 350.0})
      EXPECT_EQ(tunnel_orientation(c.dip, c.direction + drive, drive), c.row)
          << c.dip << ' ' << c.direction;
}

ClassificationReport classified(ClassificationSpec spec) {
  Model model;
  model.classification = std::move(spec);
  BlockArrays blocks;
  RockMeasures measures;
  measures.rqd = 0.62;
  JointSet set;
  set.orientation = DipOrientation{30, 100};
  for (const auto& [name, p32] : {std::pair{"a", 2.0}, {"b", 1.0}, {"c", 0.5}}) {
    set.name = name;
    if (set.name == "c") set.orientation = DipOrientation{35, 110};  // the same set as a and b
    model.joint_sets.push_back(set);
    OriginIntensity intensity;
    intensity.name = name, intensity.p32 = p32, intensity.joints = 4;
    measures.intensities.push_back(intensity);
  }
  set.name = "steep";
  set.orientation = DipOrientation{85, 280};
  model.joint_sets.push_back(set);
  OriginIntensity steep;
  steep.name = "steep", steep.p32 = 3, steep.joints = 9;
  measures.intensities.push_back(steep);
  return classify(blocks, {}, measures, model);
}

// 12 + 13 + 10 + 22 + 7 − 5 = 59, class III (case G-6).
TEST(Rmr, OfHoeksExample) {
  ClassificationSpec spec;
  spec.rmr.emplace();
  spec.rmr->point_load_index = 8e6;
  spec.rmr->rqd = 70;
  spec.rmr->spacing = 0.3;
  spec.rmr->condition_rating = 22;
  spec.rmr->groundwater = 2;
  spec.rmr->orientation = tunnel_orientation(60, 180, 0);
  const RmrReport rmr = *classified(spec).rmr;
  EXPECT_EQ(rmr.ratings, (std::array<Real, 6>{12, 13, 10, 22, 7, -5}));
  EXPECT_EQ(rmr.value, 59);
  EXPECT_EQ(rmr.number, 3);
  EXPECT_FALSE(rmr.rqd_proposed);
}

TEST(Classification, TakesFromTheCutModelWhatIsNotGiven) {
  ClassificationSpec spec;
  spec.span = 15;
  spec.q.emplace();
  spec.q->jr = spec.q->ja = spec.q->jw = spec.q->srf = 1;
  spec.q->excavation_support_ratio = 1.6;
  spec.q->location = QLocation::intersection;
  spec.rmr.emplace();
  spec.rmr->uniaxial_strength = 120e6;
  const ClassificationReport report = classified(spec);
  EXPECT_EQ(report.measured.sets, 2);
  EXPECT_NEAR(report.q->parameters.rqd, 62, 1e-9);
  EXPECT_EQ(report.q->parameters.jn, 3 * 4);
  EXPECT_NEAR(report.q->value, 62.0 / 12, 1e-9);
  EXPECT_NEAR(*report.q->equivalent_span, 9.375, 1e-12);
  EXPECT_TRUE(*report.q->needs_support);
  EXPECT_NEAR(report.rmr->spacing, 1 / 3.5, 1e-12);  // of a, b and c together
  EXPECT_TRUE(report.rmr->spacing_proposed);
}

// Case G-8.
TEST(Classification, CorrelationsAreThosePublished) {
  EXPECT_NEAR(rmr_from_q_bieniawski(4.5), 57.54, 5e-3);
  EXPECT_NEAR(rmr_from_q_barton(4.5), 59.80, 5e-3);
  EXPECT_NEAR(unal_pressure(59, 27e3, 10), 110.7e3, 1e-6);
  EXPECT_NEAR(deformation_modulus(59), 16.79e9, 5e6);
}

TEST(Classification, JointSetNumbers) {
  const Real alone[] = {1, 2, 4, 9, 15, 15}, with_random[] = {1, 3, 6, 12, 15, 15};
  for (Index sets = 0; sets < 6; ++sets) {
    EXPECT_EQ(joint_set_number(sets, false), alone[sets]);
    EXPECT_EQ(joint_set_number(sets, true), with_random[sets]);
  }
}

}  // namespace
}  // namespace rockfold
