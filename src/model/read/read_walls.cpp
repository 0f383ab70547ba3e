#include "src/model/read/read_walls.hpp"

#include "src/model/read/read_value.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

struct Owner {
  bool excavation = false;
  Index id = none;
  const Shape* shape = nullptr;
};

std::optional<Owner> owner_named(const std::string& name, const Draft& draft) {
  if (const Index id = draft.excavations.find(name); id != none)
    return Owner{true, id, &draft.model.excavations[id].shape};
  if (const Index id = draft.solids.find(name); id != none)
    return Owner{false, id, &draft.model.solids[id].shape};
  return {};
}

std::vector<Index> all_faces(const Shape& shape) {
  for (const char* most : {"side", "top"})
    if (auto faces = faces_named(shape, most); !faces.empty()) return faces;
  std::vector<Index> faces(face_names(shape).size());
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = static_cast<Index>(i);
  return faces;
}

/// Why a name means no wall, for the end of a message.
std::string unknown_wall(const std::string& name, const Draft& draft) {
  std::vector<std::string> known = draft.excavations.all();
  known.insert(known.end(), draft.solids.all().begin(), draft.solids.all().end());
  return "found \"" + name +
         "\", must be an excavation, a solid or a face of one (\"tunnel\", \"rock.xmin\")" +
         suggestion(name, known, "the model has");
}

std::optional<WallFaces> wall_from(const Value& value, const std::string& path, const Draft& draft,
                                   Diagnostics& out) {
  const auto name = text_from(value, path, out);
  if (!name) return {};
  if (const auto owner = owner_named(*name, draft))
    return WallFaces{*name, owner->excavation, owner->id, all_faces(*owner->shape)};
  const auto point = name->rfind('.');
  const auto owner =
      point == std::string::npos ? std::nullopt : owner_named(name->substr(0, point), draft);
  if (!owner) {
    if (draft.solids.complete() && draft.excavations.complete())
      out.add(value.spot, path, unknown_wall(*name, draft));
    return {};
  }
  const std::string face = name->substr(point + 1);
  auto faces = faces_named(*owner->shape, face);
  if (!faces.empty()) return WallFaces{*name, owner->excavation, owner->id, std::move(faces)};
  if (out.empty())  // else its shape may be what is wrong
    out.add(value.spot, path,
            "unknown face \"" + face + "\" of \"" + name->substr(0, point) + "\"" +
                suggestion(face, names_and_groups(*owner->shape), "its faces are"));
  return {};
}

}  // namespace

std::optional<WallFaces> read_wall(TableReader& in, const std::string& key, const Draft& draft,
                                   Need need) {
  const Value* value = in.find(
      key, need == Need::required ? "must name an excavation, a solid or a face of one" : "");
  if (!value) return {};
  return wall_from(*value, in.path_of(key), draft, in.out());
}

std::vector<WallFaces> read_walls(TableReader& in, const std::string& key, const Draft& draft) {
  std::vector<WallFaces> walls;
  const Value* value = in.find(key);
  if (!value) return walls;
  const auto* list = std::get_if<Array>(&value->data);
  if (!list) {
    if (auto wall = wall_from(*value, in.path_of(key), draft, in.out())) walls.push_back(*wall);
    return walls;
  }
  if (list->empty()) in.wrong(key, "is empty, must name at least one wall");
  for (std::size_t i = 0; i < list->size(); ++i)
    if (auto wall = wall_from((*list)[i], item_path(in.path_of(key), i), draft, in.out()))
      walls.push_back(std::move(*wall));
  return walls;
}

}  // namespace rockfold
