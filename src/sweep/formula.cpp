#include "src/sweep/formula.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include <muParser.h>

namespace rockfold::sweep {

namespace {

template <typename Use>
auto parsed(const std::string& formula, Use use) {
  try {
    mu::Parser parser;
    parser.SetExpr(formula);
    return use(parser);
  } catch (const mu::Parser::exception_type& error) {
    throw std::invalid_argument(error.GetMsg());
  }
}

}  // namespace

bool is_name(const std::string& text) {
  const auto of_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), of_name);
}

std::vector<std::string> names_in(const std::string& formula) {
  return parsed(formula, [](mu::Parser& parser) {
    std::vector<std::string> names;
    for (const auto& [name, place] : parser.GetUsedVar()) names.push_back(name);
    // GetUsedVar() looks at the names alone.
    std::vector<Real> ones(names.size(), 1);
    for (std::size_t i = 0; i < names.size(); ++i) parser.DefineVar(names[i], &ones[i]);
    parser.Eval();
    return names;
  });
}

Real value_of(const std::string& formula, const std::map<std::string, Real>& names) {
  return parsed(formula, [&](mu::Parser& parser) {
    for (const auto& [name, value] : names) parser.DefineConst(name, value);
    return parser.Eval();
  });
}

}  // namespace rockfold::sweep
