#include "kernels/integrate/moments.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/reference/box_covers.hpp"

namespace rockfold {
namespace {

Real rational(const std::string& text) {
  const std::size_t slash = text.find('/');
  const long double top = std::stold(text.substr(0, slash));
  return static_cast<Real>(slash == std::string::npos ? top
                                                      : top / std::stold(text.substr(slash + 1)));
}

struct Body {
  std::string name;
  std::vector<Vec3> vertices;
  std::vector<Index>
      triangles;  ///< polygons fanned from their first corner: signed, so concave ones are right too
  std::vector<std::pair<std::string, Real>> integrals;
};

std::vector<Body> read_cases() {
  std::ifstream file(std::string(ROCKFOLD_SOURCE_DIR) + "/tests/integrate/moment_cases.txt");
  std::vector<Body> bodies;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    if (kind == "body") {
      std::getline(words, word);
      bodies.push_back({word, {}, {}, {}});
    } else if (kind == "vertex") {
      Vec3 x{};
      for (Real& c : x) words >> word, c = rational(word);
      bodies.back().vertices.push_back(x);
    } else if (kind == "face") {
      std::vector<Index> corners;
      for (Index i = 0; words >> i;) corners.push_back(i);
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        for (Index c : {corners[0], corners[i], corners[i + 1]})
          bodies.back().triangles.push_back(c);
    } else if (kind == "integral") {
      std::string exponents;
      words >> exponents >> word;
      bodies.back().integrals.emplace_back(exponents, rational(word));
    }
  }
  return bodies;
}

/// All bodies as one call.
ClosedSurfaces surfaces_of(const std::vector<Body>& bodies) {
  ClosedSurfaces surfaces;
  surfaces.triangle_begin = {0};
  for (const Body& body : bodies) {
    const Index first = static_cast<Index>(surfaces.vertex_xyz.size() / 3);
    for (const Vec3& x : body.vertices)
      surfaces.vertex_xyz.insert(surfaces.vertex_xyz.end(), x.begin(), x.end());
    for (Index i : body.triangles) surfaces.triangle_vertex.push_back(first + i);
    surfaces.triangle_begin.push_back(static_cast<Index>(surfaces.triangle_vertex.size() / 3));
  }
  return surfaces;
}

/// The integral of the absolute monomial over the body's bounding box: what its rounding is measured against where the
/// integral itself cancels (a symmetric body's odd moments are zero).
Real size_of(const Body& body, const std::string& exponents) {
  Real size = 1;
  for (int d = 0; d < 3; ++d) {
    Real low = body.vertices[0][d], high = low;
    for (const Vec3& x : body.vertices) low = std::min(low, x[d]), high = std::max(high, x[d]);
    size *= (high - low) * std::pow(std::max(std::abs(low), std::abs(high)), exponents[d] - '0');
  }
  return size;
}

TEST(Monomials, OfTheReferenceBodiesEqualTheExactRationals) {
  const std::vector<Body> bodies = read_cases();
  ASSERT_EQ(bodies.size(), 12u);
  const std::vector<Real> found = integrate_monomials(surfaces_of(bodies));
  for (std::size_t s = 0; s < bodies.size(); ++s)
    for (const auto& [exponents, expected] : bodies[s].integrals) {
      const Real value =
          found[monomial_count * s +
                monomial_index(exponents[0] - '0', exponents[1] - '0', exponents[2] - '0')];
      EXPECT_NEAR(value, expected,
                  1e-13 * std::max(std::abs(expected), 0.1 * size_of(bodies[s], exponents)))
          << bodies[s].name << ", x^y^z^ " << exponents;
    }
}

/// Irregular and off the origin: no symmetry for an error to cancel in, no zero to hide it.
CoverArrays one_tetrahedron() {
  CoverArrays covers;
  covers.lattice.edge = {{{6, 0, 0}, {0, 6, 0}, {0, 0, 6}}};
  covers.lattice.cells = {1, 1, 1};
  covers.cover_node = {0, 1, 2, 3, 4, 5, 6, 7};
  covers.element_cell = {0};
  covers.element_part = {3};
  covers.element_cover = {0, 4, 6, 7};
  covers.element_material = {0};
  covers.piece_begin = {0, 1};
  covers.piece_block = {0};
  covers.triangle_begin = {0, 4};
  covers.triangle_vertex = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  covers.vertex_begin = {0, 4};
  covers.vertex_xyz = {0.5, -1.0 / 3, 2, 3, 0.25, 7.0 / 3, 1, 2.5, 3, 1.5, 1, 5.5};
  return covers;
}

TEST(PieceMoments, OfAnIrregularTetrahedronEqualTheClosedForm) {
  const PieceMoments m = piece_moments(one_tetrahedron());
  const Real v = 2923.0 / 864;   // cases A, "T1"
  const Real tolerance = 1e-13;  // some tens of operations on numbers up to 250
  EXPECT_NEAR(m.volume[0] / v, 1, tolerance);
  EXPECT_NEAR(m.first[0][0] / (1.5 * v), 1, tolerance);
  EXPECT_NEAR(m.first[0][1] / (41.0 / 48 * v), 1, tolerance);
  EXPECT_NEAR(m.first[0][2] / (77.0 / 24 * v), 1, tolerance);
  // In units of the cell's edges, 6 m each.
  const auto second = [&](int a, int b, int c) { return 36 * m.local[monomial_index(a, b, c)]; };
  EXPECT_NEAR(second(2, 0, 0) / (283531.0 / 34560), 1, tolerance);
  EXPECT_NEAR(second(0, 2, 0) / (803825.0 / 248832), 1, tolerance);
  EXPECT_NEAR(second(0, 0, 2) / (11227243.0 / 311040), 1, tolerance);
  EXPECT_NEAR(second(1, 1, 0) / (879823.0 / 207360), 1, tolerance);
  EXPECT_NEAR(second(0, 1, 1) / (11946301.0 / 1244160), 1, tolerance);
  EXPECT_NEAR(second(1, 0, 1) / (225071.0 / 13824), 1, tolerance);
}

/// The reference bodies as pieces of lattice cells of unequal edges.
TEST(PieceMoments, OfTheReferenceBodiesInTheirOwnUnitsEqualTheExactRationals) {
  const std::vector<Body> bodies = read_cases();
  for (const int degree : {2, 4, 6, 8, 10}) {
    CoverArrays covers;
    covers.lattice.edge = {
        {{2, 0, 0}, {0, 0.5, 0}, {0, 0, 8}}};  // powers of two: η^m scales exactly
    covers.lattice.cells = {1, 1, 1};
    covers.piece_begin = {0};
    covers.triangle_begin = covers.vertex_begin = {0};
    for (const Body& body : bodies) {
      const Index first = static_cast<Index>(covers.vertex_xyz.size() / 3);
      for (const Vec3& x : body.vertices)
        covers.vertex_xyz.insert(covers.vertex_xyz.end(), x.begin(), x.end());
      for (Index i : body.triangles) covers.triangle_vertex.push_back(first + i);
      covers.triangle_begin.push_back(static_cast<Index>(covers.triangle_vertex.size() / 3));
      covers.vertex_begin.push_back(static_cast<Index>(covers.vertex_xyz.size() / 3));
      covers.piece_block.push_back(0);
      covers.element_cell.push_back(0);
      covers.piece_begin.push_back(covers.piece_count());
    }
    const PieceMoments m = piece_moments(covers, degree);
    const std::size_t terms = m.local.size() / bodies.size();
    for (std::size_t s = 0; s < bodies.size(); ++s)
      for (const auto& [exponents, expected] : bodies[s].integrals) {
        const int a = exponents[0] - '0', b = exponents[1] - '0', c = exponents[2] - '0';
        if (a + b + c > degree) continue;
        const Real value = m.local[terms * s + monomial_index(a, b, c)] * std::pow(2, a) *
                           std::pow(0.5, b) * std::pow(8, c);
        EXPECT_NEAR(value, expected,
                    1e-13 * std::max(std::abs(expected), 0.1 * size_of(bodies[s], exponents)))
            << bodies[s].name << ", x^y^z^ " << exponents << ", degree " << degree;
      }
  }
}

/// Degrees above the reference's: a box, whose moments are products.
TEST(PieceMoments, OfABoxEqualTheProductsOfItsSidesUpToDegreeTen) {
  const auto covered = reference::cover_regions(
      {LatticeKind::tet6, {-1, -1, -1}, {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}}, {1, 1, 1}, false, {}},
      {reference::box({-0.3, -0.9, 0.2}, {0.7, 0.1, 0.95})});
  const PieceMoments m = piece_moments(covered.arrays, 10);
  const std::size_t terms = 286;
  const auto one = [](Real low, Real high, int n) {
    return (std::pow(high, n + 1) - std::pow(low, n + 1)) / (n + 1);
  };
  for (int a = 0; a <= 10; ++a)
    for (int b = 0; a + b <= 10; ++b)
      for (int c = 0; a + b + c <= 10; ++c) {
        Real sum = 0;
        for (std::size_t q = 0; q < m.volume.size(); ++q)
          sum += m.local[terms * q + monomial_index(a, b, c)];
        const Real expected = 8 * one(-0.15, 0.35, a) * one(-0.45, 0.05, b) * one(0.1, 0.475, c);
        const Real size = std::pow(0.35, a) * std::pow(0.45, b) * std::pow(0.475, c);
        EXPECT_NEAR(sum, expected, 1e-13 * std::max(std::abs(expected), 0.1 * size));
      }
}

TEST(PieceMoments, OfPiecesAddUpToTheBoxThatWasCut) {
  const Vec3 low{0.31, -0.2, 1.07}, high{2.93, 1.88, 3.4};
  const auto covered = reference::cover_regions(
      reference::turned_lattice({0.1, 0.2, 0.3}, 0.7, 0.4, 0.3, {1.6, 0.8, 2.2}, 2.2),
      {reference::box(low, high)});
  const PieceMoments m = piece_moments(covered.arrays);
  Real volume = covered.arrays.regular_count() * std::pow(0.7, 3);
  for (Real v : m.volume) volume += v;
  // 1,200 pieces, each with 1e-16 of a cell's volume of rounding from its vertices.
  EXPECT_NEAR(volume, 2.62 * 2.08 * 2.33, 1e-12);
}

std::string message_for(const CoverArrays& covers) {
  try {
    piece_moments(covers);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::analysis);
    return error.what();
  }
  return "no error";
}

/// Three equal elements of which some are spoilt.
CoverArrays three_tetrahedra() {
  const CoverArrays one = one_tetrahedron();
  CoverArrays three = one;
  for (Index e = 1; e < 3; ++e) {
    three.element_cell.push_back(0);
    three.element_part.push_back(3);
    three.element_material.push_back(0);
    three.piece_begin.push_back(e + 1);
    three.piece_block.push_back(0);
    three.triangle_begin.push_back(4 * (e + 1));
    three.vertex_begin.push_back(4 * (e + 1));
    for (Index i : one.triangle_vertex) three.triangle_vertex.push_back(4 * e + i);
    for (Index p : one.element_cover) three.element_cover.push_back(p);
    for (Real x : one.vertex_xyz) three.vertex_xyz.push_back(x);
  }
  return three;
}

TEST(PieceMoments, RejectAnInsideOutPieceByTheSmallestIndex) {
  CoverArrays covers = three_tetrahedra();
  for (Index t = 4; t < 12; ++t)
    std::swap(covers.triangle_vertex[3 * t], covers.triangle_vertex[3 * t + 1]);
  EXPECT_NE(message_for(covers).find("piece 1 of manifold element 1"), std::string::npos)
      << message_for(covers);
}

TEST(PieceMoments, RejectAPieceThatIsNotANumber) {
  CoverArrays covers = three_tetrahedra();
  covers.vertex_xyz[3 * 10 + 1] = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_NE(message_for(covers).find("piece 2 of manifold element 2"), std::string::npos)
      << message_for(covers);
}

TEST(PieceMoments, GiveAPieceFlattenedByRoundingTheLeastVolumeAtItsPlace) {
  CoverArrays covers = one_tetrahedron();
  for (int d = 0; d < 3; ++d)  // the last vertex into the plane of the others, to rounding
    covers.vertex_xyz[9 + d] =
        (covers.vertex_xyz[d] + covers.vertex_xyz[3 + d] + covers.vertex_xyz[6 + d]) / 3;
  const PieceMoments m = piece_moments(covers);
  EXPECT_GT(m.volume[0], 0);
  EXPECT_LT(m.volume[0], 1e-14 * 216);
}

}  // namespace
}  // namespace rockfold
