// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas in text inputs: arithmetic over named values.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tisserand::formats {

/// Function that returns the value of a name in a formula, or nothing for an unknown name.
using NamedValues = std::function<std::optional<double>(const std::string& name)>;

/// Names in a formula, including functions and paths such as `corner_fl.speed`, `link[3].speed` or `arm.x`. The
/// exponent of a number (1e5) is no name.
std::set<std::string> names_of(const std::string& formula);

/// Fault of a formula, as a sentence with the remedy; empty if there is none. It finds faults that muParser accepts
/// silently: an assignment ("t=5" is 5), a stray comma ("2,5*t" is 5*t), a smooth step (steps.hpp) with invalid
/// constant arguments. It also finds calls of unknown functions, for which muParser does not list the known ones.
std::string formula_fault(const std::string& formula);

/// Names of all functions that formulas may call.
std::vector<std::string> formula_functions();

/// Instants at which a formula of time `t` jumps or has a corner. Requires a formula without fault. They are: begin,
/// end and change of law of smooth steps in `t` with constant times; switching instants of comparisons linear in `t` (t
/// > 1, t - 2 <= 0.5); crossings of the arguments of abs, sign, min and max.
std::vector<double> corner_instants(const std::string& formula);

/// The formula with `replacement` applied to every name that no opening bracket follows (names of functions stay).
std::string with_names(const std::string& formula, const std::function<std::string(const std::string&)>& replacement);

/// Name of an input or channel as expressions write it: `link[3]/speed` is `link[3].speed`.
std::string expression_name(std::string path);

/// Evaluates formulas in the notation of muParser, with the constant `pi`. Names may contain points: `arm.x`.
class Calculator {
 public:
  Calculator();
  ~Calculator();
  Calculator(const Calculator&) = delete;
  Calculator& operator=(const Calculator&) = delete;

  /// Value of the formula. Throws Error that names no place: "expression '2*': unexpected end ..".
  double operator()(const std::string& formula, const NamedValues& values);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace tisserand::formats
