// The program's own arrays in a result file, under /rockfold: a data set for each array, under its
// name.
#pragma once

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/first_look_arrays.hpp"
#include "src/io/hdf5/hdf5_file.hpp"
#include "src/io/result_file.hpp"

namespace rockfold {

/// Grows when a reader of the last version could misread a file.
constexpr int result_format_version = 1;

/// The model's text and the names that ids refer to, and what made the file.
void write_origin(hdf5::File& file, const Model& model, const ResultHeader& header);

/// All arrays of BlockArrays but `vertex`, `corner_begin` and `corner_vertex`, which the caller
/// writes or links.
void write_block_arrays(hdf5::File& file, const BlockArrays& blocks);
void write_block_theory(hdf5::File& file, const BlockFields& fields);
void write_first_looks(hdf5::File& file, const FirstLookArrays& looks);
void write_cover_arrays(hdf5::File& file, const CoverArrays& covers);

/// Appends to /rockfold/states.
void append_state(hdf5::File& file, Index step, const StateArrays& state);
/// Appends to /rockfold/contacts, and how many they are to /rockfold/states/contact_count.
void append_contacts(hdf5::File& file, std::span<const ContactSample> contacts);
/// A data set for its times and for each column, and its name and joint as attributes.
void write_history(hdf5::File& file, const std::string& group, const History& history);
/// bytes of one contact point there.
std::int64_t contact_bytes();

}  // namespace rockfold
