// SPDX-License-Identifier: GPL-3.0-or-later
// Tables by bisection, expressions by muParser.
#include "mechanism/forces/time_function.hpp"

#include <algorithm>
#include <cmath>

#include <muParser.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/scene/expand/expression.hpp"
#include "formats/scene/expand/steps.hpp"

namespace tisserand::mechanism {

struct TimeFunction::Expression {
  struct UsedInput {
    std::shared_ptr<const Input> input;
    std::size_t variable;
  };
  double t = 0.0;
  std::vector<double> variables;  ///< inputs, then channels in use; the parser holds pointers to them
  std::vector<UsedInput> inputs;
  mu::Parser parser;
};

namespace {

std::string what_may_stand(const ExpressionScope& scope) {
  std::vector<std::string> names;
  for (const auto& input : scope.inputs) names.push_back(input->name);
  names.insert(names.end(), scope.channels.begin(), scope.channels.end());
  if (names.empty()) return "write a formula in t, for example \"10*sin(2*pi*t)\"";
  return "write a formula in t and " + listed(names);
}

}  // namespace

void TimeFunction::compile(const formats::TimeExpression& text, const ExpressionScope& scope) {
  expression_ = std::make_unique<Expression>();
  Expression& e = *expression_;
  if (const std::string fault = formats::formula_fault(text.text); !fault.empty())
    throw Error(fmt::format("expression '{}': {}", text.text, fault), text.where, what_may_stand(scope));
  const std::set<std::string> words = formats::names_of(text.text);
  std::vector<std::string> names;
  for (const auto& input : scope.inputs) {
    if (!words.contains(input->name)) continue;
    e.inputs.push_back({input, names.size()});
    names.push_back(input->name);
  }
  for (int i = 0; i < std::ssize(scope.channels); ++i) {
    if (!words.contains(scope.channels[i])) continue;
    channels_.push_back(i);
    names.push_back(scope.channels[i]);
  }
  e.variables.assign(names.size(), 0.0);
  try {
    e.parser.DefineNameChars("0123456789_.[]abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    e.parser.DefineVar("t", &e.t);
    e.parser.DefineConst("pi", formats::steps::pi);
    formats::steps::define(e.parser);
    for (std::size_t i = 0; i < names.size(); ++i) e.parser.DefineVar(names[i], &e.variables[i]);
    e.parser.SetExpr(text.text);
    e.parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw Error(fmt::format("expression '{}': {}", text.text, error.GetMsg()), text.where, what_may_stand(scope));
  }
  breakpoints_ = text.breakpoints;
  for (const double instant : formats::corner_instants(text.text)) breakpoints_.push_back(instant);
  for (const Expression::UsedInput& used : e.inputs)
    breakpoints_.insert(breakpoints_.end(), used.input->breakpoints.begin(), used.input->breakpoints.end());
}

TimeFunction::TimeFunction(const formats::TimeFunctionSpec& spec, const ExpressionScope& scope) {
  if (const auto* constant = std::get_if<double>(&spec)) {
    constant_ = *constant;
  } else if (const auto* table = std::get_if<formats::TimeTable>(&spec)) {
    time_ = breakpoints_ = table->time;
    value_ = table->value;
  } else {
    compile(std::get<formats::TimeExpression>(spec), scope);
  }
}

TimeFunction::~TimeFunction() = default;
TimeFunction::TimeFunction(TimeFunction&&) noexcept = default;
TimeFunction& TimeFunction::operator=(TimeFunction&&) noexcept = default;

double TimeFunction::operator()(double t) {
  if (expression_) {
    expression_->t = t;
    for (const Expression::UsedInput& used : expression_->inputs)
      expression_->variables[used.variable] = (*used.input)(t);
    return expression_->parser.Eval();
  }
  if (time_.empty()) return constant_;
  if (t <= time_.front()) return value_.front();
  if (t >= time_.back()) return value_.back();
  const auto next = std::upper_bound(time_.begin(), time_.end(), t);
  const auto i = static_cast<std::size_t>(next - time_.begin());
  const double s = (t - time_[i - 1]) / (time_[i] - time_[i - 1]);
  return (1.0 - s) * value_[i - 1] + s * value_[i];
}

void TimeFunction::set_channels(const Eigen::VectorXd& values) {
  for (std::size_t i = 0; i < channels_.size(); ++i)
    expression_->variables[expression_->inputs.size() + i] = values[channels_[i]];
}

double TimeFunction::derivative(std::size_t argument, double t) {
  double& x = expression_->variables[expression_->inputs.size() + argument];
  const double at = x, d = 6e-6 * std::max(std::abs(at), 1e-3);
  x = at + d;
  const double ahead = (*this)(t), above = x;
  x = at - d;
  const double behind = (*this)(t), below = x;
  x = at;
  return (ahead - behind) / (above - below);
}

}  // namespace tisserand::mechanism
