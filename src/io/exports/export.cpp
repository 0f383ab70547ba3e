#include "src/io/exports/export.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/io/exports/writers.hpp"

namespace rockfold {

namespace {

using Writer = void (*)(const ExportData&, TextFile&);

struct Format {
  const char* suffix;
  ExportFormat format;
  Writer write;
};

constexpr std::array<Format, 5> formats{{{".vtp", ExportFormat::vtp, write_vtp},
                                         {".obj", ExportFormat::obj, write_obj},
                                         {".stl", ExportFormat::stl, write_stl},
                                         {".3ddat", ExportFormat::three_dec, write_3ddat},
                                         {".json", ExportFormat::json, write_json}}};

const Format& format_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : static_cast<char>(c);
  });
  for (const Format& format : formats)
    if (suffix == format.suffix) return format;
  throw Error(ErrorKind::usage,
              fmt::format("--export: '{}' tells no format by its end; .vtp, .obj, .stl, .3ddat and "
                          ".json are known",
                          path));
}

}  // namespace

ExportFormat export_format(const std::string& path) {
  return format_of(path).format;
}

void export_blocks(const ExportData& data, const std::string& path) {
  const Format& format = format_of(path);
  TextFile file(path);
  format.write(data, file);
  file.finish();
}

std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) line += c >= ' ' && c <= '~' ? c : '?';
  return line;
}

}  // namespace rockfold
