#include "src/run/refusal.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "src/base/error.hpp"
#include "src/base/place_text.hpp"
#include "src/run/contact_setup.hpp"
#include "src/run/records/contact_samples.hpp"
#include "src/run/speck_advice.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

std::string three_digits(Real value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

Trouble find_trouble(const RunInput& input, const Motion& motion) {
  const Index cover = motion.most_unbalanced_cover();
  const MaterialPoints& vertices = input.contact->points;
  Index block = none;
  for (std::size_t v = 0; v < vertices.size() && block == none; ++v)
    if (vertices.unknown[vertices.begin[v]] == cover)
      block = input.contact->surfaces.vertex_block[v];
  const auto samples = contact_samples(input, contact_options(input.model, input.blocks).laws,
                                       motion.contact_points(), motion.state().displacement);
  Trouble found;
  Real deepest = std::numeric_limits<Real>::infinity();
  for (const ContactSample& s : samples) {
    if ((s.block[0] != block && s.block[1] != block) || !(s.gap < deepest)) continue;
    deepest = s.gap;
    found = {{s.block[0], s.block[1]}, s.place};
  }
  return found;
}

namespace {

std::string contact_trouble(const SolveReport& report, const Trouble& trouble) {
  std::string what = "contact does not settle";
  if (trouble.block[0] != none)
    what += " between blocks " + std::to_string(trouble.block[0] + 1) + " and " +
            std::to_string(trouble.block[1] + 1) + " near " + place_text(trouble.place);
  return what + ", in " + std::to_string(most_substeps) + " parts of the step too: residual " +
         three_digits(report.residual) +
         " (analysis.time_step, contact.max_iterations, solver.max_iterations, "
         "joint_material.normal_stiffness)";
}

}  // namespace

void refuse(const SolveReport& report, const Trouble& trouble, Index step, Real time,
            const RunInput& input) {
  std::string what = "step " + std::to_string(step) + ", time " + three_digits(time) + " s: ";
  if (report.inverted != none) {
    const Vec3 at =
        input.covers.lattice.cell_centre(element_nodes(input.covers, report.inverted).cell);
    what += "block " + std::to_string(block_of(input.covers, report.inverted) + 1) +
            " is turned inside out near " + place_text(at) +
            ": loads or velocities are too large for its stiffness (material.young_modulus)";
  } else if (!std::isfinite(report.residual)) {
    what += !input.model.analysis->has(AnalysisType::dynamic)
                ? "the solver broke down (solver.preconditioner), or nothing resists the loads"
                : "the motion grew beyond all numbers: it is not stable (analysis.time_step, "
                  "analysis.newmark), or nothing resists it";
  } else if (input.contact) {
    what += contact_trouble(report, trouble);
  } else {
    const SolverSpec& solver = input.model.solver;
    if (report.residual <= solver.tolerance)
      what += "the forces are balanced (residual " + three_digits(report.residual) +
              "), but supports are still " + three_digits(report.gap) +
              " of the largest displacement from their places after " +
              std::to_string(report.iterations) +
              " iterations: held points contradict each other "
              "([[fixed]]), or are too many for the covers near them (cover.spacing)";
    else
      what += "the solver did not converge: residual " + three_digits(report.residual) + " after " +
              std::to_string(report.iterations) + " iterations, tolerance " +
              three_digits(solver.tolerance) + " (solver.tolerance, solver.max_iterations)";
  }
  throw Error(ErrorKind::analysis,
              what + speck_advice(input.blocks, input.model.cut, trouble.block[0]));
}

}  // namespace rockfold
