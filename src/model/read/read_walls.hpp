// Names of walls: what bolts are drilled from and shotcrete is sprayed on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/model/read/draft.hpp"

namespace rockfold {

/// "tunnel", "tunnel.side", "rock.xmin": the faces of an excavation or a solid, or one or a group of them. The name alone
/// means the sides of what runs along an axis (tunnel, cylinder, prism), the top of a terrain, else all faces.
/// Reports what it does not know.
std::optional<WallFaces> read_wall(TableReader& in, const std::string& key, const Draft& draft,
                                   Need need = Need::required);
/// One name or an array of them; empty if the key is absent.
std::vector<WallFaces> read_walls(TableReader& in, const std::string& key, const Draft& draft);

}  // namespace rockfold
