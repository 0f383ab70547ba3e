// What must hold in every complex of cells, whatever was cut.
#pragma once

#include <string>
#include <vector>

#include "host/cut/complex.hpp"

namespace rockfold::test {

struct ComplexRules {
  /// Through-going joints in convex solids only: cells then meet in whole faces, and the walk around each inner edge,
  /// from cell to cell, comes back to its start after 2π.
  bool whole_faces = false;
  /// Allowed difference between a face's area and the sum of its parts, over L². Rounding of the corners alone gives
  /// some 1e-13; corners identified within the tolerance up to 1e-10 times the face's perimeter.
  Real area_tolerance = 1e-12;
};

/// One line for each rule broken (at most 20); empty if the complex is consistent.
///   cells:      every edge has two faces that run it in opposite senses and name each other; V − E + F = 2; no vertex
///               lies outside of a face's plane; positive volume.
///   fragments:  the two faces lie on the two sides of one plane; each face's parts add up to its area.
std::vector<std::string> faults_of(const Complex& complex, const ComplexRules& rules = {});

}  // namespace rockfold::test
