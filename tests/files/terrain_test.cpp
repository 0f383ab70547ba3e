#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "src/base/vector.hpp"
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

using Edge = std::pair<Index, Index>;

TriangleSurface ground_of(const std::string& text) {
  return read_terrain(text, sample_place);
}

/// Directed edges without a partner, by where they start; an outline of simple polygons has one at a vertex.
std::multimap<Index, Index> outline(const TriangleSurface& ground) {
  std::set<Edge> edges;
  for (const auto& t : ground.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
  EXPECT_EQ(edges.size(), 3 * ground.triangles.size()) << "an edge is used twice in one sense";
  std::multimap<Index, Index> open;
  for (const auto& [a, b] : edges)
    if (edges.count({b, a}) == 0) open.insert({a, b});
  return open;
}

void expect_sound(const TriangleSurface& ground) {
  const auto open = outline(ground);
  for (const auto& [from, to] : open)
    EXPECT_EQ(open.count(from), 1u) << "a pinch at vertex " << from;
  for (const auto& [a, b, c] : ground.triangles) {
    const Vec3& origin = ground.vertices[static_cast<std::size_t>(a)];
    EXPECT_GT(cross(ground.vertices[static_cast<std::size_t>(b)] - origin,
                    ground.vertices[static_cast<std::size_t>(c)] - origin)[2],
              0);
  }
}

const std::string header23 = "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n";

}  // namespace

TEST(AsciiGrid, HasItsPostsAtTheCellsCentresFromNorthToSouth) {
  const auto ground = ground_of(header23 + "1 2 3\n4 5 6\n");
  EXPECT_EQ(ground.vertices,
            (std::vector<Vec3>{
                {11, 21, 4}, {13, 21, 5}, {15, 21, 6}, {11, 23, 1}, {13, 23, 2}, {15, 23, 3}}));
  EXPECT_EQ(ground.triangles.size(), 4u);
  EXPECT_EQ(double_plan_area(ground), 2 * 4 * 2);
  expect_sound(ground);
}

TEST(AsciiGrid, IsDividedAlongTheDiagonalThatItsDecimalsSay) {
  std::mt19937 draw(7);
  int ties = 0;
  for (const int decimals : {1, 2, 3}) {
    const int unit = decimals == 1 ? 10 : decimals == 2 ? 100 : 1000;
    for (int n = 0; n < 500; ++n) {
      std::array<int, 4> z{};  // north-west, north-east, south-west, south-east, in tenths and less
      std::string rows;
      for (int& post : z) {
        post = 1234 * unit + std::uniform_int_distribution<int>(0, 40)(draw);
        std::string rest = std::to_string(post % unit);
        rest.insert(0, static_cast<std::size_t>(decimals) - rest.size(), '0');
        rows += std::to_string(post / unit) + "." + rest + " ";
      }
      const int north_east = std::abs(z[1] - z[2]), north_west = std::abs(z[0] - z[3]);
      ties += north_east == north_west;
      const auto ground =
          ground_of("ncols 2\nnrows 2\nxllcorner 0.1\nyllcorner 0.3\ncellsize 0.7\n" + rows);
      const auto& first = ground.triangles.at(0);  // posts 0 south-west, 3 north-east
      const bool along_north_east = std::count(first.begin(), first.end(), 3) == 1 &&
                                    std::count(first.begin(), first.end(), 0) == 1;
      EXPECT_EQ(along_north_east, north_east <= north_west) << rows;
    }
  }
  EXPECT_GT(ties, 30);
}

TEST(AsciiGrid, MayBeRegisteredAtCentresInAnyCaseOrderAndLines) {
  const auto ground = ground_of(
      "\xEF\xBB\xBFNROWS 2\r\nXLLCENTER 10\r\nNcols   3\r\nyllcenter\t20\r\nDX 2\r\nDY 5\r\n"
      "nodata_VALUE -1\r\n1 2\r\n3 4 5\r\n+6.5e0\r\n\r\n");
  EXPECT_EQ(ground.vertices.front(), (Vec3{10, 20, 4}));
  EXPECT_EQ(ground.vertices.back(), (Vec3{14, 25, 3}));
  EXPECT_EQ(ground.vertices[2][2], 6.5);
}

TEST(AsciiGrid, SplitsSquaresAlongTheShorterDiagonal) {
  const std::string header = "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n";
  // A ridge from north-west to south-east; one from south-west to north-east; a plane.
  EXPECT_EQ(ground_of(header + "9 0\n1 9").triangles[0], (std::array<Index, 3>{0, 1, 2}));
  EXPECT_EQ(ground_of(header + "0 9\n9 1").triangles[0], (std::array<Index, 3>{0, 1, 3}));
  EXPECT_EQ(ground_of(header + "1 1\n1 1").triangles[0], (std::array<Index, 3>{0, 1, 3}));
}

TEST(AsciiGrid, LeavesOutSquaresOfLessThanThreePosts) {
  const auto ground = ground_of(header23 + "-9999 2 3\n4 5 6\n");
  EXPECT_EQ(ground.vertices.size(), 5u);
  EXPECT_EQ(ground.triangles.size(), 3u);
  expect_sound(ground);
  EXPECT_EQ(ground_of(header23 + "NODATA_value nan\nnan 2 3\n4 5 6\n").triangles.size(), 3u);
}

TEST(AsciiGrid, HasNoPartsThatTouchAtOnePost) {
  // Two squares that share the post in the middle, the lower one with a neighbour.
  const auto ground = ground_of(
      "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value 0\n"
      "1 1 0 0\n1 1 1 1\n0 1 1 1\n");
  expect_sound(ground);
  EXPECT_GE(ground.triangles.size(), 4u);
}

TEST(AsciiGrid, OfRandomGapsHasSimpleOutlines) {
  std::mt19937_64 random(7);
  for (int n = 0; n < 200; ++n) {
    const int columns = 2 + static_cast<int>(random() % 12),
              rows = 2 + static_cast<int>(random() % 12);
    const auto gaps = random() % 60;
    std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
                       "\nxllcorner 500000.5\nyllcorner 4000000\ncellsize 0.1\n";
    for (int i = 0; i < columns * rows; ++i)
      text += random() % 100 < gaps ? "-9999 " : std::to_string(random() % 1000) + " ";
    try {
      expect_sound(ground_of(text));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("no three neighbouring posts"), std::string::npos)
          << error.what();
    }
  }
}

TEST(AsciiGrid, OfRandomPostsComesBackAsItWasWritten) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<Real> height(-1e5, 1e5);
  for (int n = 0; n < 20; ++n) {
    const std::size_t columns = 2 + random() % 30, rows = 2 + random() % 30;
    std::vector<Vec3> posts;
    std::string xyz = "x;y;z\n";
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i)
        posts.push_back(
            {static_cast<Real>(i) * 0.3 + 7, static_cast<Real>(j) * 0.7 - 5, height(random)});
    std::string grid = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
                       "\nxllcenter 7\nyllcenter -5\ndx 0.3\ndy 0.7\n";
    const auto exact = [](Real x) {
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", x);
      return std::string(text);
    };
    for (std::size_t j = rows; j-- > 0;)
      for (std::size_t i = 0; i < columns; ++i) grid += exact(posts[j * columns + i][2]) + " ";
    const auto ground = ground_of(grid);
    ASSERT_EQ(ground.vertices.size(), posts.size());
    for (std::size_t i = 0; i < posts.size(); ++i) EXPECT_EQ(ground.vertices[i][2], posts[i][2]);
    expect_sound(ground);

    auto shuffled = ground.vertices;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (const auto& p : shuffled)
      xyz += exact(p[0]) + ";" + exact(p[1]) + ";" + exact(p[2]) + "\n";
    const auto same = ground_of(xyz);
    EXPECT_EQ(same.vertices, ground.vertices);
    EXPECT_EQ(same.triangles, ground.triangles);
  }
}

TEST(AsciiGrid, OfAPlaneIsThatPlaneExactly) {
  std::string text = "ncols 40\nnrows 30\nxllcenter 0\nyllcenter 0\ncellsize 4\n";
  for (int j = 29; j >= 0; --j)
    for (int i = 0; i < 40; ++i) text += std::to_string(100 + 2 * i - 3 * j) + " ";
  const auto ground = ground_of(text);
  for (const auto& [a, b, c] : ground.triangles) {
    const Vec3& origin = ground.vertices[static_cast<std::size_t>(a)];
    const Vec3 normal = cross(ground.vertices[static_cast<std::size_t>(b)] - origin,
                              ground.vertices[static_cast<std::size_t>(c)] - origin);
    EXPECT_EQ(normal, (Vec3{-8, 12, 16}));  // z = 100 + x/2 − 3y/4: (−1/2, 3/4, 1) times 16
  }
  EXPECT_EQ(double_plan_area(ground), 2.0 * 39 * 29 * 16);
}

TEST(AsciiGrid, KnowsItsNoDataInSinglePrecisionAndByTheWordNull) {
  const std::string head = "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  const auto plain = ground_of(head + "12 12 12 12\n11 11 11 -9999\n10 10 10 10\n");
  for (const auto& [given, value] :
       {std::pair{"-3.4028230607370965251e+38", "-3.402823e+38"}, std::pair{"null", "null"},
        std::pair{"null", "NULL"}, std::pair{"nan", "nan"}, std::pair{"0.1", "0.1000000015"}})
    EXPECT_EQ(ground_of(head + "NODATA_value " + given + "\n12 12 12 12\n11 11 11 " + value +
                        "\n10 10 10 10\n")
                  .vertices,
              plain.vertices)
        << given;
  EXPECT_EQ(ground_of(head + "NODATA_value null\nnull 12 12 12\n11 11 11 11\n10 10 10 10\n")
                .vertices.size(),
            11u);
  for (const char* values : {"NODATA_value -9999\n12 12 12 12\n11 11 11 null\n10 10 10 10\n",
                             "NODATA_value none\n12 12 12 12\n11 11 11 11\n10 10 10 10\n"})
    EXPECT_EQ(errors_of_reading([&] { ground_of(head + values); }).size(), 1u) << values;
}

TEST(XyzPosts, MayBeSeparatedInManyWays) {
  const std::string expected = "0 0 1\n2 0 2\n0 2 3\n2 2 4\n";
  const auto ground = ground_of(expected);
  for (const char* text :
       {"X, Y, Z\n0, 0, 1\n2,0,2\n0,2,3\n2,2,4",
        "# posts\r\n\r\n0;0;1\r\n2;0;2 # east\r\n0;2;3\r\n2;2;4\r\n",
        "easting\tnorthing\televation\n\t0\t0\t1\n2 0 2\n0 2 3\n+2 2e0 .4e1\n0 0 1\n"})
    EXPECT_EQ(ground_of(text).vertices, ground.vertices) << text;
  EXPECT_EQ(ground.triangles.size(), 2u);
}

TEST(XyzPosts, MayHaveMoreColumnsThatArePassedOver) {
  const auto plain = ground_of("0 0 1\n1 0 1\n0 1 2\n");
  const std::string scanned = "x y z intensity r\n0 0 1 0.5 255\n1 0 1 0.25 3 # here\n0 1 2 0 0\n";
  std::vector<Diagnostic> warnings;
  EXPECT_EQ(read_terrain(scanned, sample_place, &warnings).vertices, plain.vertices);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].place.line, 2);
  EXPECT_EQ(warnings[0].place.column, 7);
  EXPECT_EQ(warnings[0].message, "2 columns behind x, y and z are passed over, here from '0.5'");
  EXPECT_EQ(ground_of("0.5,0,1,7\n1,0,1,7\n0,1,2,7\n").vertices.size(), 3u);
}

/// The same four posts, x 0 and 2 east, y 0 and 5 north, z 1 to 4, under many headings.
TEST(XyzPosts, AreReadByTheirHeading) {
  const auto ground = ground_of("0 0 1\n2 0 2\n0 5 3\n2 5 4\n");
  const char* const with_codes =
      "Point,Northing,Easting,Elevation,Code\n7,0,0,1,EP\n9,0,2,2,\nA1,5,0,3,\"edge, top\"\n"
      "4,5,2,4,EP\n";
  for (const char* text :
       {"Northing,Easting,Elevation\n0,0,1\n0,2,2\n5,0,3\n5,2,4\n",
        "N E Z\n0 0 1\n0 2 2\n5 0 3\n5 2 4\n", "Z;Y;X\n1;0;0\n2;0;2\n3;5;0\n4;5;2\n",
        "Hochwert;Rechtswert;H\xC3\xB6he\n0;0;1\n0;2;2\n5;0;3\n5;2;4\n",
        "Hochwert;Rechtswert;H\xF6he\n0;0;1\n0;2;2\n5;0;3\n5;2;4\n", with_codes,
        "Pt No.\tCota\tNorte\tEste\n1\t1\t0\t0\n2\t2\t0\t2\n3\t3\t5\t0\n4\t4\t5\t2\n",
        "# N, E, Z\n0,0,1\n0,2,2\n5,0,3\n5,2,4\n",
        "# x y z of the survey of 2019\nN,E,Z\n0,0,1\n0,2,2\n5,0,3\n5,2,4\n",
        "//X Y Z R G B\n4\n0 0 1 9 9 9\n2 0 2 9 9 9\n0 5 3 9 9 9\n2 5 4 9 9 9\n",
        "4\n//Z Y X R G B\n1 0 0 9 9 9\n2 0 2 9 9 9\n3 5 0 9 9 9\n4 5 2 9 9 9\n",
        "Northing,Easting,Elevation\n(m),(cm),m\n0,0,1\n0,200,2\n5,0,3\n5,200,4\n"})
    EXPECT_EQ(ground_of(text).vertices, ground.vertices) << text;
}

TEST(XyzPosts, MayBeInFeetIfTheHeadingSaysSo) {
  std::vector<Diagnostic> warnings;
  const auto ground =
      read_terrain("E (m),N (m),Z (ft)\n0,0,10\n2,0,20\n0,5,30\n", sample_place, &warnings);
  EXPECT_EQ(ground.vertices[0][2], 10 * 0.3048);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].message, "Z (ft) is converted to metres, times 0.3048");
}

TEST(XyzPosts, MayBeInFeetOfSurveysAndAboveADatum) {
  const auto ground = ground_of("N (usft),E (US ft),Z (ftUS)\n0,0,10\n0,2,20\n5,0,30\n");
  EXPECT_DOUBLE_EQ(ground.vertices[0][2], 10 * 1200.0 / 3937);
  for (const char* datum : {"mAHD", "m AHD", "m a.s.l.", "m \xC3\xBC. M.", "m+NN", "RL"}) {
    const auto high =
        ground_of(std::string("N,E,Elevation (") + datum + ")\n0,0,10\n0,2,20\n5,0,30\n");
    EXPECT_EQ(high.vertices[0][2], 10) << datum;
  }
}

TEST(XyzPosts, InUnitsThatAreNotKnownAreRefused) {
  struct Wrong {
    const char* text;
    int line, column;
  };
  for (const Wrong& wrong : {Wrong{"ID,North (furlong),East (m),Elev (m)\n0,5,2,1\n", 1, 4},
                             Wrong{"North, furlong;East, m;Elev, m\n5;2;1\n", 1, 1},
                             Wrong{"# x,y,z (furlong)\n5,2,1\n", 1, 7},
                             Wrong{"N,E,Z\n(m),(furlong),(m)\n5,2,1\n", 2, 5}}) {
    const auto errors = errors_of_reading([&] { ground_of(wrong.text); });
    ASSERT_FALSE(errors.empty()) << wrong.text;
    EXPECT_EQ(errors[0].place.line, wrong.line) << listed(errors);
    EXPECT_EQ(errors[0].place.column, wrong.column) << listed(errors);
    EXPECT_NE(
        errors[0].message.find("is not known: lengths are in m, mm, cm, km, ft, usft, yd, in"),
        std::string::npos)
        << listed(errors);
  }
  EXPECT_NE(columns_fault({"n", "e", "z (furlong)"}).find("'z (furlong)' is not known"),
            std::string::npos);
}

TEST(XyzPosts, OfOtherColumnsTell) {
  std::vector<Diagnostic> warnings;
  read_terrain("Point,Northing,Easting,Elevation,Code\n7,0,0,1,a\n9,0,2,2,b\n8,5,0,3,c\n",
               sample_place, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].message, "2 columns are passed over: Point, Code");
}

TEST(XyzPosts, AreReadAsTheModelSays) {
  const std::vector<std::string> columns = {"point", "northing", "easting", "elevation", "code"};
  const auto ground = ground_of("0 0 1\n2 0 2\n0 5 3\n");
  std::vector<Diagnostic> warnings;
  for (const char* text :
       {"1,0,0,1,EP\n2,0,2,2,EP\n3,5,0,3,\n", "P1,0,0,1,EP\nP2,0,2,2,EP\nP3,5,0,3,EP\n",
        "a,b,c,d,e\n1,0,0,1,EP\n2,0,2,2,EP\n3,5,0,3,EP\n"})
    EXPECT_EQ(read_terrain(text, sample_place, &warnings, columns).vertices, ground.vertices)
        << text;
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(columns_fault(columns), "");
  EXPECT_EQ(columns_fault({}), "");
  EXPECT_NE(columns_fault({"point", "x", "y"}).find("names no column for z (up)"),
            std::string::npos);
  EXPECT_NE(columns_fault({"x", "x", "z"}).find("two columns for x (east)"), std::string::npos);
}

TEST(XyzPosts, MayPartThousandsWhereThatIsSure) {
  const std::vector<Vec3> wanted = {
      {412345.5, 5802117, 980}, {412345.5, 5802118, 1020}, {412400, 5802117, 1000}};
  for (const char* text :
       {"412,345.5;5,802,117;980\n412,345.5;5,802,118;1,020\n412,400;5,802,117;1,000\n",
        "X;Y;Z\n412,345.5;5,802,117;980\n412,345.5;5,802,118;1,020\n412,400;5,802,117;1,000\n",
        "412'345.5 5'802'117 980\n412'345.5 5'802'118 1'020\n412'400 5'802'117 1'000\n",
        "\"412,345.5\",\"5,802,117\",980\n\"412,345.5\",\"5,802,118\",\"1,020\"\n\"412,400\",\"5,"
        "802,117\",\"1,000\"\n"})
    EXPECT_EQ(ground_of(text).vertices, wanted) << text;
  EXPECT_EQ(
      errors_of_reading([] { ground_of("X;Y;Z\n1;2;412,345\n2;3;412,346\n2;4;412,346\n"); }).size(),
      3u)
      << "a comma that may be that of decimals";
}

TEST(XyzPosts, AskWhatTheColumnsAre) {
  const std::pair<const char*, const char*> cases[] = {
      {"1,5000,2000,100,EP\n2,5010,2000,101,EP\n3,5000,2010,102,EP\n",
       "the first column runs 1, 2, 3 …, as numbers of points do"},
      {"101 5000 2000 100\n102 5010 2000 101\n205 5000 2010 102\n", "runs 101, 102, 205 …"},
      {"P1,5000,2000,100,EP\nP2,5010,2000,101,EP\n", "begins with 'P1', a name"},
      {"Survey of the hill\n0 0 1\n1 0 1\n0 1 1\n", "a title stands behind '#'"},
      {"a,b,c\n0,0,1\n", "names no column for x (east) and y (north) and z (up)"},
      {"Easting,East,Northing,Z\n0,0,1,1\n", "two columns for x (east), 'Easting' and 'East'"},
      {"Easting,Northing,Depth\n0,0,1\n", "a depth counts downwards"},
      {"Lat,Lon,Elevation\n47,8,500\n", "reproject the table"},
      {"# N E Z\n0 0 1 7 7\n1 0 1 7 7\n0 1 1 7 7\n",
       "this comment names N, E, Z, the rows have 5 columns"},
      {"//X Y Z\n5\n0 0 1\n1 0 1\n0 1 1\n", "says that there are 5 posts, but 3 follow"},
      {"Code,N,E,Z\na,b,0,0,1\n", "has 5 fields, must have 4: Code, N, E, Z"},
      {"Code,N,E,Z\na,0,0\n", "has 3 fields, must have 4"},
  };
  for (const auto& [text, says] : cases) {
    const auto errors = errors_of_reading([&, t = text] { ground_of(t); });
    ASSERT_FALSE(errors.empty()) << text;
    EXPECT_NE(errors[0].message.find(says), std::string::npos) << errors[0].message;
  }
  EXPECT_EQ(ground_of("1 0 1 9\n1 1 1 9\n2 0 1 9\n").vertices.size(), 3u)
      << "whole x that do not rise";
}

TEST(XyzPosts, ScatteredAreJoinedByDelaunaysTriangulation) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> coordinate(0, 100);
  std::vector<std::string> lines = {"0 0 5", "100 0 5", "100 100 5", "0 100 5"};
  for (int i = 0; i < 500; ++i)
    lines.push_back(std::to_string(coordinate(random)) + " " + std::to_string(coordinate(random)) +
                    " 5");
  const auto text_of = [&] {
    std::string text;
    for (const auto& line : lines) text += line + "\n";
    return text;
  };
  const auto ground = ground_of(text_of());
  expect_sound(ground);
  EXPECT_EQ(ground.vertices.size(), 504u);
  EXPECT_EQ(ground.triangles.size(), 2 * 504 - 2 - 4u);  // Euler, four of them on the border
  EXPECT_NEAR(double_plan_area(ground), 2e4, 1e-8);
  std::shuffle(lines.begin(), lines.end(), random);
  EXPECT_EQ(ground_of(text_of()).triangles, ground.triangles) << "depends on the lines' order";
}

TEST(XyzPosts, OnCrookedBordersMakeNoSlivers) {
  // Rows whose ends are off their line by a millionth of a millimetre, at random.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<Real> noise(-1e-9, 1e-9);
  std::string text;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      char line[90];
      std::snprintf(line, sizeof line, "%.15g %.15g %d\n", i + noise(random), j + noise(random), 3);
      text += line;
    }
  const auto ground = ground_of(text);
  expect_sound(ground);
  for (const auto& [a, b, c] : ground.triangles) {
    const Vec3& p = ground.vertices[static_cast<std::size_t>(a)];
    EXPECT_GT(cross(ground.vertices[static_cast<std::size_t>(b)] - p,
                    ground.vertices[static_cast<std::size_t>(c)] - p)[2],
              0.9);
  }
  EXPECT_EQ(ground.triangles.size(), 2 * 19 * 19u);
}

TEST(WrongTerrains, SayWhatAndWhere) {
  struct Wrong {
    std::string text;
    int line, column;
    const char* says[2];
  };
  const Wrong cases[] = {
      {" \n\n", 0, 0, {"nothing but blanks"}},
      {"ncols 3\nnrows 2\n1 2 3\n4 5 6\n", 0, 0, {"header: xllcorner, yllcorner, cellsize"}},
      {"ncols 3\nnrow 2\n", 2, 1, {"'nrow' is no key", "did you mean \"nrows\"?"}},
      {"ncols 0\n", 1, 7, {"integer >= 1, is '0'"}},
      {"ncols 2.5\n", 1, 7, {"'2.5'"}},
      {"ncols", 1, 0, {"ends where the value of ncols must follow"}},
      {"ncols 3\nnrows 2\nxllcorner inf\nyllcorner 0\ncellsize 1\n1 2 3\n4 5 6\n",
       3,
       11,
       {"xllcorner is inf"}},
      {"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize -1\n1 2 3\n4 5 6\n",
       5,
       10,
       {"cellsize must be > 0"}},
      {"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 9e8\ncellsize 1e8\n1 2 3\n4 5 6\n",
       0,
       0,
       {"last post: y is 1.05e+09"}},
      {"ncols 3\nnrows 2\nxllcorner 1e8\nyllcorner 0\ncellsize 1e-9\n1 2 3\n4 5 6\n",
       5,
       0,
       {"cell size 1e-09 is too small"}},
      {"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 1\ndy 1e-300\n1 2 3\n4 5 6\n",
       6,
       0,
       {"cell size 1e-300 m is too small for this ground", "5.4e-09 m"}},
      {"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nCellSize 2\n1 2 3\n4 5 6\n",
       6,
       1,
       {"cellsize stands there twice, first in line 5"}},
      {"ncols 3\nnrows 2\nncols 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5 6\n",
       3,
       1,
       {"ncols stands there twice, first in line 1"}},
      {"ncols 3\nnrows 2\nxllcorner 0\nxllcenter 7\nyllcorner 0\ncellsize 1\n1 2 3\n4 5 6\n",
       4,
       1,
       {"xllcenter and xllcorner of line 3 say the same"}},
      {"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 1\ncellsize 1\n1 2 3\n4 5 6\n",
       6,
       1,
       {"cellsize and dx of line 5 say the same"}},
      {"0 0 1\n1 0 1\n1 1 1\n0.99999999999 1e-12 1\n",
       4,
       0,
       {"lies 1e-11 m beside the post of line 2", "nearer than 1.4e-09 m"}},
      // A gap along x that is no gap along y, and the later line first in x.
      {"0 0 1\n1 5 1\n0.9999999999 0 1\n0 9 1\n1 0 1\n",
       5,
       0,
       {"lies 1e-10 m beside the post of line 3"}},
      {header23 + "1 2 3\n4 5\n", 7, 0, {"ends after 5 of 6 values", "ncols = 3"}},
      {header23 + "1 2 3\n4 5 6\n7\n", 8, 1, {"goes on after 6 values"}},
      {header23 + "1 2 3\n4 x 6\n", 7, 3, {"elevation must be a number, is 'x'"}},
      {header23 + "1 2 3\n4 nan 6\n", 7, 3, {"elevation is nan", "NODATA_value is -9999"}},
      {header23 + "1 2 3\n4 -3.4e38 6\n", 7, 3, {"-3.4e+38", "NODATA_value is -9999"}},
      {header23 + "1 -9999 3\n-9999 5 -9999\n", 0, 0, {"no three neighbouring posts"}},
      {"ncols 6\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4 5 6\n",
       0,
       0,
       {"two rows and columns"}},
      {"ncols 2000000000\nnrows 2000000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n",
       6,
       0,
       {"1 of 4000000000000000000 values"}},
      {"0 0 1\n1 0\n", 2, 4, {"z is missing"}},
      {"0 0 1\n1 0 x\n", 2, 5, {"z must be a number, is 'x'"}},
      {"0 0 1\n1 0 nan\n", 2, 5, {"z is nan"}},
      {"0 0 1\n1 2e9 1\n", 2, 3, {"y is 2e+09"}},
      {"0 0 1\n1 0 1 7\n", 2, 7, {"goes on with '7'"}},
      {"0 0 1 7\n1 0 1 7 8\n", 2, 9, {"goes on with '8'"}},
      {"1,5;2,5;3,5\n", 1, 7, {"decimals behind a point", "1.5, not 1,5 (a decimal comma)"}},
      {"1,5 2,5 3,5\n2,5 2,5 3,5\n", 1, 7, {"1.5, not 1,5 (a decimal comma)"}},
      {"1,5,2,5,3,5\n", 1, 7, {"these commas may separate numbers or decimals"}},
      {"x y z\nmore words here\n", 2, 1, {"x must be a number, is 'more'"}},
      {"0 0 1\n1 0 1\n", 0, 0, {"three posts at least, has 2"}},
      {"0 0 1\n1 1 1\n3 3 1\n", 0, 0, {"one line"}},
      {"0 0 1\n1 1 1\n0 1 7\n\n0 1 8\n",
       5,
       0,
       {"(0, 1, 8) lies over the post of line 3", "z is 7"}},
      {std::string("\0\x01\xff\xfe 1 2\n1 2 3", 14), 2, 1, {"names no column for x"}},
  };
  for (const auto& wrong : cases) {
    const auto errors = errors_of_reading([&] { ground_of(wrong.text); });
    const auto text = listed(errors);
    ASSERT_FALSE(errors.empty()) << wrong.text;
    if (wrong.text[0] != '\0') {
      EXPECT_EQ(errors[0].place.line, wrong.line) << text;
      EXPECT_EQ(errors[0].place.column, wrong.column) << text;
    }
    for (const char* part : wrong.says)
      EXPECT_TRUE(!part || text.find(part) != std::string::npos) << part << " is not in\n" << text;
  }
}

TEST(WrongTerrains, MayLieBelowTheirBase) {
  const auto ground = ground_of(header23 + "1 2 3\n4 5 1\n");
  EXPECT_TRUE(errors_of_reading([&] { check_above(ground, 0.999, sample_place); }).empty());
  const auto errors = errors_of_reading([&] { check_above(ground, 1, sample_place); });
  EXPECT_NE(listed(errors).find("base = 1 m everywhere: 2 posts do not, the lowest at (15, 21, 1)"),
            std::string::npos)
      << listed(errors);
}

TEST(WrongTerrains, MayBeTooFineForTheirHeight) {
  const auto ground =
      ground_of("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1e-8\n1 1 1\n1 1 1\n");
  EXPECT_TRUE(errors_of_reading([&] { check_fine_posts(ground, 0, sample_place); }).empty());
  const auto errors = errors_of_reading([&] { check_fine_posts(ground, -99, sample_place); });
  EXPECT_NE(listed(errors).find("are 1e-08 m apart in plan"), std::string::npos) << listed(errors);
}

/// 2000 × 2000 posts, 4 million, 28 MB of text: seconds on any machine, minutes if numbers were read by streams or
/// anything grew faster than the posts.
TEST(SlowTerrain, OfFourMillionPostsLoadsInSeconds) {
  std::string text = "ncols 2000\nnrows 2000\nxllcorner 500000\nyllcorner 4000000\ncellsize 5\n";
  for (int i = 0; i < 4000000; ++i)
    text +=
        i % 2000 < 500 && i % 97 == 0 ? "-9999 " : std::to_string(1000 + (i * 37) % 199) + ".25 ";
  const auto start = std::chrono::steady_clock::now();
  const auto ground = ground_of(text);
  const std::chrono::duration<Real> seconds = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(seconds.count()));
  EXPECT_GT(ground.triangles.size(), 7500000u);
  EXPECT_LT(seconds.count(), 60);
}

}  // namespace rockfold
