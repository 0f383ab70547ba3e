// Scanlines through the cut rock: where they meet joints, how long they lie in rock, RQD.
#pragma once

#include <string>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

struct Complex;

/// A line and what stands along it. Pieces are the parts of the line in rock between joints (or where the rock ends).
struct LineMeasure {
  std::string name;
  Vec3 from{}, to{};                ///< m
  Real length_in_rock = 0;          ///< m
  Index crossings = 0;              ///< of joints
  std::vector<Index> crossings_of;  ///< [origins of the complex]
  Index pieces = 0;
  /// Share of the length in rock that lies in pieces of at least 0.1 m (Deere 1964), [0, 1]; NaN without rock.
  Real rqd = 0;
};

/// The model's scanlines; without any, three lines parallel to the axes through the centre of the rock's box, named x, y, z.
/// Each is moved aside by a millionth of the model's size, in a fixed odd direction, so that it runs along no joint.
/// O(lines · (cells + fragments)).
std::vector<LineMeasure> measure_lines(const Complex& complex, const std::vector<Scanline>& lines);

/// The box around all rock, m, model coordinates.
struct RockBox {
  Vec3 min{}, max{};
  Vec3 centre() const;
};
RockBox rock_box(const Complex& complex);

}  // namespace rockfold
