#include "src/page/page_content.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/io/hdf5/deflate.hpp"
#include "src/io/result_reader.hpp"
#include "src/page/page_contacts.hpp"
#include "src/page/page_states.hpp"

namespace rockfold {

namespace {

using hdf5::File;
using Json = nlohmann::ordered_json;

/// Browsers hold texts up to 512 MiB; beyond some 600 MB of numbers they run out of memory before.
constexpr std::size_t most_bytes = 600'000'000;
constexpr std::size_t bytes_of_contact = 25;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::io, what, Place{path, 0, 0, {}});
}

/// An array of the file that has a value (or a row of `width`) for each block, for the shown ones.
template <typename T>
void add_of_blocks(const File& file, const PageSurface& surface, const std::string& group,
                   const std::string& name, PageArrays& arrays, std::size_t width = 1) {
  if (!file.exists(group + name)) return;
  const std::vector<double> all = file.read_numbers(group + name);
  std::vector<T> values;
  for (const Index b : surface.block)
    for (std::size_t k = 0; k < width; ++k)
      values.push_back(static_cast<T>(all.at(width * static_cast<std::size_t>(b) + k)));
  arrays.add(name, values);
}

void add_block_values(const File& file, const PageSurface& surface, PageArrays& arrays) {
  const std::string blocks = "/rockfold/blocks/", theory = "/rockfold/block_theory/";
  add_of_blocks<double>(file, surface, blocks, "volume", arrays);
  add_of_blocks<double>(file, surface, blocks, "centroid", arrays, 3);
  for (const char* name : {"convex", "finite", "flags"})
    add_of_blocks<std::uint8_t>(file, surface, blocks, name, arrays);
  for (const char* name : {"material", "stage"})
    add_of_blocks<std::uint32_t>(file, surface, blocks, name, arrays);
  for (const char* name : {"class", "mode"})
    add_of_blocks<std::uint8_t>(file, surface, theory, name, arrays);
  add_of_blocks<std::uint32_t>(file, surface, theory, "batch", arrays);
  for (const char* name : {"factor_of_safety", "sliding_force", "support_force",
                           "supported_factor_of_safety", "utilisation"})
    add_of_blocks<float>(file, surface, theory, name, arrays);
  add_of_blocks<float>(file, surface, theory, "direction", arrays, 3);
}

std::vector<std::uint32_t> counts(const std::vector<Index>& begin) {
  std::vector<std::uint32_t> count;
  for (std::size_t i = 0; i + 1 < begin.size(); ++i)
    count.push_back(static_cast<std::uint32_t>(begin[i + 1] - begin[i]));
  return count;
}

/// Coordinates are stored relative to the middle of the model, so that single precision is enough.
void add_surface(const PageSurface& surface, const Vec3& origin, PageArrays& arrays) {
  std::vector<float> xyz;
  for (const Vec3& point : surface.point)
    for (int d = 0; d < 3; ++d) xyz.push_back(static_cast<float>(point[d] - origin[d]));
  std::vector<std::uint32_t> id;
  for (const Index b : surface.block) id.push_back(static_cast<std::uint32_t>(b + 1));
  arrays.add("block_id", id);
  arrays.add("point_count", counts(surface.point_begin));
  arrays.add("point_xyz", xyz);
  arrays.add("polygon_count", counts(surface.polygon_begin));
  arrays.add("polygon_origin", surface.origin);
  arrays.add("corner_count", surface.corner_count);
  arrays.add_smooth("corner_point", surface.corner_point);
  arrays.add("corner_edge", surface.corner_edge);
}

/// Joints that end inside blocks: they belong to no block's surface.
void add_dead_ends(const File& file, const Vec3& origin, PageArrays& arrays) {
  const std::string blocks = "/rockfold/blocks/dead_end_";
  if (!file.exists(blocks + "block")) return;
  const auto indices = [&](const char* name) {
    const std::vector<double> numbers = file.read_numbers(blocks + name);
    return std::vector<std::uint32_t>(numbers.begin(), numbers.end());
  };
  std::vector<std::uint32_t> id = indices("block");
  for (auto& b : id) ++b;
  std::vector<float> xyz;
  for (const double x : file.read_numbers(blocks + "vertex"))
    xyz.push_back(static_cast<float>(x - origin[xyz.size() % 3]));
  arrays.add("dead_end_block", id);
  arrays.add("dead_end_origin", indices("origin"));
  arrays.add("dead_end_begin", indices("corner_begin"));
  arrays.add("dead_end_xyz", xyz);
}

/// What block theory can be done again from, as it stands in the file.
void add_first_looks(const File& file, PageArrays& arrays) {
  const std::string group = "/rockfold/first_looks/";
  if (!file.exists(group + "block")) return;
  const auto add_indices = [&](const char* name) {
    const std::vector<double> numbers = file.read_numbers(group + name);
    arrays.add(std::string("look_") + name,
               std::vector<std::uint32_t>(numbers.begin(), numbers.end()));
  };
  for (const char* name :
       {"block", "stage", "neighbour_begin", "neighbour", "face_begin", "origin", "loop_begin",
        "corner_begin", "patch_begin", "patch_face", "patch_corner_begin", "looked_at_stage",
        "groups_may_move", "held_block", "held_stage", "held_neighbour_begin", "held_neighbour"})
    add_indices(name);
  for (const char* name :
       {"volume", "mass", "free_area", "centroid", "load", "moment", "free_centre", "inertia",
        "normal", "contact_area", "share", "corner", "patch_normal", "patch_corner"})
    arrays.add(std::string("look_") + name, file.read_numbers(group + name));
  // Older programs knew no water that drains: their pages do without.
  if (file.exists(group + "outline")) {
    for (const char* name : {"outline", "outline_begin"}) add_indices(name);
    for (const char* name : {"outline_normal", "outline_corner", "outline_drains",
                             "outline_edge_drains", "outline_pond"})
      arrays.add(std::string("look_") + name, file.read_numbers(group + name));
  }
  // Of older programs, that had no joint meshes of several planes, faces are planes.
  const bool has_planes = file.exists(group + "plane_normal");
  arrays.add("look_plane_normal",
             file.read_numbers(group + (has_planes ? "plane_normal" : "normal")));
}

Vec3 middle_of(const std::vector<Vec3>& points) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points)
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

Json origins_json(const File& file) {
  const auto names = file.read_names("/rockfold/origins/name");
  const auto kind = file.read_numbers("/rockfold/origins/kind");
  const auto goes_on = file.read_numbers("/rockfold/origins/continues");
  const auto material = file.read_numbers("/rockfold/origins/joint_material");
  Json list = Json::array();
  for (std::size_t i = 0; i < names.size(); ++i)
    list.push_back({{"name", names[i]},
                    {"kind", kind.at(i)},
                    {"continues", goes_on.at(i) != 0},
                    {"material", material.at(i)}});
  return list;
}

/// The document that the command stored, or null: older results and interrupted runs have none.
Json answer_json(const File& file) {
  if (!file.exists("/rockfold/answer")) return nullptr;
  const std::vector<double> bytes = file.read_numbers("/rockfold/answer");
  return Json::parse(std::string(bytes.begin(), bytes.end()));
}

/// `<` would end the script that holds the text.
std::string escaped(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  for (const char c : text)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

PageContent read_damaged_or_not(const std::string& path, const PageChoice& choice) {
  const auto file = open_result(path);
  PageSurface surface = block_surface(*file, choice.surface_only);
  if (surface.block.empty()) fail(path, "holds no block to show");
  if (has_element_surface(*file)) surface = element_surface(*file, surface);
  const std::vector<Index> states = shown_states(*file, choice.every);
  const auto contacts = static_cast<std::size_t>(contact_points(*file, states));
  if (surface.point.size() * (30 + states.size() * 20) + contacts * bytes_of_contact > most_bytes)
    fail(path, fmt::format("is too large for a page ({} states of {} points): --every N takes each "
                           "N-th state, --surface-only leaves out blocks inside the rock",
                           states.size(), surface.point.size()));
  PageContent content;
  const Vec3 origin = middle_of(surface.point);
  add_surface(surface, origin, content.arrays);
  add_block_values(*file, surface, content.arrays);
  add_dead_ends(*file, origin, content.arrays);
  add_first_looks(*file, content.arrays);
  add_states(*file, surface, states, origin, content.arrays);
  add_contacts(*file, states, origin, content.arrays);
  auto& facts = content.facts;
  facts.blocks = static_cast<Index>(file->number_attribute("/rockfold/totals", "blocks"));
  facts.shown_blocks = static_cast<Index>(surface.block.size());
  facts.states = static_cast<Index>(states.size());
  for (const auto corners : surface.corner_count)
    facts.triangles += static_cast<Index>(corners) - 2;
  auto& document = content.document;
  document = {{"format", 1}, {"file", std::filesystem::path(path).filename().string()}};
  for (const char* name : {"title", "command", "version", "commit", "units"})
    document[name] = file->text_attribute("/rockfold", name);
  document["origin"] = origin;
  document["blocks"] = facts.blocks;
  document["materials"] = file->read_names("/rockfold/materials/name");
  document["origins"] = origins_json(*file);
  document["answer"] = answer_json(*file);
  document["model"] = file->read_text("/rockfold/model");
  auto& list = document["arrays"] = Json::array();
  for (const PageArray& array : content.arrays.list())
    list.push_back({{"name", array.name},
                    {"type", array.type},
                    {"count", array.count},
                    {"differences", array.differences}});
  return content;
}

}  // namespace

PageContent read_page_content(const std::string& path, const PageChoice& choice) {
  try {
    return read_damaged_or_not(path, choice);
  } catch (const nlohmann::json::exception& error) {
    fail(path, fmt::format("is damaged ({})", error.what()));
  } catch (const std::out_of_range&) {
    fail(path, "is damaged (arrays that do not fit together)");
  }
}

void put_page_content(std::ostream& out, const PageContent& content) {
  out << "<script type=\"application/json\" id=\"document\">" << escaped(content.document)
      << "</script>\n";
  for (const PageArray& array : content.arrays.list())
    out << "<script type=\"text/plain\" id=\"array-" << array.name << "\">"
        << base64(deflated(array.shuffled)) << "</script>\n";
}

}  // namespace rockfold
