// Data sets of several chunks, which are packed on all threads, come back as they were.
#include <random>

#include <gtest/gtest.h>

#include "src/io/hdf5/hdf5_file.hpp"
#include "tests/io/sample.hpp"

namespace rockfold::test {
namespace {

using hdf5::File;

std::int64_t bytes_of(const File& file, const std::string& group) {
  return file.datasets({group}).front().bytes;
}

TEST(PackedRows, ComeBackWhateverTheLastChunkHolds) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  // Random digits, which hardly pack; ids, which pack well; bytes. No number of rows is one of whole chunks.
  std::mt19937_64 random(7);
  std::vector<Vec3> points(70001);
  for (Vec3& x : points)
    for (Real& value : x) value = std::uniform_real_distribution<Real>(1, 2)(random);
  std::vector<Index> ids(600007);
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<Index>(i / 6);
  const std::vector<std::uint8_t> bytes(1500003, 1);
  {
    File file(path, File::Mode::create, path);
    file.write("/points/x", points);
    file.write("/ids/x", ids);
    file.write("/bytes/x", bytes);
    file.close();
  }
  const File file(path, File::Mode::read, path);
  std::vector<double> flat;
  for (const Vec3& x : points) flat.insert(flat.end(), x.begin(), x.end());
  EXPECT_EQ(file.read_numbers("/points/x"), flat);
  EXPECT_EQ(file.shape("/points/x"), (hdf5::Shape{70001, 3}));
  EXPECT_EQ(file.read_numbers("/ids/x"), std::vector<double>(ids.begin(), ids.end()));
  EXPECT_EQ(file.read_numbers("/bytes/x"), std::vector<double>(bytes.begin(), bytes.end()));
  EXPECT_GE(bytes_of(file, "/points"), static_cast<std::int64_t>(flat.size() * sizeof(double)));
  EXPECT_LT(bytes_of(file, "/ids"), static_cast<std::int64_t>(ids.size() * sizeof(Index)) / 10);
}

}  // namespace
}  // namespace rockfold::test
