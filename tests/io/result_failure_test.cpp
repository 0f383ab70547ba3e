// What happens when files cannot be written or read.
#include <csignal>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/flatten/face_polygons.hpp"
#include "src/io/exports/export.hpp"
#include "src/io/hdf5/hdf5_file.hpp"
#include "src/io/result_file.hpp"
#include "tests/io/sample.hpp"

namespace rockfold::test {
namespace {

using Names = std::vector<std::string>;

/// Calls `action`; its Error must be of kind io and name `file`. Returns its message.
template <typename Action>
std::string io_error(Action action, const std::string& file) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_EQ(error.diagnostics().front().place.file, file);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

/// Limits the size of files that this process may write, as a full disk would, while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::int64_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{static_cast<rlim_t>(bytes), before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(ResultWriter, TakesTheNameOnlyWhenFinished) {
  const TemporaryFolder folder;
  write_file(folder / "a.vtkhdf", "older");
  const BlockArrays blocks = box_grid(2, 1, 1);
  {
    ResultWriter writer(folder / "a.vtkhdf", sample_model(), sample_header());
    write_sample(writer, blocks, lattice_with_cut(1), {0, 1});
    EXPECT_EQ(file_bytes(folder / "a.vtkhdf"), "older");
    EXPECT_EQ(read_result_info(writer.partial_path()).time.size(),
              2u);  // closed between states: readable
    writer.finish();
    EXPECT_EQ(folder.names(), (Names{"a.vtkhdf", "a.xdmf"}));
  }
  EXPECT_EQ(read_result_info(folder / "a.vtkhdf").time.size(), 2u);
}

TEST(ResultWriter, RemovesWhatWasNotFinished) {
  const TemporaryFolder folder;
  {
    ResultWriter(folder / "a.vtkhdf", sample_model(), sample_header())
        .write_blocks(box_grid(2, 1, 1), face_polygons(box_grid(2, 1, 1)));
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(ResultWriter, NamesTheFolderThatIsNotThere) {
  const TemporaryFolder folder;
  const std::string path = folder / "no/a.vtkhdf";
  EXPECT_EQ(io_error([&] { ResultWriter(path, sample_model(), sample_header()); }, path),
            "cannot create: No such file or directory");
  std::filesystem::create_directory(folder / "no");
  EXPECT_EQ(io_error([&] { ResultWriter(folder / "no", sample_model(), sample_header()); },
                     folder / "no"),
            "cannot write: it is a folder");
}

TEST(ResultWriter, LeavesNothingWhenTheDiskIsFullFromTheStart) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.vtkhdf";
  write_file(path, "older");
  {
    const FileSizeLimit limit(3000);
    EXPECT_EQ(io_error([&] { ResultWriter(path, sample_model(), sample_header()); }, path),
              "cannot write: File too large");
  }
  EXPECT_EQ(folder.names(), Names{"a.vtkhdf"});
  EXPECT_EQ(file_bytes(path), "older");
}

TEST(ResultWriter, KeepsTheStatesBeforeTheDiskWasFull) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.vtkhdf";
  const BlockArrays blocks = box_grid(2, 1, 1);
  const CoverArrays covers = lattice_with_cut(4);
  const std::vector<Vec3> motion(blocks.vertex.size());
  ResultWriter writer(path, sample_model(), sample_header());
  writer.write_blocks(blocks, face_polygons(blocks));
  const ElementMesh mesh = make_element_mesh(covers);
  writer.write_elements(covers, mesh);
  writer.add_state({0, linear_state(covers, 0), motion, motion, {}});
  {
    const FileSizeLimit limit(
        static_cast<std::int64_t>(std::filesystem::file_size(writer.partial_path())) + 1'100'000);
    Index written = 1;
    const auto fill = [&] {
      for (;; ++written)
        writer.add_state({written, linear_state(covers, written), motion, motion, {}});
    };
    EXPECT_EQ(io_error(fill, path), "cannot write: File too large");
    EXPECT_EQ(writer.state_count(), written);
    EXPECT_GT(written, 2);
  }
  const Index whole = writer.state_count();
  writer.finish();
  EXPECT_EQ(static_cast<Index>(read_result_info(path).time.size()), whole);
  const hdf5::File file(path, hdf5::File::Mode::read, path);
  EXPECT_EQ(file.shape("/VTKHDF/Elements/PointData/displacement")[0] % whole, 0);
}

/// A file system of 3 MiB in a folder, where the tests may mount one.
class SmallDisk {
 public:
  explicit SmallDisk(const TemporaryFolder& folder) : path_(folder.path.string()) {
    mounted_ =
        std::system(("mount -t tmpfs -o size=3m tmpfs " + path_ + " 2>/dev/null").c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_ && std::system(("umount " + path_).c_str()) != 0)
      ADD_FAILURE() << path_ << " stays mounted";
  }
  bool mounted() const { return mounted_; }

 private:
  std::string path_;
  bool mounted_ = false;
};

TEST(ResultWriter, KeepsTheStatesBeforeASmallDiskWasFull) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder);
  if (!disk.mounted()) GTEST_SKIP() << "no file system can be mounted here";
  const std::string path = folder / "a.vtkhdf", second = folder / "b.vtkhdf";
  const BlockArrays blocks = box_grid(2, 1, 1);
  const CoverArrays covers = lattice_with_cut(6);
  const std::vector<Vec3> motion(blocks.vertex.size());
  ResultWriter writer(path, sample_model(), sample_header());
  writer.write_blocks(blocks, face_polygons(blocks));
  const ElementMesh mesh = make_element_mesh(covers);
  writer.write_elements(covers, mesh);
  const auto fill = [&] {
    for (Index s = 0;; ++s) writer.add_state({s, linear_state(covers, s), motion, motion, {}});
  };
  EXPECT_EQ(io_error(fill, path), "cannot write: No space left on device");
  const auto whole = static_cast<std::size_t>(writer.state_count());
  writer.finish();
  EXPECT_EQ(read_result_info(path).time.size(), whole);
  const auto many_blocks = [&] {
    const BlockArrays many = box_grid(50, 50, 10);
    ResultWriter(second, sample_model(), sample_header()).write_blocks(many, face_polygons(many));
  };
  EXPECT_EQ(io_error(many_blocks, second), "cannot write: No space left on device");
  EXPECT_EQ(folder.names(), (Names{"a.vtkhdf", "a.xdmf"}));
}

/// A process killed between two states leaves a partial file that can be read, under its partial
/// name.
TEST(ResultWriter, KilledLeavesNoFileOfTheFinalName) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    ResultWriter writer(folder / "a.vtkhdf", sample_model(), sample_header());
    write_sample(writer, box_grid(2, 1, 1), lattice_with_cut(1), {0, 1, 2});
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  const std::string partial = "a.vtkhdf.partial-" + std::to_string(child);
  ASSERT_EQ(folder.names(), Names{partial});
  EXPECT_EQ(read_result_info(folder / partial).time.size(), 3u);
}

TEST(ResultInfo, SaysWhyAFileIsNotRead) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name) {
    return io_error([&] { read_result_info(folder / name); }, folder / name);
  };
  EXPECT_EQ(message("none.vtkhdf"), "no such file");
  write_file(folder / "text", "[[material]]\n");
  EXPECT_EQ(message("text"), "is no HDF5 file");
  write_file(folder / "empty", "");
  EXPECT_EQ(message("empty"), "is no HDF5 file");
  std::filesystem::create_directory(folder / "folder");
  EXPECT_EQ(message("folder"), "is no file");
  {
    hdf5::File other(folder / "other", hdf5::File::Mode::create, "other");
    other.write_text("/model", "of another program");
  }
  EXPECT_EQ(message("other"), "is an HDF5 file, but no result of Rockfold");
  {
    hdf5::File later(folder / "later", hdf5::File::Mode::create, "later");
    later.set_integers("/rockfold", "format_version", {99});
  }
  EXPECT_EQ(message("later"), "has result format 99; this program reads formats up to 1");
}

/// At every length near the ends and at several hundred between: an error, never a crash.
TEST(ResultInfo, RefusesFilesCutShort) {
  const TemporaryFolder folder;
  {
    ResultWriter writer(folder / "a.vtkhdf", sample_model(), sample_header());
    write_sample(writer, box_grid(3, 2, 2), lattice_with_cut(2), {0, 1, 2});
    writer.finish();
  }
  const std::string whole = file_bytes(folder / "a.vtkhdf");
  const std::size_t stride = whole.size() / 300;
  for (std::size_t length = 0; length < whole.size();
       length += length < 100 || length + 100 > whole.size() ? 1 : stride) {
    write_file(folder / "short", whole.substr(0, length));
    const std::string message =
        io_error([&] { read_result_info(folder / "short"); }, folder / "short");
    EXPECT_TRUE(message.starts_with("is damaged") || message == "is no HDF5 file")
        << length << ": " << message;
  }
}

/// One wrong byte, all over the file and in each of the structures in which HDF5 keeps what a large group holds: what is
/// told is an error of kind io or, where it did not matter, the same as ever; never a crash.
TEST(ResultInfo, SurvivesEveryWrongByte) {
  const TemporaryFolder folder;
  {
    ResultWriter writer(folder / "a.vtkhdf", sample_model(), sample_header());
    write_sample(writer, box_grid(3, 2, 2), lattice_with_cut(2), {0, 1, 2});
    writer.finish();
  }
  const std::string whole = file_bytes(folder / "a.vtkhdf");
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < whole.size(); i += whole.size() / 100) places.push_back(i);
  for (const std::string structure : {"BTLF", "FHDB"})
    for (auto at = whole.find(structure); at != std::string::npos;
         at = whole.find(structure, at + 1))
      for (const std::size_t offset : {12, 50, 161, 300}) places.push_back(at + offset);
  int refused = 0;
  for (const std::size_t place : places) {
    if (place >= whole.size()) continue;
    std::string damaged = whole;
    damaged[place] = static_cast<char>(~damaged[place]);
    write_file(folder / "damaged", damaged);
    try {
      read_result_info(folder / "damaged");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(Exports, ThatDoNotFitOnTheDiskLeaveTheOlderFile) {
  const TemporaryFolder folder;
  const BlockArrays blocks = box_grid(20, 20, 10);
  for (const std::string name : {"a.vtp", "a.obj", "a.stl", "a.json"}) {
    write_file(folder / name, "older");
    {
      const FileSizeLimit limit(300'000);
      const std::string message = io_error(
          [&] {
            export_blocks({blocks, face_polygons(blocks), face_triangles(blocks), {}, ""},
                          folder / name);
          },
          folder / name);
      EXPECT_NE(message.find("cannot be written: "), std::string::npos);
    }
    EXPECT_EQ(file_bytes(folder / name), "older");
  }
  EXPECT_EQ(folder.names(), (Names{"a.json", "a.obj", "a.stl", "a.vtp"}));
}

}  // namespace
}  // namespace rockfold::test
