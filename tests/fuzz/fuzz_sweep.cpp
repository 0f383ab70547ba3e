// The reader of SWEEP.toml on any bytes: it reads runs whose parameters can be drawn, or throws an Error whose diagnostics all say something.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "src/sweep/sampling.hpp"
#include "src/sweep/sweep_spec.hpp"

namespace rockfold::sweep {
namespace {

void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

#define PROMISE(condition) promise(condition, #condition)

/// More runs than these are not drawn here: they only take time.
constexpr Index most_runs = 1000;

void check(const Variable& v) {
  PROMISE(v.min <= v.max || v.kind == Variable::Kind::constant);
  if (v.kind == Variable::Kind::normal || v.kind == Variable::Kind::log_normal)
    PROMISE(v.standard_deviation > 0);
  for (const Real u : {1e-9, 0.5, 1 - 1e-9}) {
    const Real x = quantile(v, u);
    PROMISE(std::isfinite(x));
    if (v.kind != Variable::Kind::constant) PROMISE(v.min <= x && x <= v.max);
  }
}

void check(const SweepSpec& spec) {
  PROMISE(!spec.command.empty() && spec.workers >= 0 && spec.time_limit >= 0 &&
          spec.memory_limit >= 0);
  double combinations = 1;
  for (const Parameter& parameter : spec.parameters) {
    if (const auto* variable = std::get_if<Variable>(&parameter.values))
      check(*variable);
    else
      combinations *=
          static_cast<double>(std::get<std::vector<std::string>>(parameter.values).size());
  }
  const bool all = spec.sampling == Sampling::all;
  PROMISE(all ? !spec.parameters.empty() : spec.runs >= 1);
  if (all ? combinations > most_runs : spec.runs > most_runs) return;
  const auto rows = sample(spec);
  PROMISE(rows.size() ==
          (all ? static_cast<std::size_t>(combinations) : static_cast<std::size_t>(spec.runs)));
  for (const auto& row : rows) PROMISE(row.size() == spec.parameters.size());
}

}  // namespace
}  // namespace rockfold::sweep

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rockfold;
  try {
    sweep::check(sweep::parse_sweep({reinterpret_cast<const char*>(data), size}, "s.toml"));
  } catch (const Error& error) {
    using sweep::promise;
    PROMISE(!error.diagnostics().empty());
    for (const auto& diagnostic : error.diagnostics()) {
      PROMISE(!diagnostic.message.empty());
      PROMISE(diagnostic.place.file == "s.toml");
    }
  }
  return 0;
}
