// --set key.path=value: changes a model's value tree before it is read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/model/text/value.hpp"

namespace rockfold {

/// Applies one override; spots in the new value get this `source`. Throws Error(usage) if the
/// override is malformed or names no place in the model.
///
/// The path's parts are joined by points. A part picks a key of a table, or an entry of an array by
/// its number (joint_set.2.spacing or joint_set[2].spacing, from 1) or by its name
/// (joint_set.J1.spacing). Parts that hold points or brackets stand in quotes. Keys that do not
/// exist yet are made. The value is TOML; what is no TOML is taken as a text: analysis.type=static.
/// Without a value, the key or entry is taken out: bolt_pattern.roof=
void apply_override(Value& root, const std::string& override_text, int source);

/// How messages name an override as their place: "--set key.path=value".
std::string override_name(const std::string& override_text);

}  // namespace rockfold
