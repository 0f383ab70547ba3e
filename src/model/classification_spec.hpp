// Rock mass classification as the user gives it. What is left out is proposed from the cut model where it
// can be, else it is missing. docs/support_design.md has the tables.
#pragma once

#include <optional>

#include "src/base/error.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Where an opening stands counts into Jn (Barton, Lien & Lunde 1974).
enum class QLocation { tunnel, portal, intersection };

/// The six parameters of the Q-system.
struct QInput {
  std::optional<Real> rqd;  ///< %, 0 … 100; none = of the cut model
  std::optional<Real> jn;   ///< 0.5 … 20; none = from the joint sets of the cut model
  Real jr = 0;              ///< 0.5 … 5
  Real ja = 0;              ///< 0.75 … 20
  Real jw = 0;              ///< 0.05 … 1
  Real srf = 0;             ///< 0.5 … 400
  QLocation location = QLocation::tunnel;
  Real excavation_support_ratio = 1;  ///< ESR, 0.5 … 5
};

enum class RmrUse { tunnel, foundation, slope };

/// What is rated in the RMR of 1989 (Bieniawski).
struct RmrInput {
  std::optional<Real> uniaxial_strength;  ///< Pa, > 0; this or
  std::optional<Real> point_load_index;   ///< Pa, ≥ 1 MPa
  std::optional<Real> rqd;                ///< %, 0 … 100; none = of the cut model
  std::optional<Real> spacing;            ///< m; none = of the closest joint set of the cut model
  std::optional<Index> condition;  ///< row of the table, 0 very rough … 4 soft gouge; this or
  Real condition_rating = 0;       ///< 0 … 30
  Index groundwater = 0;           ///< 0 dry … 4 flowing
  Index orientation = 0;           ///< 0 very favourable … 4 very unfavourable
  RmrUse use = RmrUse::tunnel;
};

struct ClassificationSpec {
  std::optional<Real> span;    ///< m, width of the opening
  std::optional<Real> height;  ///< m, of its walls
  std::optional<QInput> q;
  std::optional<RmrInput> rmr;
  Place place = {};
};

}  // namespace rockfold
