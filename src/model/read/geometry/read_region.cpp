#include "src/model/read/geometry/read_region.hpp"

#include "src/model/read/read_value.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

using Ways = std::vector<std::string>;

const Ways& ways_of(Regions regions) {
  static const Ways any{"face", "box", "point", "plane", "block_at"};
  static const Ways surface{"face", "plane", "box"};
  return regions == Regions::any ? any : surface;
}

std::string way_list(const Ways& ways) {
  std::string text;
  for (const auto& way : ways)
    text += (text.empty() ? "" : way == ways.back() ? " or " : ", ") + way;
  return text;
}

/// "solid.face"; the solid's own name may hold points.
std::optional<Region> read_face(TableReader& in, const Draft& draft) {
  std::string text;
  if (!in.read("face", text)) return {};
  const auto point = text.rfind('.');
  if (point == std::string::npos) {
    in.wrong("face", "found \"" + text + "\", must be \"solid.face\", e.g. \"rock.zmin\"");
    return {};
  }
  const std::string owner = text.substr(0, point), face_name = text.substr(point + 1);
  const Index solid = draft.solids.find(owner);
  const Index excavation = solid == none ? draft.excavations.find(owner) : none;
  if (solid == none && excavation == none) {
    auto names = draft.solids.all();
    names.insert(names.end(), draft.excavations.all().begin(), draft.excavations.all().end());
    if (draft.solids.complete() && draft.excavations.complete() && !in.out().explained("solid") &&
        !in.out().explained("excavation"))
      in.wrong("face", "unknown solid \"" + owner + "\"" +
                           suggestion(owner, names, "the solids and excavations are"));
    return {};
  }
  const bool has_shape =
      solid != none ? draft.has_shape[solid] : draft.excavation_has_shape[excavation];
  if (!has_shape) return {};  // reported there
  const Shape& shape =
      solid != none ? draft.model.solids[solid].shape : draft.model.excavations[excavation].shape;
  const auto faces = faces_named(shape, face_name);
  if (!faces.empty()) return FaceRegion{solid != none ? solid : excavation, faces, solid == none};
  in.wrong("face", "unknown face \"" + face_name + "\" of " +
                       (solid != none ? "solid" : "excavation") + " \"" + owner + "\"" +
                       suggestion(face_name, names_and_groups(shape), "its faces are"));
  return {};
}

std::optional<Region> read_box(TableReader& in) {
  const auto corners = two_points_from(*in.find("box"), in.path_of("box"), "corners", in.out());
  if (!corners) return {};
  const auto& [min, max] = *corners;
  for (int d = 0; d < 3; ++d)
    if (min[d] > max[d]) {
      in.wrong("box", std::string("the first corner must be the lower one, but its ") + "xyz"[d] +
                          " = " + number_text(min[d]) + " is over the second's " +
                          number_text(max[d]));
      return {};
    }
  return BoxRegion{min, max};
}

std::optional<Region> read_plane_region(TableReader& in, const Draft& draft) {
  TableReader plane(*in.find("plane"), in.path_of("plane"), in.out());
  PlaneRegion region;
  region.tolerance = 1e-9 * given_size(draft.model);
  const bool point = plane.read("point", region.point, coordinate());
  const bool normal = plane.read_direction("normal", region.normal);
  plane.read("tolerance", region.tolerance, not_negative("m"), Need::optional);
  if (!point || !normal) return {};
  region.normal = unit_normal(region.normal);
  return region;
}

std::optional<Region> read_way(TableReader& in, const std::string& way, const Draft& draft) {
  if (way == "face") return read_face(in, draft);
  if (way == "box") return read_box(in);
  if (way == "plane") return read_plane_region(in, draft);
  Vec3 point{};
  if (!in.read(way, point, coordinate())) return {};
  if (way == "block_at") return BlockRegion{point};
  return PointRegion{point};
}

}  // namespace

std::optional<Region> read_region(TableReader& entry, const Draft& draft, Regions regions) {
  const Ways& ways = ways_of(regions);
  const std::string list = way_list(ways);
  const auto* value = entry.find("where", "must say one of " + list);
  if (!value) return {};
  if (const auto* text = std::get_if<std::string>(&value->data)) {  // a face without its table
    entry.wrong("where", "found " + described(*value) + ", must be a table: where = {face = \"" +
                             (text->find('.') == std::string::npos ? "rock.zmin" : *text) + "\"}");
    return {};
  }
  TableReader in(*value, entry.path_of("where"), entry.out());
  std::vector<std::string> given;
  for (const auto& way : ways)
    if (in.has(way)) given.push_back(way);
  for (const auto& way : ways_of(Regions::any))
    if (given.empty() && in.has(way)) {
      in.wrong(way, std::string("a ")
                        .append(way)
                        .append(" has no free faces, must have one of ")
                        .append(list));
      return {};
    }
  if (given.empty()) {
    auto keys = ways;
    keys.insert(keys.begin(), "");
    in.missing(std::move(keys), "says no region, must have one of " + list);
  }
  if (given.size() > 1)
    in.out().add(value->spot, entry.path_of("where"),
                 "has both " + given[0] + " and " + given[1] + ", must have one of " + list);
  return given.size() == 1 ? read_way(in, given[0], draft) : std::nullopt;
}

}  // namespace rockfold
