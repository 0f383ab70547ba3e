// A stereonet as SVG, of whatever stands on it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/base/types.hpp"
#include "src/report/drawings/svg.hpp"

namespace rockfold {

/// A plane that has a great circle of its own.
struct NetPlane {
  std::string name;
  Vec3 normal{};                    ///< unit, upward
  Real dip = 0, dip_direction = 0;  ///< deg
  std::string note = {};            ///< behind it in the legend
};

/// What a stereonet shows.
struct NetContent {
  /// Of a joint; `plane` into NetContent::planes, whose colour it has: beyond them grey.
  struct Pole {
    Vec3 normal{};
    std::size_t plane = 0;
  };
  /// A mean pole with the cone about it that holds the true one.
  struct Mean {
    Vec3 pole{};
    Real cone = 0;          ///< deg
    std::size_t plane = 0;  ///< whose colour it has
  };
  /// Where poles lie at least that densely.
  struct Shade {
    std::string words;                       ///< of the legend
    std::vector<std::vector<Point2>> loops;  ///< on a disc of radius 1 about the origin, north up
  };
  std::string title, title_of_document;
  std::vector<NetPlane> planes;  ///< at most most_net_planes have circles
  bool with_poles = true;
  std::vector<Pole> poles;
  std::string words_of_poles = "dots: poles of joints between blocks";
  std::string words_of_others = "other joints";
  std::vector<Mean> means;
  std::vector<Shade> shades;  ///< from the least density on, each inside the one before
  std::string title_of_shades;
  bool label_planes = false;          ///< dip and dip direction on the circles
  std::vector<Real> friction_angles;  ///< deg; a circle about the vertical for each
  bool upper = false;                 ///< hemisphere
  bool equal_area = false;            ///< else equal angle
  bool joint_pyramids = false;        ///< circles whole, regions coded
  std::string wall;                   ///< from which pyramids are removable; empty: none is named
  std::vector<Vec3> free;             ///< outward normals of its free faces, unit
  Vec3 axis{};                        ///< of what runs round one, unit; zero: none
};

inline constexpr std::size_t most_net_planes = 8;

/// The drawing. Its legend is as wide as its words.
std::string draw_net(const NetContent& content);

}  // namespace rockfold
