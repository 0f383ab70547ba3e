// Files that are no model.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

class ModelFile : public testing::Test {
 protected:
  ModelFile() {
    folder = std::filesystem::path(testing::TempDir()) /
             ("rockfold_model_" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
              "_" + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder);
  }
  ~ModelFile() override { std::filesystem::remove_all(folder); }

  std::string path_of(const std::string& text) const {
    auto path = (folder / "m.toml").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  static void expect_error(const std::string& path, ErrorKind kind, const std::string& part) {
    try {
      read_model(path);
      FAIL() << path << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_EQ(error.diagnostics()[0].place.file, path);
    }
  }

  std::filesystem::path folder;
};

TEST_F(ModelFile, IsReadWhole) {
  const auto path = path_of(complete_model);
  const auto model = read_model(path, {}, Purpose::check);
  EXPECT_EQ(model.text, complete_model);
  EXPECT_EQ(model.path, path);
}

TEST_F(ModelFile, ThatIsMissing) {
  expect_error((folder / "no.toml").string(), ErrorKind::io, "No such file");
}

TEST_F(ModelFile, ThatIsAFolder) {
  expect_error(folder.string(), ErrorKind::io, "is a directory");
}

TEST_F(ModelFile, ThatIsEmpty) {
  expect_error(path_of(""), ErrorKind::model, "no [[solid]]");
}

TEST_F(ModelFile, ThatIsBinary) {
  expect_error(path_of(std::string("\x7F"
                                   "ELF\0\1\2\xFF",
                                   8)),
               ErrorKind::model, "is binary; must be a model");
}

TEST_F(ModelFile, ThatIsHuge) {
  const auto path = path_of("");
  std::filesystem::resize_file(path, 100'000'000);  // sparse
  expect_error(path, ErrorKind::io, "is larger than 64 MiB");
}

TEST_F(ModelFile, OfUtf16) {
  expect_error(path_of(std::string("\xFF\xFEt\0i\0", 6)), ErrorKind::model,
               "is text in UTF-16: save it as UTF-8");
}

}  // namespace
}  // namespace rockfold
