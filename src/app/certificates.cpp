#include "src/app/certificates.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/stability/verify.hpp"
#include "src/app/answers.hpp"
#include "src/base/error.hpp"
#include "src/io/partial_file.hpp"
#include "src/report/documents/certificate_document.hpp"
#include "src/report/documents/documents.hpp"
#include "src/report/summaries/summary.hpp"

namespace rockfold {

namespace {

constexpr int digits = 6;  // of a factor

bool has_sliding(const Certificate& certificate) {
  return !certificate.sliding_mechanism.velocity.empty();
}

bool has_above(const Certificate& certificate) {
  return !certificate.above.velocity.empty();
}

std::string counted(std::size_t n, const std::string& one) {
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

/// A bound with six digits is one still: rounded down or up by `whole`, std::floor or std::ceil.
std::string bound_text(Real factor, Real (*whole)(Real)) {
  const Real step = std::pow(10.0, std::floor(std::log10(factor)) + 1 - digits);
  return fmt::format("{:.{}g}", whole(factor / step) * step, digits);
}

Json verdict_document(const Certificate& certificate, const Verdict& verdict) {
  Json document = head_json({"verify", "", {}});
  document["holds"] = verdict.holds();
  document["bound"] = {{"below", certificate.below.factor}, {"above", nullptr}};
  if (has_above(certificate)) document["bound"]["above"] = certificate.above.factor;
  document["sliding"] =
      has_sliding(certificate) ? Json(certificate.sliding_balance.factor) : Json();
  document["residual"] = verdict.residual;
  return document;
}

std::string verdict_text(const Certificate& certificate, const Verdict& verdict) {
  const RigidMass& mass = certificate.mass;
  std::string text = fmt::format("certificate of {} and {}\n", counted(mass.bodies.size(), "block"),
                                 counted(mass.contacts.size(), "contact area"));
  const auto floor = [](Real x) { return std::floor(x); };
  const auto ceil = [](Real x) { return std::ceil(x); };
  const std::string below = bound_text(certificate.below.factor, floor);
  text += fact("bound",
               has_above(certificate)
                   ? fmt::format("{} <= F <= {}  (proved: forces that balance every block, and "
                                 "a motion that no strength withstands)",
                                 below, bound_text(certificate.above.factor, ceil))
                   : fmt::format("{} <= F  (proved: forces that balance every block)", below));
  text += fact("sliding", has_sliding(certificate)
                              ? fmt::format("{:.{}g}  (a state of collapse without dilation)",
                                            certificate.sliding_balance.factor, digits)
                              : "none is given");
  return text + fact("residual",
                     fmt::format("{:.1e} of the forces on a block, at most", verdict.residual));
}

}  // namespace

bool has_certificate(const StabilityReport& report) {
  return !report.bound.below.force.empty() && !std::isinf(report.bound.factor);
}

void write_certificate(const std::string& path, const StabilityReport& report, Terminal& terminal) {
  if (!has_certificate(report)) {
    const char* why = report.bound.factor == 0 ? "no forces balance this mass at any strength"
                                               : "this mass stands without any strength";
    return terminal.warn(fmt::format(
        "{} is not written, as {}{}", path, why,
        std::filesystem::exists(path) ? "; the file of that name is of another run" : ""));
  }
  const Certificate certificate = report.certificate();
  if (const Verdict verdict = verify(certificate); !verdict.holds())
    throw Error(ErrorKind::analysis, "the bound could not be proved: " + verdict.wrong);
  PartialFile target(path);
  std::FILE* file = std::fopen(target.aside().c_str(), "wb");
  if (file) write_document(file, certificate_document(certificate));
  const bool good = file && std::ferror(file) == 0;
  if ((file && std::fclose(file) != 0) || !good)
    throw Error(ErrorKind::io, "cannot be written", Place{path, 0, 0, ""});
  target.take_name();
}

int verify_certificate(const Options& options) {
  const Certificate certificate = read_certificate(options.input);
  const Verdict verdict = verify(certificate);
  if (!verdict.holds())
    throw Error(ErrorKind::analysis, "does not hold: " + verdict.wrong,
                Place{options.input, 0, 0, ""});
  Options always = options;  // what was asked for is the answer, and there is no other
  always.quiet = false;
  print_made(always, {}, verdict_document(certificate, verdict),
             verdict_text(certificate, verdict));
  return 0;
}

}  // namespace rockfold
