// What a model asks of contact: by which laws blocks touch each other, and how near they are looked at.
#pragma once

#include "kernels/contact/contact.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/surface_arrays.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// Laws of the joint materials and the rest of [contact]. A stiffness that is not given closes by 1e-5 of a block under its overburden,
/// ρ g H / (1e-5 h), but is no more than E/h: a joint need not be stiffer than the rock. h is the cube root of the mean volume.
/// Behind the joint materials comes the law of what no joint parts: `intact_law`.
ContactOptions contact_options(const Model& model, const BlockArrays& blocks);

/// Into the laws: of the faces between rock that is excavated on the way and other rock. Its bonds bear whatever comes.
Index intact_law(const Model& model);
/// Of faces that no joint made: free ones of a solid carry its `interface`, unless [contact] material is given.
FaceMaterials face_materials(const Model& model);

/// Of two surfaces that met (SurfaceArrays::face_material, or none): what a [[contact_pair]] says, the material that both have or that
/// one has, else the weaker one; [contact] material where none has any.
MetSurfaces law_between(const Model& model, Index one, Index other);
/// Of those that `met` (Motion::surfaces_that_met).
std::vector<MetSurfaces> met_surfaces(const Model& model, const std::vector<std::uint8_t>& met);
/// As the model and messages name it.
std::string surface_name(const Model& model, Index surface);

}  // namespace rockfold
