// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of time for loads: a constant, a table or an expression, which may use inputs and channels.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/forces/expression_scope.hpp"

namespace tisserand::mechanism {

/// Function of time for loads: a constant, a table or an expression of a formats::TimeFunctionSpec. Tables are linear
/// between points and constant outside. Expressions may use the inputs of the scope at the same t, and its channels
/// with the last values from set_channels().
class TimeFunction {
 public:
  /// Compiles the function. Throws Error at the place of the expression if it cannot be parsed. Values of the function
  /// may still not be finite; simulate() checks them at the start and where a step fails.
  TimeFunction(const formats::TimeFunctionSpec& spec, const ExpressionScope& scope);
  explicit TimeFunction(const formats::TimeFunctionSpec& spec) : TimeFunction(spec, ExpressionScope{}) {}
  ~TimeFunction();
  TimeFunction(TimeFunction&&) noexcept;
  TimeFunction& operator=(TimeFunction&&) noexcept;

  double operator()(double t);

  /// Channels that the expression uses, as indices in ExpressionScope::channels.
  const std::vector<int>& channels() const { return channels_; }
  /// Sets the channels that the expression uses. `values`: values of all channels of the scope.
  void set_channels(const Eigen::VectorXd& values);
  /// Derivative of the function by the channel channels()[argument], a central difference with a spacing of 6e-6 of the
  /// value of the channel, at least 6e-9. The relative error is 1e-10 and affects only the convergence of Newton's
  /// iteration.
  double derivative(std::size_t argument, double t);

  /// Instants at which the function or its derivative may jump.
  const std::vector<double>& breakpoints() const { return breakpoints_; }

 private:
  struct Expression;
  void compile(const formats::TimeExpression& text, const ExpressionScope& scope);

  double constant_ = 0.0;
  std::vector<double> time_, value_;
  std::vector<int> channels_;
  std::vector<double> breakpoints_;
  std::unique_ptr<Expression> expression_;
};

}  // namespace tisserand::mechanism
