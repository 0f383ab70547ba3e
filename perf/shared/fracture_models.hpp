// Models whose cutting is hard: networks of finite discs, and rock under surfaces of very many triangles.
#pragma once

#include "src/model/model.hpp"

namespace rockfold {

/// Discs of 16 sides with radii uniform in [least, most] m, centres and orientations uniform (the orientations on the
/// sphere), in a cube of edge 100 m.
Model disc_network(Index count, Real least, Real most);

/// Hilly ground of posts × posts posts, 10 m apart, over a flat base.
Model hilly_terrain(Index posts);

/// A ball of radius 10 m with bumps, of 2·rings·(rings − 1)·2 triangles.
Model bumpy_ball(Index rings);

}  // namespace rockfold
