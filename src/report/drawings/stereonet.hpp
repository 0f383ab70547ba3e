// The stereonet of a model's joints.
#pragma once

#include <string>

#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"
#include "src/report/drawings/net.hpp"

namespace rockfold {

/// A plane of the model by its dip and dip direction.
NetPlane net_plane(const std::string& name, const Orientation& orientation);

/// SVG: great circles of joint sets and single joints, poles of the joints that cut blocks, friction circles, and, where the
/// drawing asks for them, joint pyramids with the removable ones shaded. With joint pyramids the circles are whole.
/// With a wall, its free faces and the axis of what runs round one. Poles inside the friction circle (of radius φ about the vertical) are those of planes too gentle to slide on.
std::string stereonet(const BlockArrays& blocks, const Model& model, const Drawing& drawing);

}  // namespace rockfold
