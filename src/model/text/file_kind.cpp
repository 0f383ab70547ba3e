#include "src/model/text/file_kind.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// The entry of a folder with this ending that was probably meant; "" if none is near.
std::string nearest_entry(const fs::path& folder, const std::string& name,
                          std::string_view ending) {
  constexpr std::size_t most = 10'000;  // of a folder's entries; bounds the time
  std::vector<std::string> names;
  std::error_code failure;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, failure), end;
       !failure && at != end && names.size() < most; at.increment(failure))
    if (std::string entry = at->path().filename().string(); entry.ends_with(ending))
      names.push_back(std::move(entry));
  std::sort(names.begin(), names.end());
  return nearest_word(name, names);
}

}  // namespace

std::string known_kind(std::string_view bytes) {
  using namespace std::string_view_literals;
  struct Signature {
    std::string_view begin, kind;
  };
  static constexpr Signature signatures[] = {
      {"\x89HDF\r\n\x1a\n"sv, "an HDF5 file: of a result `rockfold info` tells what it holds"},
      {"\xFF\xFE"sv, "text in UTF-16: save it as UTF-8"},
      {"\xFE\xFF"sv, "text in UTF-16: save it as UTF-8"},
      {"PK\x03\x04"sv, "a ZIP archive, as office programs write"},
      {"\x1F\x8B"sv, "compressed by gzip: unpack it first"},
      {"%PDF"sv, "a PDF document"},
      {"\x89PNG"sv, "a picture"},
      {"\xD0\xCF\x11\xE0"sv, "a document of an office program"},
  };
  for (const auto& [begin, kind] : signatures)
    if (bytes.starts_with(begin)) return std::string(kind);
  return "";
}

std::string kind_of_binary(std::string_view bytes) {
  if (auto kind = known_kind(bytes); !kind.empty()) return kind;
  constexpr std::size_t looked_at = 4096;
  const auto front = bytes.substr(0, looked_at);
  if (front.find('\0') == std::string_view::npos) return "";
  // Of western text in UTF-16 every other byte is zero.
  const bool wide = front.size() >= 4 && (front[0] == 0) != (front[1] == 0) &&
                    (front[0] == 0) == (front[2] == 0) && (front[1] == 0) == (front[3] == 0);
  return wide ? "text in UTF-16: save it as UTF-8" : "binary";
}

std::string file_hint(const std::string& path, std::string_view ending) {
  if (std::any_of(path.begin(), path.end(), [](unsigned char c) { return c < 0x20; }))
    return backslash_hint;
  std::string meant = path;
  std::replace(meant.begin(), meant.end(), '\\', '/');
  fs::path found;
  const fs::path all(meant);
  for (auto at = all.begin(); at != all.end(); ++at) {
    const fs::path& part = *at;
    if (!is_there(found / part)) {
      const bool is_file = std::next(at) == all.end();
      const std::string entry = nearest_entry(found, part.string(), is_file ? ending : "");
      if (entry.empty()) return "";
      found /= entry;
    } else {
      found /= part;
    }
  }
  return ", did you mean \"" + found.string() + "\"?";
}

}  // namespace rockfold
