// Boxes cut by a few through-going planes, with the exact answer: counts, and volumes as fractions. The answers come
// from an exact enumeration of the arrangements in rational arithmetic, independent of this program.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "src/model/model.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

struct PlaneCase {
  std::string name, title;
  Vec3 low, high;                                  ///< the box
  std::vector<std::array<std::string, 4>> planes;  ///< a, b, c, d of a·x + b·y + c·z = d
  Index blocks;
  std::vector<std::pair<Index, std::string>>
      volumes;  ///< how many blocks of which volume, ascending
  Counts sum;   ///< over all blocks
};

const std::vector<PlaneCase>& plane_cases();

/// "p/q" or "p", rounded once or twice: relative error at most 3·2⁻⁶⁴.
long double fraction(const std::string& text);

/// The case as a model. Normals are integers (a, b, c times their common denominator), so that they are exact; the point
/// is d/n on the axis along which the normal is longest, which rounds once: the plane is off by at most
/// `offset_error`.
struct ModelOfCase {
  Model model;
  Real offset_error = 0;  ///< m
};
ModelOfCase model_of(const PlaneCase& c);

}  // namespace rockfold::test
