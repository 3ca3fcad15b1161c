// Formulas in text inputs: numbers from arithmetic over named values.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tisserand::formats {

/// The value of a name in a formula, or nothing if there is none.
using NamedValues = std::function<std::optional<double>(const std::string& name)>;

/// The names of a formula, also functions and paths such as `corner_fl.speed`, `link[3].speed` or `arm.x`; not the
/// exponents of its numbers (1e5).
std::set<std::string> names_of(const std::string& formula);

/// What muParser would take in silence: an assignment ("t=5" is 5), a comma that separates no arguments of a function
/// ("2,5*t" is 5*t), and smooth steps (steps.hpp) whose constant arguments are none; and calls of functions that do not
/// exist, which it reports without those that do. A sentence with the remedy, or empty.
std::string formula_fault(const std::string& formula);

/// Names of all functions that formulas may call.
std::vector<std::string> formula_functions();

/// Instants at which a formula of time jumps or has a corner: where smooth steps in `t` with constant times begin, end, or
/// change between acceleration and constant rate, where a comparison of what is linear in `t` changes (t > 1, t - 2 <= 0.5),
/// and where arguments of abs, sign, min and max cross so. The formula has no fault.
std::vector<double> corner_instants(const std::string& formula);

/// The formula with every name that no bracket follows replaced by what `replacement` makes of it.
std::string with_names(const std::string& formula, const std::function<std::string(const std::string&)>& replacement);

/// How expressions write the name of an input or channel: `link[3]/speed` is `link[3].speed`.
std::string expression_name(std::string path);

/// Evaluates formulas in the notation of muParser, with `pi`. Names may hold points: `arm.x`.
class Calculator {
 public:
  Calculator();
  ~Calculator();
  Calculator(const Calculator&) = delete;
  Calculator& operator=(const Calculator&) = delete;

  /// Throws Error without a place: "expression '2*': unexpected end ..".
  double operator()(const std::string& formula, const NamedValues& values);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace tisserand::formats
