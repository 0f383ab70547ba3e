// Small blocks and covers for the tests of result files: irregular, off the origin, each checkable
// by hand.
#pragma once

#include <filesystem>
#include <string>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/io/result_file.hpp"

namespace rockfold::test {

/// nx × ny × nz boxes of 2 × 1.5 × 1 m from (10, 20, −5) on, cut by joints "J1", "J2", "J3"
/// (normals x, y, z) out of the solid "rock".
BlockArrays box_grid(Index nx, Index ny, Index nz);

/// One block: a square tube along z, outer side 4, inner side 2, height 3, centred on (1, 2, 3).
/// Two of its faces have a hole.
BlockArrays tube();

/// A skewed lattice of n³ cells from (3, −2, 7) on, all regular but the last, of which one
/// tetrahedron stays: cut through the middle of three of its edges into two pieces of different
/// blocks that are one element.
CoverArrays lattice_with_cut(Index n);

/// The volume of a lattice cell of lattice_with_cut, m³.
Real cell_volume(const Lattice& lattice);

/// A motion that is linear in place, u = A x + time · b, at the covers and at given points.
Vec3 linear_motion(const Vec3& x, Real time);
StateArrays linear_state(const CoverArrays& covers, Real time);
std::vector<Vec3> linear_motion(const std::vector<Vec3>& points, Real time);

Model sample_model();
ResultHeader sample_header();
BlockFields sample_theory(const BlockArrays& blocks);

/// Writes blocks, elements and states at the given times; 6 stress components 1 … 6 times the
/// element's number. Not finished.
void write_sample(ResultWriter& writer, const BlockArrays& blocks, const CoverArrays& covers,
                  const std::vector<Real>& times);

/// A folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::string operator/(const std::string& name) const { return (path / name).string(); }
  std::vector<std::string> names() const;  ///< of what it holds, sorted

  std::filesystem::path path;
};

std::string file_bytes(const std::string& path);

}  // namespace rockfold::test
