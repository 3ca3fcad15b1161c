// Formulas in text inputs: numbers from arithmetic over named values.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace tisserand::formats {

/// The value of a name in a formula, or nothing if there is none.
using NamedValues = std::function<std::optional<double>(const std::string& name)>;

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
