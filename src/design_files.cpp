#include "src/design_files.hpp"

#include <filesystem>

#include "src/io/exports/text_file.hpp"
#include "src/report/drawings/bolt_layout.hpp"
#include "src/report/drawings/stereonet.hpp"
#include "src/report/tables.hpp"

namespace rockfold {

namespace {

void write_text(const std::string& path, const std::string& text) {
  TextFile file(path);
  file.print("{}", text);
  file.finish();
}

}  // namespace

std::vector<std::string> design_paths(const Model& model, const std::string& result) {
  const auto folder = std::filesystem::path(result).parent_path();
  std::vector<std::string> paths;
  for (const Drawing& drawing : model.drawings) paths.push_back((folder / drawing.file).string());
  for (const TableFile& table : model.tables) paths.push_back((folder / table.file).string());
  return paths;
}

std::vector<Place> design_places(const Model& model) {
  std::vector<Place> places;
  for (const Drawing& drawing : model.drawings) places.push_back(drawing.place_of_file);
  for (const TableFile& table : model.tables) places.push_back(table.place_of_file);
  return places;
}

void write_design_files(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                        const SupportDesign& design, const Model& model,
                        const std::string& result) {
  const auto paths = design_paths(model, result);
  std::size_t next = 0;
  for (const Drawing& drawing : model.drawings)
    write_text(paths[next++], drawing.kind == Drawing::Kind::stereonet
                                  ? stereonet(blocks, model, drawing)
                                  : bolt_layout(blocks, keyblocks, design, model, drawing));
  for (const TableFile& table : model.tables)
    write_text(paths[next++], csv_table(table.kind, blocks, keyblocks, design, model));
}

}  // namespace rockfold
