// Joint sets of a survey: from measured orientations to the sets of a model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/files/read_joint_table.hpp"
#include "host/survey/fisher.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// The direction of a scanline, a borehole or a traverse.
struct LineDirection {
  Real trend = 0, plunge = 0;  ///< deg, clockwise from north; down
  bool operator==(const LineDirection&) const = default;
};
/// Unit; z is up.
Vec3 direction_vector(const LineDirection& line);

/// A table as it was read.
struct Survey {
  std::vector<JointTable::Row> rows;
  SurveyColumns columns;
};

/// How sets are to be found.
struct SurveyRules {
  /// That crossed all joints; goes before columns.
  std::optional<LineDirection> scanline = {};
  /// deg, > 0: joints that lie nearer to the line than this are weighed as if they lay at it (Terzaghi, Géotechnique 15, 1965)
  Real blind_zone = 15;
  bool own_sets = true;  ///< the table's column of sets counts, if there is one
  /// Of sets that are looked for; else as many as the criterion finds.
  std::optional<std::size_t> count = {};
};

/// Joints of a set one after another along scanlines; lines of one direction are one.
struct SetSpacing {
  Index intervals = 0;  ///< between neighbours
  Real along = 0;       ///< m, mean along the lines
  /// m, mean along the set's normal: Σ L |cos δ| / intervals, L from the first to the last joint of the set on a line and δ between
  /// the line and the mean pole (Terzaghi 1965; Priest, Discontinuity analysis for rock engineering, 1993). NaN of a line without direction.
  Real normal = 0;
  /// All lines lie in the set's blind zone: the normal spacing is not to be relied on.
  bool blind = false;
};

/// What a survey says of one set.
struct MeasuredSet {
  std::string name;
  Real dip = 0, dip_direction = 0;  ///< deg, of the mean plane
  Index count = 0;                  ///< rows that belong to it
  Real share = 0;                   ///< of all joints, by weight
  FisherStatistics fisher;          ///< of found sets each pole counts by its chance to belong
  Real half_cone = 0,
       most_cone =
           0;  ///< deg about the mean, that hold 50 and 95 of 100 poles of Fisher's distribution
  std::optional<SetSpacing> spacing;  ///< where distances are known and two joints lie on a line
  Index extents = 0;                  ///< rows with an extent
  Real mean_extent = 0;               ///< m, of these: diameter, trace length, …
};

struct SurveyReport {
  bool by_column = false;         ///< the sets are the table's own
  std::vector<MeasuredSet> sets;  ///< found ones: the largest share first
  std::vector<Index> set_of_row;  ///< [rows] none of those that belong to no set
  std::vector<Vec3> poles;        ///< [rows] unit, upward
  std::vector<Real> weight;       ///< [rows] of the column, times Terzaghi's
  Real effective_count = 0;       ///< Kish's
  Real background = 0;            ///< share of joints in no set, by weight
  std::vector<Real> criteria;     ///< of found sets, SetSearch::criteria
  std::vector<LineDirection>
      lines;        ///< that differ, as they come; none where no direction is known
  Index blind = 0;  ///< rows in the blind zone of their line
};

/// The table's own sets, or those that its poles make (mixture.hpp), and what can be said of each.
SurveyReport find_joint_sets(const Survey& survey, const SurveyRules& rules);

}  // namespace rockfold
