// Numbers with units, and orientations in the ways that engineers give them.
#include "src/model/text/numbers/units.hpp"

#include <gtest/gtest.h>

#include "src/model/read/read_model.hpp"

namespace rockfold {
namespace {

TEST(Units, AreThoseOfTheKey) {
  struct Case {
    const char *text, *wanted;
    Real value;
  };
  const Case cases[] = {
      {"25 MPa", "Pa", 25e6},          {"30GPa", "Pa", 30e9},
      {" 1 bar ", "Pa", 1e5},          {"2.7 t/m3", "kg/m3", 2700},
      {"26.487 kN/m3", "kg/m3", 2700}, {"100 lb/ft3", "kg/m3", 1601.8463},
      {"15 ft", "m", 4.572},           {"-5 cm", "m", -0.05},
      {"35 deg", "deg", 35},           {"0.5 rad", "deg clockwise from north", 28.6478897565},
      {"150 kN", "N", 150e3},          {"1 kip", "N", 4448.2216},
      {"+2 MPa/mm", "Pa/m", 2e9},      {"20 ms", "s", 0.02},
      {"1 g", "m/s2", 9.81},           {"3937 usft", "m", 1200},
      {"2 yd", "m", 1.8288},           {"50 grad", "deg", 45},
  };
  for (const auto& [text, wanted, value] : cases) {
    const auto found = number_with_unit(text, wanted);
    ASSERT_TRUE(found) << text;
    EXPECT_NEAR(*found, value, 1e-7 * std::abs(value)) << text;
  }
}

TEST(Units, OfOtherQuantitiesAreNone) {
  for (const char* text : {"25 MPa", "25", "m", "", "25 ", "2,5 m", "25 furlong"})
    EXPECT_FALSE(number_with_unit(text, "m")) << text;
  EXPECT_FALSE(number_with_unit("3 m", ""));
  EXPECT_EQ(units_of("deg"), "deg, °, rad, gon, grad");
  EXPECT_EQ(units_of("barrels"), "");
}

DipOrientation dip_of(const std::string& keys) {
  const std::string rock =
      "[[joint_material]]\nfriction_angle = \"0.5 rad\"\n"
      "[[solid]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [\"15 ft\", 1, 1]\n";
  const Model model =
      parse_model(rock + "[[joint]]\npoint = [0, 0, 0]\n" + keys, "m.toml", {}, Purpose::check);
  return std::get<DipOrientation>(model.joints.at(0).plane.orientation);
}

// Strike 0 by the right-hand rule: the plane dips east. The pole of a plane that dips 60 to the east plunges 30 to the west.
TEST(Orientations, ByStrikeOrPoleAreThoseByDipDirection) {
  const std::pair<const char*, DipOrientation> cases[] = {
      {"dip = 60\nstrike = 0", {60, 90}},
      {"dip = 60\nstrike = 300", {60, 30}},
      {"dip = 60\nstrike = 30\nrule = \"left_hand\"", {60, 300}},
      {"trend = 270\nplunge = 30", {60, 90}},
      {"trend = 10\nplunge = 0", {90, 190}},
      {"trend = 200\nplunge = \"90 deg\"", {0, 20}},
  };
  for (const auto& [keys, expected] : cases) {
    const DipOrientation found = dip_of(keys);
    EXPECT_EQ(found.dip, expected.dip) << keys;
    EXPECT_EQ(found.dip_direction, expected.dip_direction) << keys;
  }
}

TEST(Orientations, GivenInTwoWaysAreRefused) {
  for (const char* keys :
       {"dip = 60\ndip_direction = 90\nstrike = 0",
        "dip = 60\nstrike = 0\ntrend = 270\nplunge = 30",
        "normal = [1, 0, 0]\ntrend = 270\nplunge = 30", "dip = 60\nstrike = 0\nrule = \"left\""})
    EXPECT_THROW(dip_of(keys), Error) << keys;
}

}  // namespace
}  // namespace rockfold
