// The contact points of a run as a page stores them.
#pragma once

#include <vector>

#include "src/page/page_arrays.hpp"
#include "src/page/page_surface.hpp"

namespace rockfold {

/// Numbers over the range that they have in all states, in levels finer than a legend's colours: `name` [·] of 0 … 1000 and name_range
/// [2]; not a number is 65535. Nothing is added where no value is a number.
void add_levels(const std::string& name, const std::vector<float>& values, PageArrays& arrays);

/// How many contact points these states have in all.
std::int64_t contact_points(const hdf5::File& file, const std::vector<Index>& states);

/// Adds, for the shown states (S of them), the contact points of one state after the other; nothing where blocks do not touch:
///   contact_count [S]
///   contact_place [·][3] m, relative to `origin`; contact_block [·] the first block's id; contact_joint [·] into the origins, from 1, 0 of
///   faces that met; contact_state [·] 0 open, 1 stick, 2 slide
///   contact_gap, contact_slip (m), contact_normal, contact_shear (Pa): levels [·]
void add_contacts(const hdf5::File& file, const std::vector<Index>& states, const Vec3& origin,
                  PageArrays& arrays);

}  // namespace rockfold
