// Spacings of sets along scanlines.
#pragma once

#include <optional>
#include <vector>

#include "host/survey/joint_sets.hpp"

namespace rockfold {

/// Where the joints of a survey lie on its scanlines.
struct LinePlaces {
  std::vector<LineDirection> lines;  ///< that differ
  std::vector<Index>
      line_of_row;  ///< [rows]; empty where no direction is known: then all lie on one line
  std::vector<Real> distance;  ///< [rows] m; empty where it is not known
};

/// By a column of distances, or else by places seen along their line.
LinePlaces places_on_lines(const Survey& survey, const std::optional<LineDirection>& scanline);

/// |cos δ| between the line of a row and its pole; nothing where no line is known.
std::optional<Real> cosine_to_line(const LinePlaces& places, std::size_t row, const Vec3& pole);

/// Of the rows of one set, whose mean pole is `mean`. Nothing where no line has two of them at distances that differ.
std::optional<SetSpacing> spacing_of(const LinePlaces& places, const std::vector<std::size_t>& rows,
                                     const Vec3& mean, Real blind_zone);

}  // namespace rockfold
