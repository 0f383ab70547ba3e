// [classification]: parameters outside the published tables are refused here.
#include "src/model/read/draft.hpp"

namespace rockfold {

namespace {

/// A rating's text, e.g. "Jr of the Q-system".
Range table_range(Real low, Real high, const std::string& what) {
  return between(low, high, what);
}

void read_q(TableReader& in, QInput& q) {
  in.read("rqd", q.rqd, table_range(0, 100, "%"));
  in.read("jn", q.jn, table_range(0.5, 20, "joint set number, table 2 of Barton et al."));
  in.read("jr", q.jr, table_range(0.5, 5, "joint roughness number, table 3 of Barton et al."));
  in.read("ja", q.ja, table_range(0.75, 20, "joint alteration number, table 4 of Barton et al."));
  in.read("jw", q.jw, table_range(0.05, 1, "joint water factor, table 5 of Barton et al."));
  in.read("srf", q.srf, table_range(0.5, 400, "stress reduction factor, table 6 of Barton et al."));
  const auto location =
      in.choose("location", {{"tunnel", "portal", "intersection"}, {}}, Need::optional);
  if (location) q.location = static_cast<QLocation>(*location);
  in.read("excavation_support_ratio", q.excavation_support_ratio, table_range(0.5, 5, "ESR"),
          Need::optional);
}

void read_strength(TableReader& in, RmrInput& rmr) {
  const bool ucs = in.has("uniaxial_strength"), pli = in.has("point_load_index");
  if (ucs && pli) in.wrong("point_load_index", "stands beside uniaxial_strength; give one of them");
  if (!ucs && !pli)
    in.missing({"uniaxial_strength", "point_load_index"},
               "is missing, must be > 0 (Pa); or give point_load_index");
  in.read("uniaxial_strength", rmr.uniaxial_strength, positive("Pa"));
  in.read("point_load_index", rmr.point_load_index,
          Range{.low = 1e6, .unit = "Pa; the table has none below 1 MPa: give uniaxial_strength"});
}

/// A row of the table by its words, or a rating.
void read_condition(TableReader& in, RmrInput& rmr) {
  const Value* value = in.find("joint_condition", "must be 0 to 30, or a row of the table");
  if (!value) return;
  if (!std::holds_alternative<std::string>(value->data)) {
    in.read("joint_condition", rmr.condition_rating, table_range(0, 30, "rating"));
    return;
  }
  const auto row = in.choose(
      "joint_condition",
      {{"very_rough", "slightly_rough", "highly_weathered", "slickensided", "soft_gouge"}, {}});
  if (row) rmr.condition = static_cast<Index>(*row);
}

void read_rmr(TableReader& in, RmrInput& rmr) {
  read_strength(in, rmr);
  in.read("rqd", rmr.rqd, table_range(0, 100, "%"));
  in.read("spacing", rmr.spacing, length());
  read_condition(in, rmr);
  const auto water = in.choose("groundwater", {{"dry", "damp", "wet", "dripping", "flowing"}, {}});
  if (water) rmr.groundwater = static_cast<Index>(*water);
  const auto orientation = in.choose(
      "orientation",
      {{"very_favourable", "favourable", "fair", "unfavourable", "very_unfavourable"}, {}});
  if (orientation) rmr.orientation = static_cast<Index>(*orientation);
  const auto use = in.choose("use", {{"tunnel", "foundation", "slope"}, {}}, Need::optional);
  if (use) rmr.use = static_cast<RmrUse>(*use);
}

}  // namespace

void read_classification(Draft& draft) {
  read_section(draft, "classification", [&](TableReader& in) {
    ClassificationSpec spec;
    spec.place = in.place();
    in.read("span", spec.span, length());
    in.read("height", spec.height, length());
    if (const Value* value = in.find("q")) {
      TableReader q(*value, in.path_of("q"), in.out());
      spec.q.emplace();
      if (q.is_table()) read_q(q, *spec.q);
    }
    if (const Value* value = in.find("rmr")) {
      TableReader rmr(*value, in.path_of("rmr"), in.out());
      spec.rmr.emplace();
      if (rmr.is_table()) read_rmr(rmr, *spec.rmr);
    }
    if (!spec.q && !spec.rmr)
      in.missing({"", "q", "rmr"}, "has neither [classification.q] nor [classification.rmr]");
    draft.model.classification = std::move(spec);
  });
}

}  // namespace rockfold
