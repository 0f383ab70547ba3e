#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/solve/systems/jointed_cube.hpp"

namespace rockfold {
namespace {

std::string hash(const std::vector<Vec3>& values) {
  std::uint64_t h = 1469598103934665603u;  // FNV-1a over the bits
  for (const Vec3& v : values)
    for (Real x : v) {
      std::uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      for (int byte = 0; byte < 8; ++byte) h = (h ^ (bits >> 8 * byte & 255)) * 1099511628211u;
    }
  return std::to_string(h);
}

/// Thousands of covers of both kinds, so that every sum has several chunks.
SmallSystem large_system(LatticeKind kind, int order, Real spacing) {
  SmallSystem s;
  Lattice lattice = reference::turned_lattice({0.1, 0.2, 0.3}, spacing, 0, 0, {1, 1, 1}, 1.2);
  lattice.kind = kind;
  s.covered = reference::cover_regions(lattice, {reference::box({0, 0, 0}, {2, 2, 1}, 0, 0, 0),
                                                 reference::box({0, 0, 1}, {2, 2, 2}, 0, 1, 1)});
  s.covered.arrays.order = order;
  s.materials = {{2000, 1e6, 0.25}};
  s.fixed = reference::fix(
      s.covered, {{0.1, 0.1, 0}, {1.9, 0.1, 0}, {0.2, 1.9, 0}, {1.8, 1.9, 0.1}},
      [](const Vec3&) { return Vec3{}; }, 1e6, true);
  return s;
}

std::string results(LatticeKind kind, int order, Real spacing) {
  const SmallSystem s = large_system(kind, order, spacing);
  CoverSystem system = s.make();
  const auto b = reference::scattered(s.covers().unknown_count(), 11);
  std::vector<Vec3> x(b.size());
  const SolveReport report = system.solve({1, 1e4, 1}, b, x, {1e-9, 150});
  CoverSystem by_grids(s.covers(), piece_moments(s.covers()), s.materials, s.fixed,
                       Preconditioner::multigrid);
  std::vector<Vec3> z(b.size());
  const SolveReport of_grids = by_grids.solve({1, 1, 1}, b, z, {1e-9, 150});
  return hash(z) + " " + std::to_string(of_grids.iterations) + " " +
         std::to_string(of_grids.converged) + " " + hash(system.apply({0.3, 0.7, 1.1}, b)) + " " +
         hash(x) + " " + std::to_string(report.iterations) + " " + std::to_string(report.converged);
}

/// By multigrid that knows contacts.
std::string contact_results(int order, Index n) {
  const JointedCube cube = jointed_cube(n, order, LatticeKind::tet6, partly_open(n, 10));
  const SmallSystem& s = cube.system;
  CoverSystem system(s.covers(), piece_moments(s.covers()), s.materials, s.fixed,
                     Preconditioner::multigrid);
  system.set_contacts(cube.points, cube.tangent);
  const auto b = reference::scattered(s.covers().unknown_count(), 11);
  std::vector<Vec3> x(b.size());
  const SolveReport report = system.solve({1, 1, 1}, b, x, {1e-9, 150});
  return " " + hash(x) + " " + std::to_string(report.iterations) + " " +
         std::to_string(report.converged);
}

/// Not a test by itself: what the one below runs again with other numbers of threads.
TEST(Threads, PrintResults) {
  const char* path = std::getenv("ROCKFOLD_THREADS_TEST_FILE");
  if (!path) GTEST_SKIP() << "run by Threads.ChangeNoBitOfTheResults";
  std::FILE* file = std::fopen(path, "w");
  ASSERT_NE(file, nullptr);
  std::fputs(results(LatticeKind::tet5, 1, 0.4).c_str(), file);
  std::fputs(results(LatticeKind::hex8, 2, 0.9).c_str(), file);
  std::fputs(results(LatticeKind::tet6, 0, 0.125).c_str(), file);
  std::fputs(contact_results(1, 7).c_str(), file);
  std::fputs(contact_results(0, 15).c_str(), file);
  std::fclose(file);
}

std::string results_with(int threads) {
  const std::string path =
      testing::TempDir() + "rockfold_threads_" + std::to_string(getpid()) + ".txt";
  const std::string command = "ROCKFOLD_THREADS_TEST_FILE='" + path +
                              "' OMP_PROC_BIND=false OMP_NUM_THREADS=" + std::to_string(threads) +
                              " '" + testing::internal::GetArgvs()[0] +
                              "' --gtest_filter=Threads.PrintResults > /dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return "failed";
  char text[800] = "";
  std::FILE* file = std::fopen(path.c_str(), "r");
  if (file) {
    if (!std::fgets(text, sizeof text, file)) text[0] = 0;
    std::fclose(file);
  }
  std::remove(path.c_str());
  return text;
}

TEST(LongThreads, ChangeNoBitOfTheResults) {
  const std::string alone = results_with(1);
  EXPECT_EQ(alone.back(), '1') << "did not converge: " << alone;
  EXPECT_EQ(results_with(2), alone);
  EXPECT_EQ(results_with(4), alone);
}

}  // namespace
}  // namespace rockfold
