#include "src/check/opposed_supports.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/base/place_text.hpp"
#include "src/base/vector.hpp"
#include "src/report/error_text.hpp"
#include "src/run/base_motion.hpp"
#include "src/run/fixed_contradiction.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

Vec3 place_of(const CoverArrays& covers, const FixedPoints& fixed, Index row) {
  const Index cell = element_nodes(covers, fixed.points.element[row]).cell;
  return covers.lattice.cell_centre(cell) + fixed.points.local[row];
}

std::string name_of(const Model& model, Index condition) {
  const int line = model.fixed[condition].place.line;
  return fmt::format("fixed[{}]{}", condition + 1, line > 0 ? fmt::format(" (line {})", line) : "");
}

std::string since_text(const Contradiction& found) {
  return found.time > found.from ? fmt::format("after t = {:.6g} s", found.from)
                                 : fmt::format("at t = {:.6g} s", found.time);
}

Diagnostic told(const Contradiction& found, const Model& model, const Vec3& place) {
  const auto [first, second] = found.condition;
  Place of_second = model.fixed[second].place;
  of_second.key = fmt::format("fixed[{}]", second + 1);
  return {
      of_second,
      fmt::format(
          "contradicts {} {}, in {} at {}: at t = {:.6g} s it prescribes {:.6g} m, where {} "
          "makes {:.6g} m. {}",
          name_of(model, first), since_text(found), "xyz"[found.axis], place_text(place),
          found.time, found.displacement[1], name_of(model, first), found.displacement[0],
          found.same_rock
              ? "One place moves in one way: let both prescribe the same there, hold other "
                "components, or give their rock a joint or an interface between them"
              : "The covers there cannot follow both, and neither is kept: a smaller "
                "cover.spacing, or another cover.lattice than \"block\", lets rock strain more")};
}

}  // namespace

bool may_oppose(const Model& model) {
  const auto oppose = [](const Fixed& a, const Fixed& b) {
    for (int d = 0; d < 3; ++d)
      if (a.components[d] && b.components[d] &&
          (a.value[d] != b.value[d] || a.table.time != b.table.time ||
           a.table.value != b.table.value))
        return true;
    return false;
  };
  for (const Fixed& a : model.fixed)
    if (std::any_of(model.fixed.begin(), model.fixed.end(),
                    [&](const Fixed& b) { return oppose(a, b); }))
      return true;
  return false;
}

void require_supports_agree(const Model& model, const CoverArrays& covers, const FixedPoints& fixed,
                            Terminal& terminal) {
  if (!model.analysis || !may_oppose(model)) return;
  const Analysis& analysis = *model.analysis;
  const Real end = start_of_stage(analysis, static_cast<Index>(analysis.stages.size()));
  const auto found = find_contradiction(fixed, model.fixed, end);
  if (!found) return;
  const Diagnostic diagnostic = told(*found, model, place_of(covers, fixed, found->row));
  if (found->same_rock) throw Error(ErrorKind::model, {diagnostic});
  terminal.warn(diagnostic_line(diagnostic));
}

}  // namespace rockfold
