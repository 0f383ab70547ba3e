// How reports call what the program knows as enumerators.
#pragma once

#include "host/keyblock/keyblock.hpp"
#include "host/measure/block_shapes.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/bolt_arrays.hpp"
#include "src/arrays/contact_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/base/error.hpp"

namespace rockfold {

constexpr const char* mode_name(SlidingMode mode) {
  switch (mode) {
    case SlidingMode::lifting:
      return "lifting";
    case SlidingMode::single_plane:
      return "single_plane";
    case SlidingMode::two_planes:
      return "two_planes";
    case SlidingMode::rotation:
      return "rotation";
    case SlidingMode::at_rest:
      return "at_rest";
  }
  return "";
}

constexpr const char* water_law_name(WaterLaw law) {
  switch (law) {
    case WaterLaw::hydrostatic:
      return "hydrostatic";
    case WaterLaw::drained:
      return "drained";
    case WaterLaw::mid_height:
      return "mid_height";
  }
  return "";
}

constexpr const char* contact_name(Contact state) {
  switch (state) {
    case Contact::open:
      return "open";
    case Contact::stick:
      return "stick";
    case Contact::slide:
      return "slide";
  }
  return "";
}

/// Of steel, or of the bond about it.
constexpr const char* bolt_status_name(BoltStatus status) {
  switch (status) {
    case BoltStatus::elastic:
      return "elastic";
    case BoltStatus::yields:
      return "yields";
    case BoltStatus::slides:
      return "slides";
    case BoltStatus::broken:
      return "broken";
  }
  return "";
}

/// "" of faces that no joint joined.
inline std::string joint_name(const BlockArrays& blocks, Index origin) {
  return origin == none ? "" : blocks.origins[origin].name;
}

constexpr const char* class_name(BlockClass block_class) {
  switch (block_class) {
    case BlockClass::infinite:
      return "infinite";
    case BlockClass::tapered:
      return "tapered";
    case BlockClass::stable:
      return "stable";
    case BlockClass::key:
      return "key";
    case BlockClass::excavated:
      return "excavated";
    case BlockClass::not_examined:
      return "not_examined";
  }
  return "";
}

constexpr const char* shape_name(ShapeClass shape) {
  switch (shape) {
    case ShapeClass::cubic:
      return "cubic";
    case ShapeClass::cubic_elongated:
      return "cubic_elongated";
    case ShapeClass::elongated:
      return "elongated";
    case ShapeClass::elongated_platy:
      return "elongated_platy";
    case ShapeClass::platy:
      return "platy";
    case ShapeClass::platy_cubic:
      return "platy_cubic";
  }
  return "";
}

constexpr const char* preconditioner_name(Preconditioner preconditioner) {
  switch (preconditioner) {
    case Preconditioner::automatic:
      return "auto";
    case Preconditioner::block_jacobi:
      return "block_jacobi";
    case Preconditioner::node_block_jacobi:
      return "node_block_jacobi";
    case Preconditioner::multigrid:
      return "multigrid";
    case Preconditioner::direct:
      return "direct";
  }
  return "";
}

constexpr const char* kind_name(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::model:
      return "model";
    case ErrorKind::io:
      return "io";
    case ErrorKind::analysis:
      return "analysis";
  }
  return "";
}

constexpr int exit_status(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::analysis:
      return 1;
    case ErrorKind::usage:
    case ErrorKind::model:
      return 2;
    case ErrorKind::io:
      return 3;
  }
  return 1;
}

}  // namespace rockfold
