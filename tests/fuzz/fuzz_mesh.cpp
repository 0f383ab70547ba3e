// libFuzzer on the readers of mesh files: the first byte picks the format (bits 0 and 1) and the use (bit 2), the rest
// is the file. tests/files/corpus_test.cpp runs the same function over the corpus in the normal build.
#include <cstddef>
#include <cstdint>

#include "host/files/meshes/read_mesh.hpp"
#include "tests/files/fuzzed_readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rockfold::read_fuzzed_mesh({reinterpret_cast<const char*>(data), size});
  return 0;
}
