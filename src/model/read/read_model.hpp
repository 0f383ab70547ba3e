// Reads a model file (TOML; docs/user_guide.md, The model file).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/model/check_model.hpp"
#include "src/model/model.hpp"
#include "src/model/read/file_bodies.hpp"

namespace rockfold {

/// Reads and checks a model, also for what `purpose` needs of it. `overrides` are the command
/// line's
/// --set "key.path=value", applied in order (overrides.hpp says how they are written).
///
/// Throws Error(io) if the file cannot be read, Error(usage) for a malformed override, Error(model)
/// with all of the model's errors at once, by line. Each has the file, line and column of the wrong
/// value or key and its key path: entries count from 1, as in "joint_set[2].spacing". A value from
/// the command line has "--set key.path=value" as its file, and line 0.
/// `bodies` reads mesh files of which each body becomes a solid; without it such files are no part of a model.
Model read_model(const std::string& path, const std::vector<std::string>& overrides = {},
                 Purpose purpose = Purpose::cut, const BodyReader& bodies = {});

/// The same for a text in memory; `name` stands for the file in messages.
Model parse_model(std::string_view text, const std::string& name,
                  const std::vector<std::string>& overrides = {}, Purpose purpose = Purpose::cut,
                  const BodyReader& bodies = {});

/// The text of a model file; of standard input for "-". Throws Error(io) where it cannot be read, Error(model) where it is no text.
std::string model_file_text(const std::string& path);

/// A model as far as it could be read.
struct ReadModel {
  Model model;
  std::optional<Error>
      wrong;  ///< what read_model would throw; the model then lacks the wrong parts
};
/// Throws only where there is no model at all: no such file, no TOML, a malformed override.
ReadModel try_read_model(const std::string& path, const std::vector<std::string>& overrides,
                         Purpose purpose, const BodyReader& bodies = {});
/// The same for a text in memory; `name` stands for the file in messages.
ReadModel try_parse_model(std::string_view text, const std::string& name,
                          const std::vector<std::string>& overrides, Purpose purpose,
                          const BodyReader& bodies = {});

}  // namespace rockfold
