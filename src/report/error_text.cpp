#include "src/report/error_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/report/documents/documents.hpp"

namespace rockfold {

std::string diagnostic_line(const Diagnostic& diagnostic) {
  const auto& place = diagnostic.place;
  std::string line = place.file.empty() ? "rockfold" : place.file;
  if (place.line > 0) line += fmt::format(":{}", place.line);
  if (place.column > 0) line += fmt::format(":{}", place.column);
  if (!place.key.empty()) line += ": " + place.key;
  return line + ": " + diagnostic.message;
}

std::vector<std::string> error_lines(const Error& error) {
  std::vector<std::string> lines;
  for (const auto& diagnostic : error.diagnostics()) lines.push_back(diagnostic_line(diagnostic));
  if (lines.size() > 1) lines.push_back(fmt::format("{} errors", lines.size()));
  return lines;
}

void print_error_document(std::FILE* stream, const Error& error) {
  write_document(stream, error_document(error));
}

std::string error_document_text(const Error& error) {
  return error_document(error).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rockfold
