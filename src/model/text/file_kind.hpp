// What a file is that is no text, and what a name was meant to be for which there is no file.
#pragma once

#include <string>
#include <string_view>

namespace rockfold {

/// "a ZIP archive, as office programs write": of formats that are known by their first bytes; else "".
std::string known_kind(std::string_view bytes);

/// The same; "binary" of others that are no text; "" if it may be text.
std::string kind_of_binary(std::string_view bytes);

inline constexpr const char* backslash_hint =
    "; in \"…\" a backslash begins an escape (\\t is a tab): write / between folders";

/// `, did you mean "data/Ground.asc"?` where a file is there but for case, a letter or '\\' for '/'; why a name holds control
/// characters; else "". Of files only those are suggested whose names have this ending.
std::string file_hint(const std::string& path, std::string_view ending = "");

}  // namespace rockfold
