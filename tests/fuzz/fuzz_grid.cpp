// libFuzzer on the readers of terrains and tables: the first byte picks one (bits 0 and 1: grid, XYZ, either, table),
// the rest is the file. tests/files/corpus_test.cpp runs the same function over the corpus in the normal build.
#include <cstddef>
#include <cstdint>

#include "host/files/terrain/read_terrain.hpp"
#include "tests/files/fuzzed_readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rockfold::read_fuzzed_grid({reinterpret_cast<const char*>(data), size});
  return 0;
}
