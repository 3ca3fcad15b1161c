// Tables by bisection, expressions by muParser.
#include "mechanism/forces/time_function.hpp"

#include <algorithm>
#include <cmath>

#include <muParser.h>

#include "common/error.hpp"

namespace tisserand::mechanism {

struct TimeFunction::Expression {
  double t = 0.0;
  mu::Parser parser;
};

TimeFunction::TimeFunction(const formats::TimeFunctionSpec& spec) {
  if (const auto* constant = std::get_if<double>(&spec)) {
    constant_ = *constant;
  } else if (const auto* table = std::get_if<formats::TimeTable>(&spec)) {
    time_ = table->time;
    value_ = table->value;
  } else {
    const auto& text = std::get<formats::TimeExpression>(spec);
    expression_ = std::make_unique<Expression>();
    try {
      expression_->parser.DefineVar("t", &expression_->t);
      expression_->parser.DefineConst("pi", 3.14159265358979323846);
      expression_->parser.SetExpr(text.text);
      expression_->parser.Eval();
    } catch (const mu::Parser::exception_type& error) {
      throw Error(fmt::format("expression '{}': {}", text.text, error.GetMsg()), text.where,
                  "write a formula in t, for example \"10*sin(2*pi*t)\"");
    }
  }
}

TimeFunction::~TimeFunction() = default;
TimeFunction::TimeFunction(TimeFunction&&) noexcept = default;
TimeFunction& TimeFunction::operator=(TimeFunction&&) noexcept = default;

double TimeFunction::operator()(double t) {
  if (expression_) {
    expression_->t = t;
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

std::vector<double> breakpoints(const formats::TimeFunctionSpec& spec) {
  if (const auto* table = std::get_if<formats::TimeTable>(&spec)) return table->time;
  if (const auto* expression = std::get_if<formats::TimeExpression>(&spec)) return expression->breakpoints;
  return {};
}

}  // namespace tisserand::mechanism
