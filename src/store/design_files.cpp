#include "src/store/design_files.hpp"

#include <filesystem>

#include "src/io/exports/text_file.hpp"
#include "src/report/drawings/bolt_layout.hpp"
#include "src/report/drawings/stereonet.hpp"
#include "src/report/history_tables.hpp"
#include "src/report/tables.hpp"
#include "src/store/histories.hpp"

namespace rockfold {

namespace {

void write_text(const std::string& path, const std::string& text) {
  TextFile file(path);
  file.print("{}", text);
  file.finish();
}

}  // namespace

std::vector<DesignFile> design_files(const Model& model, const std::string& result, Made made) {
  const auto folder = std::filesystem::path(result).parent_path();
  std::vector<DesignFile> files;
  if (made.support)
    for (const Drawing& drawing : model.drawings)
      files.push_back({&drawing, nullptr, (folder / drawing.file).string(), drawing.place_of_file});
  for (const TableFile& table : model.tables)
    if (table.is_history() ? made.run : made.support)
      files.push_back({nullptr, &table, (folder / table.file).string(), table.place_of_file});
  return files;
}

void write_design_files(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                        const SupportDesign& design, const Model& model,
                        const std::string& result) {
  for (const DesignFile& file : design_files(model, result, {.support = true}))
    if (file.table)
      write_text(file.path, csv_table(file.table->kind, blocks, keyblocks, design, model));
    else
      write_text(file.path, file.drawing->kind == Drawing::Kind::stereonet
                                ? stereonet(blocks, model, *file.drawing)
                                : bolt_layout(blocks, keyblocks, design, model, *file.drawing));
}

void write_history_files(const RunResult& run, const Model& model, const std::string& result) {
  for (const DesignFile& file : design_files(model, result, {.run = true}))
    write_text(file.path, file.table->kind == TableFile::Kind::monitors
                              ? monitors_table(monitor_histories(model, run))
                              : energy_table(energy_history(run), contact_history(run)));
}

}  // namespace rockfold
