// A model while it is read, and the readers of its sections. Each reads what is right, reports what
// is wrong in the draft's diagnostics and goes on; a model with any diagnostic is never handed out.
#pragma once

#include <string>
#include <vector>

#include "src/model/model.hpp"
#include "src/model/names.hpp"
#include "src/model/read/file_bodies.hpp"
#include "src/model/text/diagnostics.hpp"
#include "src/model/text/table_reader.hpp"

namespace rockfold {

struct Draft {
  const Table& root;
  Diagnostics& out;
  Model model;
  const BodyReader& bodies;
  Names materials{"material", "material"};
  Names joint_materials{"joint material", "joint_material"};
  Names solids{"solid", "solid"};
  Names joints{"joint", "joint"};  ///< of all kinds of joints together: reports name planes by them
  Names monitors{"monitor", "monitor"};
  Names excavations{"excavation", "excavation"};
  Names scanlines{"scanline", "scanline"};
  Names bolt_types{"bolt type", "bolt_type"};
  Names bolts{"bolt", "bolt"};    ///< single ones and patterns together: reports name bolts by them
  std::vector<bool> has_shape{};  ///< [solids] its shape could be read
  std::vector<bool> excavation_has_shape{};  ///< [excavations] likewise
};

/// Calls `read(reader, number)` for each table of the section [[key]], numbers counting from 1.
template <class Read>
void read_entries(Draft& draft, const std::string& key, Read read);

/// Whether the section [key] stands there; if it is a table, `read(reader)` is called.
template <class Read>
void read_section(Draft& draft, const std::string& key, Read read);

void read_materials(Draft& draft);
void read_joint_materials(Draft& draft);
void read_solids(Draft& draft);        // needs materials and joint materials
void read_joint_sets(Draft& draft);    // needs joint materials and solids
void read_joints(Draft& draft);        // likewise
void read_joint_meshes(Draft& draft);  // likewise
void read_joint_tables(Draft& draft);  // likewise
void read_merges(Draft& draft);        // needs solids
void read_excavations(Draft& draft);   // needs solids
void read_cut(Draft& draft);
void read_scanlines(Draft& draft);
void read_cover(Draft& draft);
void read_fixed(Draft& draft);             // needs solids and excavations
void read_tractions(Draft& draft);         // likewise
void read_quiet_boundaries(Draft& draft);  // likewise
void read_point_loads(Draft& draft);
void read_initial_velocities(Draft& draft);
void read_initial_stress(Draft& draft);
void read_monitors(Draft& draft);  // needs joints of all kinds and solids
void read_analysis(Draft& draft);
void read_base_acceleration(Draft& draft);  // needs the steps of the analysis
void read_contact(Draft& draft);            // needs joint materials
void read_contact_pairs(Draft& draft);      // and solids
void read_solver(Draft& draft);
void read_output(Draft& draft);
void read_reduction(Draft& draft);
void read_support(Draft& draft);
void read_bolt_types(Draft& draft);
void read_bolts(Draft& draft);           // needs bolt types
void read_bolt_patterns(Draft& draft);   // needs bolt types, solids and excavations
void read_shotcrete(Draft& draft);       // needs solids and excavations
void read_pattern_search(Draft& draft);  // needs bolt types, solids and excavations
void read_classification(Draft& draft);
void read_drawings(Draft& draft);  // needs solids and excavations
void read_tables(Draft& draft);
void read_waters(Draft& draft);        // needs joints of all kinds
void read_block_theory(Draft& draft);  // needs materials

/// "rule" of a strike.
bool is_left_hand(TableReader& in);
/// "dip" and "dip_direction" of a table.
bool read_dip(TableReader& in, DipOrientation& target, Need need = Need::required);
/// The same numbers as a pair [dip, dip direction].
bool read_dip_pair(const Value& value, const std::string& path, DipOrientation& target,
                   Diagnostics& out);
/// "dip" and "dip_direction", or "normal".
bool read_orientation(TableReader& in, Orientation& target);
/// An orientation and "point".
bool read_plane(TableReader& in, GivenPlane& target);

/// Unit normal; upward for angles.
Vec3 unit_normal(const DipOrientation& orientation);
Vec3 unit_normal(const Orientation& orientation);

/// The names of all joints, and of those around solids: "dam.interface".
std::vector<std::string> joint_names(const Draft& draft);
/// Whether a name is one of them.
bool is_joint(const Draft& draft, const std::string& name);
/// "within": the id of a solid, or none.
void read_within(TableReader& in, const Draft& draft, Index& target);
/// "sides" of a disc's polygon or of a cylinder.
void read_sides(TableReader& in, Index& target);
/// What a shape's faces and groups of faces are called, for messages.
std::vector<std::string> names_and_groups(const Shape& shape);

/// Largest extent of the points that the solids are given by, m; at least 1e-9 times their largest
/// coordinate.
Real given_size(const Model& model);

// ---------------------------------------------------------------------------------------------------------------

template <class Read>
void read_entries(Draft& draft, const std::string& key, Read read) {
  const auto* section = draft.root.find(key);
  if (!section) return;
  if (const auto* entries = std::get_if<Array>(&section->value.data)) {
    for (std::size_t i = 0; i < entries->size(); ++i) {
      TableReader in((*entries)[i], key + "[" + std::to_string(i + 1) + "]", draft.out);
      read(in, static_cast<Index>(i + 1));
    }
    return;
  }
  const bool table = std::holds_alternative<Table>(section->value.data);
  draft.out.add(section->value.spot, key,
                table ? "there may be many of these: write [[" + key + "]], not [" + key + "]"
                      : "found " + described(section->value) + ", must be a table [[" + key + "]]");
}

template <class Read>
void read_section(Draft& draft, const std::string& key, Read read) {
  const auto* section = draft.root.find(key);
  if (!section) return;
  if (std::holds_alternative<Table>(section->value.data)) {
    TableReader in(section->value, key, draft.out);
    read(in);
    return;
  }
  const bool many = std::holds_alternative<Array>(section->value.data);
  draft.out.add(section->value.spot, key,
                many ? "there can be only one: write [" + key + "], not [[" + key + "]]"
                     : "found " + described(section->value) + ", must be a table [" + key + "]");
}

}  // namespace rockfold
