// The shape of a solid or an excavation.
#pragma once

#include <optional>
#include <string>

#include "src/model/model.hpp"
#include "src/model/text/table_reader.hpp"

namespace rockfold {

/// Reads "shape" and the keys that belong to it; nothing if any of them is wrong. A shape that must
/// be `bounded` (rock that is added) needs 4 planes or more. Files are looked for in the folder of
/// the model at `model_path`.
std::optional<Shape> read_shape(TableReader& in, bool bounded, const std::string& model_path);

// By "shape", each with the keys of its own:
std::optional<Shape> read_prism(TableReader& in);
std::optional<Shape> read_pyramid(TableReader& in);
std::optional<Shape> read_frustum(TableReader& in);
std::optional<Shape> read_cylinder(TableReader& in);
std::optional<Shape> read_sphere(TableReader& in);
std::optional<Shape> read_tunnel(TableReader& in);
/// "section" of a tunnel and the keys that belong to it; empty if anything is wrong.
std::vector<std::array<Real, 2>> read_tunnel_section(TableReader& in);
std::optional<Shape> read_mesh(TableReader& in, const std::string& model_path);
std::optional<Shape> read_terrain(TableReader& in, const std::string& model_path);

/// "file": an existing file, its path resolved against the folder of the model at `model_path`.
/// What stands in it is read later (host/files).
std::optional<std::string> read_file_name(TableReader& in, const std::string& model_path);

/// Points that a shape is given by; none for one from a file.
std::vector<Vec3> given_points(const Shape& shape);

}  // namespace rockfold
