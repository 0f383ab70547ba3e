// One call of a reader on arbitrary bytes: it must either throw Error with messages or answer with sound data; all else
// ends the program.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "host/files/meshes/read_mesh.hpp"
#include "host/files/read_joint_table.hpp"
#include "host/files/terrain/read_terrain.hpp"

namespace rockfold {

enum class Fuzzed { refused, read };

inline void must(bool holds) {
  if (!holds) std::abort();
}

inline void must_be_sound(const TriangleSurface& surface) {
  must(!surface.triangles.empty());
  for (const auto& point : surface.vertices)
    for (const Real x : point) must(std::abs(x) <= 1e9);
  for (const auto& [a, b, c] : surface.triangles) {
    must(a != b && b != c && c != a);
    for (const Index v : {a, b, c})
      must(v >= 0 && static_cast<std::size_t>(v) < surface.vertices.size());
  }
}

template <typename Read>
Fuzzed refused_or_read(const Read& read) {
  try {
    read();
    return Fuzzed::read;
  } catch (const Error& error) {
    must(error.kind() == ErrorKind::model);
    must(!error.diagnostics().empty() && error.diagnostics().size() <= 21);
    for (const auto& [place, message] : error.diagnostics())
      must(!message.empty() && place.file == "fuzzed" && place.line >= 0 && place.column >= 0);
    return Fuzzed::refused;
  }
}

inline Fuzzed read_fuzzed_mesh(std::string_view bytes) {
  if (bytes.empty()) return Fuzzed::refused;
  const auto choice = static_cast<unsigned char>(bytes.front());
  const auto format = static_cast<MeshFormat>(choice & 3);
  const auto use = (choice & 4) != 0 ? MeshUse::joints : MeshUse::solid;
  return refused_or_read([&] {
    must_be_sound(read_mesh(bytes.substr(1), format, use, {"fuzzed", 0, 0, ""}));
  });
}

inline Fuzzed read_fuzzed_grid(std::string_view bytes) {
  if (bytes.empty()) return Fuzzed::refused;
  const Place place{"fuzzed", 0, 0, ""};
  const auto text = bytes.substr(1);
  return refused_or_read([&] {
    switch (static_cast<unsigned char>(bytes.front()) & 3) {
      case 0:
        must_be_sound(read_ascii_grid(text, place));
        break;
      case 1:
        must_be_sound(read_xyz(text, place));
        break;
      case 2: {
        const auto ground = read_terrain(text, place);
        must_be_sound(ground);
        check_above(ground, 0, place);
        break;
      }
      default:
        for (const auto& row :
             read_joint_table(text, JointTable{}, std::vector<JointMaterial>(1), place))
          must(row.orientation.dip >= 0 && row.orientation.dip <= 90 && row.radius > 0 &&
               row.material == 0 && std::abs(row.center[0]) <= 1e9);
    }
  });
}

}  // namespace rockfold
