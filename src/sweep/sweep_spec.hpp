// SWEEP.toml (docs/user_guide.md, Many runs): many runs of one model with varied parameters.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/types.hpp"

namespace rockfold::sweep {

/// A number drawn at random, inside [min, max] alone.
struct Variable {
  enum class Kind {
    constant,
    exponential,
    log_normal,
    power_law,
    normal,
    uniform,
    triangular,
    beta,
    weibull
  };
  Kind kind = Kind::constant;
  /// Constant, normal, log-normal, exponential: of all values, those outside [min, max] too. Of an exponential variable < 0: it is below 0.
  Real mean = 0;
  Real standard_deviation = 0;  ///< normal, log_normal; > 0
  Real exponent = 0;            ///< power law: density ∝ x^−exponent on [min, max]
  Real min = -std::numeric_limits<Real>::infinity();
  Real max = std::numeric_limits<Real>::infinity();
  bool integer =
      false;  ///< whole numbers alone: uniform draws each of [min, max] alike, others are rounded
  Real mode = 0;  ///< triangular: the most likely value, in [min, max]
  Real alpha = 1,
       beta = 1;  ///< beta: density ∝ t^(alpha − 1) (1 − t)^(beta − 1), t from 0 at min to 1 at max
  Real shape = 1, scale = 1;  ///< Weibull: P(x < X) = 1 − exp(−(X/scale)^shape)
};

/// Spearman's rank correlation with a parameter before it.
struct Correlation {
  std::size_t with = 0;
  Real rank = 0;
};

/// Of parameters before it, by their names (formula.hpp).
struct Expression {
  std::string formula;
};

struct Parameter {
  std::string key;  ///< as for --set; where there are `keys`, its name
  /// TOML texts, or what is drawn, or what follows from others.
  std::variant<std::vector<std::string>, Variable, Expression> values;
  std::vector<std::string> keys = {};  ///< all that get its value; empty: `key`
  std::optional<Correlation> correlation = {};
};

/// Among the keys of a parameter: its value is that of the option, a seed for all random joint sets.
inline constexpr const char* seed_option = "--seed";
/// Whether it is what a parameter gives its value to.
bool sets_seed_option(const Parameter& parameter);

/// The changes of the model that a value makes, as for --set.
std::vector<std::string> changes_of(const Parameter& parameter, const std::string& value);

/// Whether its values are the seeds of random numbers ("….seed", "--seed"): names of samples, which have no size.
bool is_seed(const Parameter& parameter);

/// A number of the command's document.
struct Result {
  std::string name, path;  ///< "totals.support_force"; lists by number from 0 (−1 the last) or name
};

/// "force > 1e6": comparisons of results and parameters with numbers, joined by `and`, `or` (`and` first).
struct Condition {
  enum class Operator { more, at_least, less, at_most, equal, other };
  struct Comparison {
    std::string name;
    Operator op;
    Real number;
  };
  std::vector<std::vector<Comparison>> any_of_all;
};

/// What a run says of an event where a result that would decide it has no number (null: "there is none").
enum class NullMeans { did_not_happen, left_out };
/// As in SWEEP.toml: "false", "exclude".
const char* null_name(NullMeans null);

struct Event {
  std::string name, text;
  Condition when;
  NullMeans null = NullMeans::did_not_happen;
};

enum class Sampling { all, latin_hypercube, monte_carlo };

struct SweepSpec {
  std::string path;   ///< of the SWEEP.toml
  std::string model;  ///< path, from where the program runs
  std::string command = "run";
  Sampling sampling = Sampling::all;
  Index runs = 0;  ///< of the latter two
  std::uint64_t seed = 1;
  Index workers = 0;      ///< 0: as many as cores
  Real time_limit = 0;    ///< s of wall time of a run; 0: none
  Real memory_limit = 0;  ///< bytes; 0: none
  std::vector<Parameter> parameters;
  std::vector<Result> results;
  std::vector<Event> events;
};

/// `path` is where the text stands. Throws Error(model) with all that is wrong in it, by line.
SweepSpec parse_sweep(const std::string& text, const std::string& path);

/// Throws Error(io) where the file cannot be read, Error(model) with all that is wrong in it, by line.
SweepSpec read_sweep(const std::string& path);

/// Throws std::invalid_argument with what was found and expected.
Condition parse_condition(const std::string& text);

}  // namespace rockfold::sweep
