// What two surfaces give: the joint material that counts where they touch.
#pragma once

#include "src/model/model.hpp"

namespace rockfold {

/// Which of two joint materials holds less: by residual friction, then cohesion.
Index weaker_material(const Model& model, Index one, Index other);

/// What a [[contact_pair]] says of two surfaces, each by its material or as a solid (surface_of_solid; either may be none), or none.
struct PairedSurface {
  Index solid = none, material = none;
};
Index paired_material(const Model& model, const PairedSurface& one, const PairedSurface& other);

/// Of the joint between two solids: what their pair gives, the weaker `interface`, or the only one; none: they are welded.
Index interface_material(const Model& model, Index solid, Index other);

/// The surface that a solid with an `interface` has to others: that of the solid where a [[contact_pair]] names it, else its interface; none
/// without an interface.
Index interface_surface(const Model& model, Index solid);

}  // namespace rockfold
