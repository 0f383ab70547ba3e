// A right model: every key reaches the field that it means, and what is left out has its default.
#include "src/model/read/read_model.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

class CompleteModel : public testing::Test {
 protected:
  Model model = parse_model(complete_model, "m.toml", {}, Purpose::check);
};

TEST_F(CompleteModel, HasItsTitleTextAndPath) {
  EXPECT_EQ(model.title, "Everything");
  EXPECT_EQ(model.gravity, (Vec3{0.5, 0, -10}));
  EXPECT_EQ(model.text, complete_model);
  EXPECT_EQ(model.path, "m.toml");
}

TEST_F(CompleteModel, HasItsMaterials) {
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[1].name, "concrete");
  EXPECT_EQ(model.materials[1].density, 2400);
  EXPECT_EQ(model.materials[1].young_modulus, 25e9);
  EXPECT_EQ(model.materials[1].poisson_ratio, -0.1);
  ASSERT_EQ(model.joint_materials.size(), 2u);
  EXPECT_EQ(model.joint_materials[0].cohesion, 0);
  EXPECT_FALSE(model.joint_materials[0].normal_stiffness);
  EXPECT_EQ(model.joint_materials[1].friction_angle, 20.5);
  EXPECT_EQ(model.joint_materials[1].cohesion, 1e4);
  EXPECT_EQ(model.joint_materials[1].tensile_strength, 2e3);
  EXPECT_EQ(model.joint_materials[1].normal_stiffness, 10e9);
  EXPECT_EQ(model.joint_materials[1].shear_stiffness, 5e9);
}

TEST_F(CompleteModel, HasItsContact) {
  const JointMaterial &clean = model.joint_materials[0], &filled = model.joint_materials[1];
  EXPECT_EQ(clean.dilation_angle, 0);
  EXPECT_EQ(clean.dilation_limit, std::numeric_limits<Real>::infinity());
  EXPECT_FALSE(clean.residual_friction_angle);
  EXPECT_EQ(clean.residual_cohesion, 0);
  EXPECT_EQ(filled.dilation_angle, 4.5);
  EXPECT_EQ(filled.dilation_limit, 0.05);
  EXPECT_EQ(filled.residual_friction_angle, 15);
  EXPECT_EQ(filled.residual_cohesion, 2.5e3);
  EXPECT_EQ(filled.place.key, "joint_material[2]");
  EXPECT_EQ(model.contact.material, 1);
  EXPECT_EQ(model.contact.max_iterations, 25);
  EXPECT_EQ(model.contact.restitution, 0.3);
  EXPECT_EQ(model.contact.max_penetration, 1e-4);
  EXPECT_EQ(model.contact.place.key, "contact");
}

TEST(Contact, HasDefaults) {
  for (const char* section : {"", "[contact]\n"}) {
    const std::string text = std::string(ROCK) + section;
    EXPECT_EQ(parse_model(text, "m.toml").contact.material, none);
    const Model model = parse_model(text + "[[joint_material]]\nfriction_angle = 30\n", "m.toml");
    EXPECT_EQ(model.contact.material, 0);
    EXPECT_EQ(model.contact.max_iterations, 40);
    EXPECT_EQ(model.contact.restitution, 0);
    EXPECT_EQ(model.contact.max_penetration, 0);
    EXPECT_EQ(model.contact.place.file.empty(), *section == 0);
  }
}

TEST(Contact, TakesNumbersWithUnits) {
  const Model model = parse_model(
      ROCK
      "[contact]\nmax_penetration = '0.5 mm'\n"
      "[[joint_material]]\nfriction_angle = '40 gon'\ncohesion = '20 kPa'\n"
      "normal_stiffness = '10 GPa/m'\ndilation_angle = '0.1 rad'\ndilation_limit = '2 cm'\n"
      "residual_friction_angle = '30 gon'\nresidual_cohesion = '5 kPa'\n",
      "m.toml");
  EXPECT_DOUBLE_EQ(model.contact.max_penetration, 5e-4);
  const JointMaterial& joint = model.joint_materials[0];
  EXPECT_DOUBLE_EQ(*joint.normal_stiffness, 1e10);
  EXPECT_DOUBLE_EQ(joint.dilation_angle, 0.1 * 180 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(joint.dilation_limit, 0.02);
  EXPECT_DOUBLE_EQ(*joint.residual_friction_angle, 27);
  EXPECT_DOUBLE_EQ(joint.residual_cohesion, 5e3);
}

TEST(JointStrength, StaysAfterSlipUnlessTheModelSaysWhatIsLeft) {
  const auto joint = [](const std::string& keys) {
    return parse_model(ROCK "[[joint_material]]\nfriction_angle = 30\n" + keys, "m.toml")
        .joint_materials[0];
  };
  EXPECT_EQ(joint("").residual_cohesion, 0);
  EXPECT_EQ(joint("cohesion = 2e4\n").residual_cohesion, 2e4);
  EXPECT_EQ(joint("cohesion = 2e4\nresidual_cohesion = 5e3\n").residual_cohesion, 5e3);
  EXPECT_EQ(joint("cohesion = 2e4\nresidual_cohesion = 0\n").residual_cohesion, 0);
}

TEST(Monitor, WatchesAJointOfAnyKind) {
  const std::string joints = ROCK
      "interface = 'clean'\n[[joint_material]]\nname = 'clean'\nfriction_angle = 30\n"
      "[[joint]]\nname = 'bed'\nnormal = [0, 0, 1]\npoint = [1, 1, 1]\n"
      "[[joint_set]]\nname = 'J1'\ndip = 60\ndip_direction = 0\nspacing = 1\n";
  for (const char* name : {"bed", "J1", "rock.interface"}) {
    const Model model = parse_model(joints + "[[monitor]]\npoint = [1, 1, 1]\njoint = '" + name +
                                        "'\n[[monitor]]\npoint = [2, 2, 2]\n",
                                    "m.toml");
    ASSERT_EQ(model.monitors.size(), 2u);
    EXPECT_EQ(model.monitors[0].joint, name);
    EXPECT_EQ(model.monitors[0].point, (Vec3{1, 1, 1}));
    EXPECT_EQ(model.monitors[1].joint, "");
  }
}

TEST_F(CompleteModel, HasItsBox) {
  ASSERT_EQ(model.solids.size(), 11u);
  const auto& rock = model.solids[0];
  EXPECT_TRUE(rock.add);
  EXPECT_EQ(rock.material, 0);
  EXPECT_EQ(std::get<BoxShape>(rock.shape).max, (Vec3{10, 20, 30.5}));
  EXPECT_EQ(rock.continues, (std::vector<bool>{true, false, false, false, true, false}));
  EXPECT_EQ(rock.place.line, 36);
}

TEST_F(CompleteModel, HasItsHalfspaces) {
  const auto& cut = model.solids[1];
  EXPECT_FALSE(cut.add);
  const auto& planes = std::get<HalfspacesShape>(cut.shape).planes;
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_TRUE(planes[0].keep_above);
  EXPECT_EQ(std::get<DipOrientation>(planes[0].plane.orientation).dip, 45);
  EXPECT_EQ(std::get<DipOrientation>(planes[0].plane.orientation).dip_direction, 90);
  EXPECT_FALSE(planes[1].keep_above);
  EXPECT_EQ(std::get<Vec3>(planes[1].plane.orientation), (Vec3{0, 0, 2}));
  EXPECT_EQ(planes[1].plane.point, (Vec3{0, 0, 25}));
  EXPECT_EQ(cut.continues, (std::vector<bool>{false, true}));
}

TEST_F(CompleteModel, HasItsPrism) {
  const auto& beam = model.solids[2];
  EXPECT_TRUE(beam.add);
  EXPECT_EQ(beam.material, 1);
  EXPECT_EQ(std::get<PrismShape>(beam.shape).base[1], (Vec3{4, 0, 31}));
  EXPECT_EQ(std::get<PrismShape>(beam.shape).extrude, (Vec3{1, 0, 5}));
  EXPECT_EQ(beam.continues, (std::vector<bool>{true, true, true, false, true}));
}

TEST_F(CompleteModel, HasItsJoints) {
  ASSERT_EQ(model.joint_sets.size(), 5u);
  const auto& set = model.joint_sets[0];
  EXPECT_EQ(set.name, "J1");
  EXPECT_EQ(std::get<DipOrientation>(set.orientation).dip, 60);
  EXPECT_EQ(std::get<DipOrientation>(set.orientation).dip_direction, 360);
  EXPECT_EQ(set.spacing, 2.5);
  EXPECT_EQ(set.origin, (Vec3{1, 2, 3}));
  EXPECT_EQ(set.count, 5);
  EXPECT_EQ(set.material, 1);
  ASSERT_EQ(model.joints.size(), 5u);
  EXPECT_EQ(model.joints[0].material, 1);
  EXPECT_EQ(std::get<DipOrientation>(model.joints[0].plane.orientation).dip_direction, 120);
  EXPECT_EQ(model.joints[1].name, "joint2");
  EXPECT_EQ(model.joints[1].material, 0);
  EXPECT_EQ(std::get<Vec3>(model.joints[1].plane.orientation), (Vec3{1, -2, 0.5}));
  EXPECT_EQ(model.joints[1].plane.point, (Vec3{6, 5, 5}));
}

TEST_F(CompleteModel, HasItsCover) {
  ASSERT_TRUE(model.cover);
  EXPECT_EQ(model.cover->lattice, LatticeKind::tet6);
  EXPECT_EQ(model.cover->spacing, (Vec3{1.5, 1.5, 1.5}));
  EXPECT_EQ(model.cover->directions[1].dip_direction, 45);
  EXPECT_EQ(model.cover->origin, (Vec3{0.5, 0.5, 0.5}));
  EXPECT_EQ(model.cover->joints, JointTreatment::welded);
}

TEST_F(CompleteModel, HasItsConditions) {
  ASSERT_EQ(model.fixed.size(), 7u);
  const auto& first = model.fixed[0];
  EXPECT_EQ(std::get<FaceRegion>(first.where).solid, 0);
  EXPECT_EQ(std::get<FaceRegion>(first.where).faces, std::vector<Index>{4});
  EXPECT_EQ(first.components, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(first.value, (Vec3{0.1, 0, -0.2}));
  EXPECT_EQ(first.method, FixMethod::penalty);
  EXPECT_EQ(std::get<FaceRegion>(model.fixed[1].where).faces, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(model.fixed[1].components, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(model.fixed[1].method, FixMethod::augmented_lagrangian);
  EXPECT_EQ(std::get<BoxRegion>(model.fixed[2].where).max, (Vec3{1, 1, 0}));
  EXPECT_EQ(std::get<PointRegion>(model.fixed[3].where).point, (Vec3{1, 1, 1}));
  EXPECT_DOUBLE_EQ(std::get<PlaneRegion>(model.fixed[4].where).normal[1], 0.6);
  EXPECT_EQ(std::get<PlaneRegion>(model.fixed[4].where).tolerance, 0.01);
  EXPECT_EQ(std::get<BlockRegion>(model.fixed[5].where).point, (Vec3{9, 9, 9}));
  EXPECT_EQ(model.fixed[5].method, FixMethod::lagrange);
  EXPECT_EQ(model.fixed[5].table.time, (std::vector<Real>{0, 0.5}));
  EXPECT_EQ(model.fixed[5].table.value[1], (Vec3{0, 0, 0.01}));
  EXPECT_EQ(model.fixed[6].stiffness, 1e12);
  EXPECT_EQ(model.fixed[6].method, FixMethod::penalty);
  EXPECT_TRUE(std::get<FaceRegion>(model.fixed[6].where).of_excavation);
  ASSERT_EQ(model.monitors.size(), 1u);
  EXPECT_EQ(model.monitors[0].name, "crest");
}

TEST_F(CompleteModel, HasItsLoads) {
  ASSERT_EQ(model.point_loads.size(), 2u);
  EXPECT_EQ(model.point_loads[0].force, (Vec3{0, 0, -5e3}));
  EXPECT_TRUE(model.point_loads[0].table.empty());
  EXPECT_EQ(model.point_loads[1].table.value[1], (Vec3{0, 0, -5e3}));
  ASSERT_EQ(model.tractions.size(), 2u);
  EXPECT_EQ(std::get<FaceRegion>(model.tractions[0].where).faces, std::vector<Index>{1});
  EXPECT_FALSE(model.tractions[0].pressure);
  EXPECT_EQ(model.tractions[0].value, (Vec3{0, 0, -1e5}));
  EXPECT_TRUE(model.tractions[1].pressure);
  EXPECT_FALSE(model.tractions[1].follows);
  EXPECT_EQ(model.tractions[1].table.value[1], (Vec3{2e5, 0, 0}));
  ASSERT_EQ(model.quiet_boundaries.size(), 1u);
  EXPECT_EQ(std::get<FaceRegion>(model.quiet_boundaries[0].where).faces, std::vector<Index>{4});
  ASSERT_EQ(model.initial_velocities.size(), 1u);
  EXPECT_FALSE(model.initial_velocities[0].block_at);
  EXPECT_EQ(model.initial_velocities[0].angular_velocity, (Vec3{0, 0, 2}));
  EXPECT_TRUE(model.initial_stress.any);
  EXPECT_EQ(model.initial_stress.at, (std::array<Real, 6>{-1e6, -2e6, -3e6, 0, 0, 1e4}));
  EXPECT_EQ(model.initial_stress.gradient[2], -2.6e4);
  EXPECT_EQ(model.initial_stress.reference_z, 20);
  ASSERT_TRUE(model.base_acceleration);
  EXPECT_EQ(model.base_acceleration->scale, 0.5);
  EXPECT_EQ(model.base_acceleration->unit, 0.01);
  EXPECT_EQ(model.base_acceleration->direction, (Vec3{0, 0, -1}));
}

TEST_F(CompleteModel, HasItsStrengths) {
  const auto& mohr_coulomb = std::get<MohrCoulombStrength>(model.materials[0].strength);
  EXPECT_EQ(mohr_coulomb.cohesion, 2e6);
  EXPECT_EQ(mohr_coulomb.friction_angle, 40);
  EXPECT_EQ(mohr_coulomb.tensile_strength, 1e6);
  // Hoek, Carranza-Torres & Corkum 2002, Eq. 3 to 5.
  const auto& hoek_brown = std::get<HoekBrownStrength>(model.materials[1].strength);
  EXPECT_EQ(hoek_brown.sigma_ci, 80e6);
  EXPECT_NEAR(hoek_brown.m_b, 12 * std::exp(-40.0 / 21), 1e-12);
  EXPECT_NEAR(hoek_brown.s, std::exp(-40 / 7.5), 1e-12);
  EXPECT_NEAR(hoek_brown.a, 0.5 + (std::exp(-4.0) - std::exp(-20.0 / 3)) / 6, 1e-12);
}

TEST_F(CompleteModel, HasItsAnalysis) {
  ASSERT_TRUE(model.analysis);
  EXPECT_EQ(model.analysis->stages[0].type, AnalysisType::dynamic);
  EXPECT_EQ(model.analysis->stages[0].time_step, 0.02);
  EXPECT_EQ(model.analysis->stages[0].steps, 25);
  EXPECT_EQ(model.analysis->stages[0].dynamic_ratio, 0.9);
  EXPECT_EQ(model.analysis->max_displacement_ratio, 0.01);
  EXPECT_EQ(model.analysis->newmark_beta, 0.3025);
  EXPECT_EQ(model.analysis->newmark_gamma, 0.6);
  EXPECT_EQ(model.analysis->rayleigh_alpha, 0.5);
  EXPECT_EQ(model.analysis->rayleigh_beta, 0.001);
  EXPECT_EQ(model.solver.tolerance, 1e-9);
  EXPECT_EQ(model.solver.max_iterations, 100);
  EXPECT_EQ(model.output.every, 0);
}

TEST_F(CompleteModel, HasItsSupport) {
  ASSERT_TRUE(model.support);
  EXPECT_FALSE(model.support->joint_faces_only);
  EXPECT_EQ(model.support->water_pressure, 1e4);
  EXPECT_EQ(model.support->seismic_coefficient, (Vec3{0.1, 0, 0}));
  EXPECT_EQ(model.support->target_factor_of_safety, 1.3);
}

TEST(SmallModel, HasDefaults) {
  const auto model = parse_model(
      "[[solid]]\nshape = 'box'\nmin = [-1, -1, -1]\nmax = [1, 1, 1]\n"
      "[[joint_set]]\ndip = 0\ndip_direction = 0\nspacing = 1\n",
      "m.toml");
  EXPECT_EQ(model.gravity, (Vec3{0, 0, -9.81}));
  EXPECT_EQ(model.solids[0].name, "solid1");
  EXPECT_EQ(model.solids[0].material, none);
  EXPECT_EQ(model.joint_sets[0].name, "set1");
  EXPECT_EQ(model.joint_sets[0].material, none);
  EXPECT_FALSE(model.joint_sets[0].count);
  EXPECT_FALSE(model.cover || model.analysis || model.support);
  EXPECT_EQ(model.output.every, 10);
}

struct Duration {
  const char* analysis;
  Index steps;
  Real dynamic_ratio;
};

TEST(Analysis, CountsItsSteps) {
  const Duration cases[] = {
      {"", 100, 1},                                // 1 s in steps of 0.01 s
      {"time_step = 0.1\nend_time = 0.3", 3, 1},   // 0.3 / 0.1 is 2.9999999999999996
      {"time_step = 0.1\nend_time = 0.7", 7, 1},   // 6.999999999999999
      {"time_step = 0.1\nend_time = 0.25", 3, 1},  // the end is reached
      {"time_step = 0.5\nend_time = 0.5", 1, 1},
      {"steps = 7", 7, 1},
      {"time_step = 2.0\nsteps = 3", 3, 1},
      {"type = 'static'", 1, 1},
      {"type = 'static'\ntime_step = 5\nend_time = 1", 1, 1},  // a static analysis has no time
      {"type = 'quasi_static'\nsteps = 4", 4, 0},
      {"type = 'quasi_static'\ndynamic_ratio = 0", 100, 0},
  };
  for (const auto& [analysis, steps, ratio] : cases) {
    const auto model = parse_model(std::string(ROCK "[analysis]\n") + analysis, "m.toml");
    EXPECT_EQ(model.analysis->stages[0].steps, steps) << analysis;
    EXPECT_EQ(model.analysis->stages[0].dynamic_ratio, ratio) << analysis;
  }
  const auto shorter =
      parse_model(std::string(ROCK "[analysis]\ntime_step = 0.1\nend_time = 0.25"), "m.toml");
  EXPECT_NEAR(shorter.analysis->stages[0].last_time_step.value(), 0.05, 1e-15);
}

TEST(FaceNames, FollowTheShapes) {
  EXPECT_EQ(face_names(BoxShape{}),
            (std::vector<std::string>{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}));
  EXPECT_EQ(face_names(HalfspacesShape{{{}, {}}}), (std::vector<std::string>{"0", "1"}));
  const Shape prism = PrismShape{{{}, {}, {}, {}}, {}};
  EXPECT_EQ(face_names(prism), (std::vector<std::string>{"0", "1", "2", "3", "4", "5"}));
  EXPECT_EQ(faces_named(prism, "side"), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(faces_named(prism, "cap0"), std::vector<Index>{4});
  EXPECT_EQ(faces_named(prism, "cap1"), std::vector<Index>{5});
  EXPECT_EQ(faces_named(prism, "2"), std::vector<Index>{2});
  EXPECT_TRUE(faces_named(prism, "6").empty());
  EXPECT_TRUE(faces_named(BoxShape{}, "side").empty());
  EXPECT_TRUE(faces_named(HalfspacesShape{{{}, {}}}, "cap0").empty());

  const Shape pyramid = PyramidShape{{{}, {}, {}}, {}};
  EXPECT_EQ(face_names(pyramid).size(), 4u);
  EXPECT_EQ(faces_named(pyramid, "cap0"), std::vector<Index>{3});
  EXPECT_TRUE(faces_named(pyramid, "cap1").empty());
  const Shape cylinder = CylinderShape{.sides = 6};
  EXPECT_EQ(face_names(cylinder).size(), 8u);
  EXPECT_EQ(faces_named(cylinder, "cap1"), std::vector<Index>{7});
  EXPECT_EQ(faces_named(FrustumShape{{{}, {}, {}}, {{}, {}, {}}}, "cap1"), std::vector<Index>{4});
  EXPECT_EQ(faces_named(TunnelShape{{}, {{}, {}, {}, {}}}, "side"),
            (std::vector<Index>{0, 1, 2, 3}));
  for (const Shape& closed : {Shape(SphereShape{}), Shape(MeshShape{})}) {
    EXPECT_EQ(face_names(closed), std::vector<std::string>{"0"});
    EXPECT_EQ(faces_named(closed, "side"), std::vector<Index>{0});
    EXPECT_TRUE(faces_named(closed, "cap0").empty());
  }
  EXPECT_EQ(faces_named(TerrainShape{}, "top"), std::vector<Index>{5});
  EXPECT_TRUE(faces_named(TerrainShape{}, "side").empty());
}

TEST(ModelText, MayHaveAMarkAndAnyLineEnds) {
  std::string text = complete_model;
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2)
    text.insert(i, "\r");
  const auto model = parse_model("\xEF\xBB\xBF" + text, "m.toml");
  EXPECT_EQ(model.solids[0].place.line, 36);
  EXPECT_EQ(model.materials.size(), 2u);
}

TEST(ModelText, MayBeInlineTables) {
  const auto model = parse_model(
      "solid = [{shape = 'box', min = [0, 0, 0], max = [1, 1, 1]}]\ncover = {spacing = 1}", "");
  EXPECT_EQ(model.solids.size(), 1u);
  EXPECT_EQ(model.cover->spacing, (Vec3{1, 1, 1}));
}

}  // namespace
}  // namespace rockfold
