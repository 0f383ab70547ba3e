// Covers with a local series (thesis 4.1.2 b): polynomials given as a series are the polynomials, and a field that only the series
// holds is found where it is loaded as it asks.
#include <limits>

#include <gtest/gtest.h>

#include "src/arrays/element_points.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/error.hpp"
#include "tests/reference/face_points.hpp"
#include "tests/solve/series.hpp"
#include "tests/solve/spaces.hpp"
#include "tests/solve/systems.hpp"

namespace rockfold {
namespace {

const Vec3 low{0.05, 0.02, 0.03}, high{1.1, 0.95, 0.9};
const std::vector<Vec3> inside{{0.07, 0.9, 0.88}, {0.5, 0.5, 0.5}, {1.05, 0.03, 0.85},
                               {0.3, 0.7, 0.2},   {0.9, 0.8, 0.4}, {0.06, 0.03, 0.04}};

/// A box that no lattice plane meets.
SmallSystem box_of(LatticeKind kind, int order, Real spacing = 0.6, bool turned = true) {
  SmallSystem s;
  Lattice lattice = reference::turned_lattice({0.11, -0.23, 0.37}, spacing, turned ? 0.3 : 0,
                                              turned ? 0.2 : 0, {0.57, 0.5, 0.46}, 0.9);
  lattice.kind = kind;
  if (kind == LatticeKind::block) {
    lattice.cells = {0, 0, 0};
    lattice.block_origin = {{0.5, 0.5, 0.4}};
  }
  s.covered = reference::cover_regions(lattice, {reference::box(low, high)});
  s.covered.arrays.order = order;
  s.materials = {{2000, 1e3, 0.25}};
  return s;
}

Vec3 displacement(const MaterialPoints& at, std::size_t n, const std::vector<Vec3>& x) {
  return interpolate(at, n, x);
}

class Monomials : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(AsASeries, Monomials, testing::ValuesIn([] {
                           std::vector<Space> wanted;
                           for (const Space& space : spaces(true))
                             if (space.order > 0 &&
                                 (space.kind != LatticeKind::block || space.order > 1))
                               wanted.push_back(space);
                           return wanted;
                         }()),
                         space_name);

/// The matrices of order p, and of order p − 1 with the monomials of order p as a series: exact moments against points.
TEST_P(Monomials, HaveTheMatricesOfTheirOrder) {
  const auto [kind, order] = GetParam();
  const Real spacing = order > 1 ? 0.9 : 0.55;
  const SmallSystem s = cut_system(kind, order, spacing);
  SmallSystem t = cut_system(kind, order - 1, spacing);
  CoverArrays& covers = t.covered.arrays;
  covers.series = std::make_shared<MonomialSeries>(covers.lattice, order - 1, order);
  ASSERT_EQ(covers.unknown_count(), s.covers().unknown_count());
  const auto x = reference::scattered(covers.unknown_count(), 5);
  for (const SystemCoefficients c : {SystemCoefficients{1, 0, 0}, SystemCoefficients{0, 1, 0}}) {
    const auto y = s.make().apply(c, x), z = t.make().apply(c, x);
    EXPECT_LE(reference::largest_difference(y, z), 2e-13 * reference::largest(y));
  }
}

/// Held and loaded, by either preconditioner: the same displacement, though the systems are singular.
TEST_P(Monomials, MoveAsTheirOrder) {
  const auto [kind, order] = GetParam();
  if (kind == LatticeKind::hex8 && order == 2) GTEST_SKIP() << "nearly dependent: patch_test.cpp";
  std::vector<std::vector<Vec3>> moved;
  for (const bool as_series : {false, true})
    for (const auto preconditioner :
         {Preconditioner::node_block_jacobi, Preconditioner::multigrid}) {
      SmallSystem s = box_of(kind, as_series ? order - 1 : order);
      CoverArrays& covers = s.covered.arrays;
      if (as_series)
        covers.series = std::make_shared<MonomialSeries>(covers.lattice, order - 1, order);
      // Held points and a force enter by the functions of their elements, the series' among them.
      s.fixed = reference::fix(
          s.covered, {{0.1, 0.1, 0.1}, {1.0, 0.1, 0.2}, {0.2, 0.9, 0.1}, {0.6, 0.5, 0.8}},
          [](const Vec3& x) {
            return Vec3{0, 0.01 * x[0], 0};
          },
          1e3, true);
      const MaterialPoints at = reference::locate(s.covered, inside);
      std::vector<Vec3> load(covers.unknown_count()), x(load.size());
      for (Index i = at.begin[2]; i < at.begin[3]; ++i)
        load[at.unknown[i]] += at.weight[i] * Vec3{1, -2, 3};
      CoverSystem system(covers, piece_moments(covers), s.materials, s.fixed, preconditioner);
      const SolveReport report = system.solve({1, 0, 1}, load, x, {1e-12, 20000, 1e-11, 400});
      EXPECT_TRUE(report.converged) << report.residual;
      moved.emplace_back();
      for (std::size_t n = 0; n < inside.size(); ++n)
        moved.back().push_back(displacement(at, n, x));
    }
  for (std::size_t k = 1; k < moved.size(); ++k)
    EXPECT_LE(reference::largest_difference(moved[0], moved[k]),
              1e-7 * reference::largest(moved[0]))
        << k;
}

struct Trial {
  Real error = 0;  ///< largest at the points inside, over the largest displacement there
  Index iterations = 0;
};

/// Loads the box as the field asks and holds four points where they belong.
Trial find_field(SmallSystem s, const HarmonicField& field, bool augmented) {
  const CoverArrays& covers = s.covers();
  s.fixed = reference::fix(
      s.covered, {{0.1, 0.1, 0.1}, {1.0, 0.1, 0.2}, {0.2, 0.9, 0.1}, {0.6, 0.5, 0.8}},
      [&](const Vec3& x) { return field.at(x); }, 1e3, augmented);
  std::vector<Vec3> load(covers.unknown_count()), x(load.size());
  MaterialPoints on_faces;
  std::vector<Vec3> force;
  reference::for_each_face_point(covers, low, high, 9,
                                 [&](Index e, const Vec3& at, const Vec3& n, Real area) {
                                   add_material_point(covers, at, e, on_faces);
                                   force.push_back(area * field.traction(s.materials[0], at, n));
                                 });
  for (std::size_t n = 0; n < force.size(); ++n)
    for (Index i = on_faces.begin[n]; i < on_faces.begin[n + 1]; ++i)
      load[on_faces.unknown[i]] += on_faces.weight[i] * force[n];
  CoverSystem system = s.make();
  const SolveReport report = system.solve({1, 0, 1}, load, x, {1e-13, 20000});
  EXPECT_TRUE(report.converged) << report.residual << " after " << report.iterations;
  // No force is needed to hold the field where it is.
  Trial trial{0, report.iterations};
  const MaterialPoints at = reference::locate(s.covered, inside);
  Real largest = 0;
  for (std::size_t n = 0; n < inside.size(); ++n) {
    largest = std::max(largest, norm(field.at(inside[n])));
    trial.error = std::max(trial.error, norm(displacement(at, n, x) - field.at(inside[n])));
  }
  trial.error /= largest;
  return trial;
}

constexpr HarmonicField field{3, 1e-4};

class LongHarmonic : public testing::TestWithParam<LatticeKind> {};
INSTANTIATE_TEST_SUITE_P(EveryLattice, LongHarmonic,
                         testing::Values(LatticeKind::tet5, LatticeKind::tet5_mixed,
                                         LatticeKind::tet6, LatticeKind::tet6_kuhn,
                                         LatticeKind::tet24, LatticeKind::hex8, LatticeKind::block),
                         [](const auto& of) {
                           std::string name = lattice_name(of.param);
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

TEST_P(LongHarmonic, FieldsAreFoundByASeriesThatHoldsThemAndByNoPolynomial) {
  const LatticeKind kind = GetParam();
  const bool block = kind == LatticeKind::block;
  SmallSystem s = box_of(kind, block ? 1 : 0);
  s.covered.arrays.series = std::make_shared<HarmonicSeries>(field.rate);
  for (const bool augmented : {false, true}) {
    const Trial trial = find_field(s, field, augmented);
    EXPECT_LE(trial.error, 1e-8) << trial.iterations << " iterations";
  }
  if (kind == LatticeKind::hex8) return;  // order 2 on slivers: patch_test.cpp
  for (int order = block ? 1 : 0; order <= 2; ++order)
    EXPECT_GE(find_field(box_of(kind, order), field, false).error, 1e-3) << order;
}

TEST(LongLocalSeries, LeavesOutOfTheIntegralsWhatItsDegreeSays) {
  Real before = 1;
  for (const int degree : {2, 6, 10, 14}) {
    SmallSystem s = box_of(LatticeKind::tet6, 0);
    s.covered.arrays.series = std::make_shared<HarmonicSeries>(field.rate, degree);
    const Real error = find_field(s, field, false).error;
    EXPECT_LE(error, 0.05 * before) << degree;
    before = error;
  }
}

/// Functions in half of the covers: the others' unknowns stay at rest, and the answer is better than without.
TEST(LongLocalSeries, MayBeOfSomeCoversOnly) {
  SmallSystem s = box_of(LatticeKind::tet6, 0);
  const Real without = find_field(s, field, false).error;
  s.covered.arrays.series = std::make_shared<HarmonicSeries>(field.rate, 16, 0.5);
  const Real with = find_field(s, field, false).error;
  EXPECT_GT(with, 1e-6);
  EXPECT_LT(with, 0.5 * without);
}

TEST(LocalSeries, IntegratesTheVolumeOfEveryElement) {
  for (const LatticeKind kind : {LatticeKind::tet6, LatticeKind::tet5_mixed, LatticeKind::hex8}) {
    const SmallSystem s = box_of(kind, 0, 0.3);
    const CoverArrays& covers = s.covers();
    ASSERT_GT(covers.regular_count(), 0);
    const PieceMoments moments = piece_moments(covers);
    const ElementPoints rule(covers, 3);
    const Index whole = covers.parts_per_cell() * covers.regular_count();
    Real total = 0;
    std::vector<RockPoint> points;
    for (Index e = 0; e < covers.element_count(); ++e) {
      points.clear();
      rule.add_element(e, points);
      Real volume = 0;
      for (const RockPoint& p : points) {
        EXPECT_GT(p.weight, 0);
        volume += p.weight;
      }
      total += volume;
      if (e < whole) continue;
      Real given = 0;
      for (Index q = covers.piece_begin[e - whole]; q < covers.piece_begin[e - whole + 1]; ++q)
        given += cell_split(kind).share * moments.volume[q];
      EXPECT_NEAR(volume, given, 1e-16) << e;
    }
    Real expected = 1;
    for (int d = 0; d < 3; ++d) expected *= high[d] - low[d];
    EXPECT_NEAR(total, expected, 1e-13);
  }
}

/// As many functions as asked for, of which the first is `value`.
class Constant : public LocalSeries {
 public:
  Constant(int functions, Real value) : functions_(functions), value_(value) {}
  int functions() const override { return functions_; }
  void evaluate(const SeriesPoint&, FunctionValue* f) const override { f[0].value = value_; }

 private:
  int functions_;
  Real value_;
};

std::string refusal(LatticeKind kind, int order, std::shared_ptr<const LocalSeries> series) {
  SmallSystem s = box_of(kind, order);
  s.covered.arrays.series = std::move(series);
  try {
    s.make();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::analysis);
    return error.what();
  }
  return "none";
}

TEST(LocalSeries, IsRefusedWithWhatIsWrong) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_NE(refusal(LatticeKind::tet6, 1, std::make_shared<Constant>(7, 1))
                .find("found 7 functions beside the 4 of order 1; must be 1 to 6"),
            std::string::npos);
  EXPECT_NE(refusal(LatticeKind::tet6, 0, std::make_shared<Constant>(0, 1)).find("found 0"),
            std::string::npos);
  EXPECT_NE(refusal(LatticeKind::tet6, 0, std::make_shared<Constant>(1, nan))
                .find("no finite number at ("),
            std::string::npos);
  EXPECT_NE(refusal(LatticeKind::block, 0, std::make_shared<Constant>(1, 1)).find("cannot turn"),
            std::string::npos);
  EXPECT_EQ(refusal(LatticeKind::tet6, 0, std::make_shared<Constant>(9, 1)), "none");
}

}  // namespace
}  // namespace rockfold
