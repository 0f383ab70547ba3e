#include "host/files/load_files.hpp"

namespace rockfold {

void load_files(Model&) {}

}  // namespace rockfold
