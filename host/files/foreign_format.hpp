// Files of formats that are not read, known by how they begin.
#pragma once

#include <string>
#include <string_view>

namespace rockfold {

enum class FileUse { ground, mesh, table };

/// What the file is and what to convert it to ("is a LAS or LAZ point cloud: …"); "" of others, and of what is read.
std::string foreign_format(std::string_view bytes, FileUse use);

}  // namespace rockfold
