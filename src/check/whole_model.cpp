#include "src/check/whole_model.hpp"

#include "host/files/load_files.hpp"

namespace rockfold {

namespace {

Error both(const Error& model, const Error& files) {
  const bool only_io = model.kind() == ErrorKind::io && files.kind() == ErrorKind::io;
  std::vector<Diagnostic> all = model.diagnostics();
  all.insert(all.end(), files.diagnostics().begin(), files.diagnostics().end());
  return {only_io ? ErrorKind::io : ErrorKind::model, std::move(all)};
}

}  // namespace

Model read_whole_model(const std::string& path, const std::optional<std::string>& text,
                       const std::vector<std::string>& overrides, Purpose purpose) {
  ReadModel read = text ? try_parse_model(*text, path, overrides, purpose, file_bodies)
                        : try_read_model(path, overrides, purpose, file_bodies);
  try {
    load_files(read.model);
  } catch (const Error& files) {
    if (read.wrong) throw both(*read.wrong, files);
    throw;
  }
  if (read.wrong) throw *read.wrong;
  return std::move(read.model);
}

}  // namespace rockfold
