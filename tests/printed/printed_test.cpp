// The parts that printed reports are made of.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/sha256.hpp"
#include "src/printed/format.hpp"
#include "src/printed/html.hpp"
#include "src/printed/plot.hpp"
#include "src/report/drawings/net.hpp"
#include "src/report/drawings/svg.hpp"

namespace rockfold {
namespace {

// FIPS 180-4's own examples, and lengths about the 55 bytes after which a second block is needed (from `sha256sum`).
TEST(Sha256, AgreesWithPublishedDigests) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256(std::string(55, 'a')),
            "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  EXPECT_EQ(sha256(std::string(56, 'a')),
            "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a");
}

TEST(Html, TakesTextAsText) {
  Html html;
  html.table("<b>", {{"a&b", "m<"}, {"c", "", true}}, {{"\"1\"", "<script>"}});
  EXPECT_EQ(html.text().find("<script"), std::string::npos);
  EXPECT_EQ(html.text().find("<b>"), std::string::npos);
  EXPECT_NE(html.text().find("&quot;1&quot;"), std::string::npos);
  EXPECT_EQ(html_escaped("a\x01z\n"), "a z\n");
}

struct Number {
  Real value;
  const char* unit;
  const char* words;
};

TEST(Format, WritesNumbersAsEngineersDo) {
  for (const auto& [value, unit, words] :
       {Number{2.5e6, "Pa", "2.5 MPa"}, Number{0, "N", "0 N"}, Number{-48370, "Pa", "-48.37 kPa"},
        Number{0.0123456, "m", "12.35 mm"}, Number{0.5, "m", "0.5 m"}, Number{3, "", "3"},
        Number{123456, "m³", "123456 m³"}})
    EXPECT_EQ(quantity(value, unit), words);
  EXPECT_EQ(quantity(nullptr, "N"), "–");
  EXPECT_EQ(trend_text(Json::array({1.0, 0.0, -1.0})), "090/45");
  EXPECT_EQ(trend_text(Json::array({0.0, 0.0, 1.0})), "up");
  EXPECT_EQ(trend_text(Json::array({-1e-9, 1.0, 0.0})), "000/00");
}

TEST(Plot, HasTicksOfRoundNumbers) {
  EXPECT_EQ(axis_ticks(0, 10, 5), (std::vector<Real>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(axis_ticks(-0.3, 0.3, 4), (std::vector<Real>{-0.2, 0, 0.2}));
  EXPECT_EQ(axis_ticks(1, 1, 4), (std::vector<Real>{1}));
}

TEST(Plot, KeepsThePeaksOfLongCurvesAndStopsWhereAValueIsMissing) {
  Plot plot{"Slip", "m", {}, {{"a", {}}}};
  for (int i = 0; i < 20000; ++i) {
    plot.at.push_back(i);
    plot.curves[0].values.push_back(i == 7777 ? 5 : 1);
  }
  const std::string svg = plot_svg(plot);
  EXPECT_LT(svg.size(), 40000u);
  // The peak is at the top, 7777/19999 of the way along 600 px from 62.
  EXPECT_NE(svg.find("L295.32 34"), std::string::npos);
  plot.curves[0].values[10000] = NAN;
  const auto paths = [](const std::string& text) {
    std::size_t count = 0;
    for (auto at = text.find("#2166ac"); at != std::string::npos; at = text.find("#2166ac", at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(paths(plot_svg(plot)), paths(svg) + 1);
  EXPECT_EQ(plot_svg({"Slip", "m", {0}, {{"a", {1}}}}), "");
}

/// The width that a drawing declares.
Real width_of(const std::string& svg) {
  return std::stod(svg.substr(svg.find("width=\"") + 7));
}

TEST(Stereonet, IsAsWideAsItsLegend) {
  NetContent net;
  net.planes.push_back({"J1", {0, 0, 1}, 0, 0});
  const Real narrow = width_of(draw_net(net));
  const std::string name(90, 'W');
  net.planes.push_back({name, {1, 0, 0}, 90, 90});
  const Real wide = width_of(draw_net(net));
  // A W of Helvetica is 0.944 em wide; the legend's words are 12.5 px and begin 674 px from the left.
  EXPECT_GT(wide, 674 + 90 * 0.944 * 12.5);
  EXPECT_LT(narrow, wide / 1.5);
}

TEST(Stereonet, HasTheDirectionsOnBothHemispheresAndOnNetsOfJointPyramids) {
  for (const bool upper : {false, true})
    for (const bool pyramids : {false, true}) {
      NetContent net;
      net.planes.push_back({"J1", {0.6, 0, 0.8}, 36.87, 90});
      net.upper = upper;
      net.joint_pyramids = pyramids;
      const std::string svg = draw_net(net);
      for (const char* letter : {">N<", ">E<", ">S<", ">W<"})
        EXPECT_NE(svg.find(letter), std::string::npos) << letter << upper << pyramids;
    }
}

TEST(Stereonet, ColoursPolesByTheirSetAndDrawsWallsAndAxes) {
  NetContent net;
  net.planes = {{"J1", {0.6, 0, 0.8}, 36.87, 90}, {"J2", {0, 0.6, 0.8}, 36.87, 0}};
  const auto count = [](const std::string& svg, const std::string& what) {
    std::size_t found = 0;
    for (auto at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++found;
    return found;
  };
  const std::string red = std::string("fill=\"") + series_colour(1) + "\"";
  const std::size_t before = count(draw_net(net), red);
  net.poles = {{{0, 0.6, 0.8}, 1}, {{0, 0.62, 0.784}, 1}, {{0.6, 0, 0.8}, 0}};
  EXPECT_EQ(count(draw_net(net), red), before + 2);
  net.wall = "slope";
  net.free = {{0.7, 0, 0.714}};
  net.axis = {0, 1, 0};
  const std::string svg = draw_net(net);
  EXPECT_NE(svg.find("free faces of slope"), std::string::npos);
  EXPECT_NE(svg.find("axis of slope"), std::string::npos);
  EXPECT_EQ(count(svg, "stroke-dasharray=\"9 5\""),
            2u);  // the great circle and its row in the legend
}

}  // namespace
}  // namespace rockfold
