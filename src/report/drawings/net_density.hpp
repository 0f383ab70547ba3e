// What a net of measured poles has beside them: their density, mean poles with cones, names on great circles.
#pragma once

#include "src/report/drawings/net.hpp"
#include "src/report/drawings/projection.hpp"

namespace rockfold {

/// Regions of density below all else; what is clipped names "net".
void draw_shades(Svg& svg, const Projection& net, const NetContent& content);
/// Mean poles as rings, with their cones.
void draw_means(Svg& svg, const Projection& net, const NetContent& content);
/// Dip and dip direction on each great circle, where it is farthest from the others' labels.
void draw_plane_labels(Svg& svg, const Projection& net, const std::vector<NetPlane>& planes);
/// The levels of the density, from `y` (px) down; returns where the legend goes on.
Real draw_shade_legend(Svg& svg, const NetContent& content, Real x, Real y);

}  // namespace rockfold
