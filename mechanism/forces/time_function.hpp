// Functions of time that loads use: a constant, a table or an expression.
#pragma once

#include <memory>
#include <vector>

#include "formats/scene.hpp"

namespace tisserand::mechanism {

/// Evaluates a formats::TimeFunctionSpec. Tables are linear between points and constant outside.
class TimeFunction {
 public:
  /// Throws Error at the place of the expression if it cannot be parsed. Its values may still not be finite: simulate()
  /// examines them at the start and where a step fails.
  explicit TimeFunction(const formats::TimeFunctionSpec& spec);
  ~TimeFunction();
  TimeFunction(TimeFunction&&) noexcept;
  TimeFunction& operator=(TimeFunction&&) noexcept;

  double operator()(double t);

 private:
  struct Expression;
  double constant_ = 0.0;
  std::vector<double> time_, value_;
  std::unique_ptr<Expression> expression_;
};

/// Instants at which the function or its derivative may jump.
std::vector<double> breakpoints(const formats::TimeFunctionSpec& spec);

}  // namespace tisserand::mechanism
