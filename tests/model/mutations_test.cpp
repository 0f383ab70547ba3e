// No input crashes the reader, and no error is empty: thousands of small damages to a right model.
#include <random>

#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutated(std::string text) {
    for (int n = 1 + pick(4); n > 0; --n) mutate(text);
    return text;
  }

 private:
  int pick(std::size_t below) {
    return static_cast<int>(random_() % below);
  }  // modulo: the same on every machine

  void mutate(std::string& text) {
    const std::size_t at = pick(text.size() + 1);
    const std::size_t length = std::min<std::size_t>(pick(30), text.size() - at);
    switch (pick(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(pick(text.size() + 1), pick(80)));
        break;
      case 2:
        text.insert(at, 1, static_cast<char>(pick(256)));
        break;
      case 3:
        text.insert(at, token());
        break;
      default:
        replace_value(text, at);
        break;
    }
  }

  /// The damage that gets through the syntax: another value behind the next '='.
  void replace_value(std::string& text, std::size_t at) {
    const auto begin = text.find("= ", at);
    if (begin == std::string::npos) return;
    const auto end = text.find('\n', begin);
    text.replace(begin + 2, (end == std::string::npos ? text.size() : end) - begin - 2, token());
  }

  std::string token() {
    static const std::vector<std::string> tokens{"nan",
                                                 "-inf",
                                                 "1e308",
                                                 "-1e-308",
                                                 "0",
                                                 "-1",
                                                 "1e9",
                                                 "9223372036854775807",
                                                 "true",
                                                 "''",
                                                 "'rock'",
                                                 "'rock.'",
                                                 "'.'",
                                                 "'side'",
                                                 "[]",
                                                 "[[]]",
                                                 "{}",
                                                 "[0, 0, 0]",
                                                 "[1, 1, 1]",
                                                 "[nan, 0, 0]",
                                                 "[[0, 0], [0, 0], [0, 0]]",
                                                 "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]",
                                                 "{face = 'rock.9'}",
                                                 "{plane = {}}",
                                                 "{box = [[], []]}",
                                                 "'''\n'''",
                                                 "1979-05-27",
                                                 "[[solid]]\n",
                                                 "[cover]\n",
                                                 "[[fixed]]\n",
                                                 "a.b.c.d = 1\n",
                                                 "\"\\u0000\"",
                                                 "0x7FFFFFFFFFFFFFFF",
                                                 "[{}, {}, {}, {}]",
                                                 "'dynamic'",
                                                 "'static'",
                                                 "\xEF\xBB\xBF",
                                                 "\r",
                                                 "#",
                                                 "=",
                                                 "\"\"\""};
    return tokens[pick(tokens.size())];
  }

  std::mt19937 random_;
};

void read_and_check(const std::string& text, const std::vector<std::string>& overrides) {
  try {
    parse_model(text, "m.toml", overrides, Purpose::check);
  } catch (const Error& error) {
    ASSERT_FALSE(error.diagnostics().empty());
    for (const auto& diagnostic : error.diagnostics()) {
      ASSERT_FALSE(diagnostic.message.empty()) << text;
      ASSERT_FALSE(error.kind() == ErrorKind::model && diagnostic.place.file.empty()) << text;
    }
  }
}

TEST(MutatedModel, IsReadOrRefused) {
  Mutator mutator(20261121);
  for (int i = 0; i < 4000; ++i) read_and_check(mutator.mutated(complete_model), {});
}

TEST(MutatedOverride, IsReadOrRefused) {
  Mutator mutator(4);
  for (int i = 0; i < 2000; ++i) read_and_check(ROCK, {mutator.mutated("solid.rock.max[2] = 7")});
}

TEST(DeepModel, IsReadOrRefused) {
  const int depth = 100000;
  std::string keys = "a", arrays, tables;
  for (int i = 0; i < depth; ++i) keys += ".a", arrays += "[", tables += "{a=";
  for (const auto& text :
       {keys + " = 1", "[" + keys + "]", "[[" + keys + "]]", "a = " + arrays, "a = " + tables,
        "a = {" + keys + " = 1}", "a = '#'\n" + keys + " = 1", "'a'.\"b\"." + keys + " = 1"})
    read_and_check(text, {});
  read_and_check(ROCK, {keys + "=1"});
  read_and_check(ROCK, {"a=" + arrays});
}

}  // namespace
}  // namespace rockfold
