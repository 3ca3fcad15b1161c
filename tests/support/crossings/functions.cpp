// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions with other names for time and channels; curves with other factors.
#include "tests/support/crossings/functions.hpp"

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace tisserand::test_support::crossings {

using formats::TimeFunctionSpec;

namespace {

/// The number that an expression finds under the name of a channel, now over then.
double channel_factor(const formats::Scene& scene, const formats::ChannelSpec& channel, const Similarity& s) {
  switch (channel.kind) {
    case formats::ChannelKind::coordinate:
      return coordinate_factor(scene, channel.coordinate.name, s).whole();
    case formats::ChannelKind::rate:
      return coordinate_factor(scene, channel.coordinate.name, s).whole() / s.time;
    case formats::ChannelKind::velocity:
      return s.length / s.time;
    case formats::ChannelKind::position:
    case formats::ChannelKind::distance:
      return s.length;
    case formats::ChannelKind::tyre:
      break;
  }
  throw std::logic_error("channel of a tyre");
}

std::string name_now(const std::string& name, const formats::Scene& scene, const Similarity& s) {
  if (name == "t") return fmt::format("((t - {:.17g})/{:.17g})", s.delay, s.time);
  for (const formats::ChannelSpec& channel : scene.channels)
    if (channel.name == name) return fmt::format("({}/{:.17g})", name, channel_factor(scene, channel, s));
  return name;
}

/// The text with other names; numbers such as 1e3 hold no name.
std::string text_now(const std::string& text, const formats::Scene& scene, const Similarity& s) {
  static const std::regex token(R"([0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?|[A-Za-z_][A-Za-z0-9_]*)");
  std::string result;
  auto last = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), token); at != std::sregex_iterator(); ++at) {
    result.append(last, (*at)[0].first);
    result += name_now(at->str(), scene, s);
    last = (*at)[0].second;
  }
  return result.append(last, text.cend());
}

}  // namespace

formats::LawSpec law(const formats::LawSpec& law, double x_factor, double y_factor) {
  if (const double* constant = std::get_if<double>(&law)) return *constant * y_factor / x_factor;
  formats::CurveSpec curve = std::get<formats::CurveSpec>(law);
  for (double& x : curve.x) x *= x_factor;
  for (double& y : curve.y) y *= y_factor;
  if (x_factor < 0.0) {
    std::reverse(curve.x.begin(), curve.x.end());
    std::reverse(curve.y.begin(), curve.y.end());
  }
  return curve;
}

TimeFunctionSpec rewritten(const TimeFunctionSpec& f, double factor, const formats::Scene& scene, const Similarity& s) {
  if (const double* constant = std::get_if<double>(&f)) return factor * *constant;
  if (const formats::TimeTable* given = std::get_if<formats::TimeTable>(&f)) {
    formats::TimeTable table = *given;
    for (double& t : table.time) t = s.time * t + s.delay;
    for (double& y : table.value) y *= factor;
    return table;
  }
  formats::TimeExpression expression = std::get<formats::TimeExpression>(f);
  expression.text = fmt::format("{:.17g}*({})", factor, text_now(expression.text, scene, s));
  for (double& t : expression.breakpoints) t = s.time * t + s.delay;
  return expression;
}

std::array<TimeFunctionSpec, 3> combined(const std::array<TimeFunctionSpec, 3>& f, const Eigen::Matrix3d& matrix,
                                         const formats::Scene& scene, const Similarity& s) {
  std::array<TimeFunctionSpec, 3> result;
  for (int i = 0; i < 3; ++i) {
    formats::TimeExpression sum;
    double constant = 0.0;
    for (int j = 0; j < 3; ++j) {
      if (matrix(i, j) == 0.0) continue;
      const TimeFunctionSpec term = rewritten(f[j], matrix(i, j), scene, s);
      if (const double* number = std::get_if<double>(&term)) {
        constant += *number;
      } else if (const formats::TimeExpression* expression = std::get_if<formats::TimeExpression>(&term)) {
        sum.text += (sum.text.empty() ? "" : " + ") + expression->text;
        sum.breakpoints.insert(sum.breakpoints.end(), expression->breakpoints.begin(), expression->breakpoints.end());
      } else {
        throw std::logic_error("a table in a load with axes of the world");
      }
    }
    std::sort(sum.breakpoints.begin(), sum.breakpoints.end());
    sum.breakpoints.erase(std::unique(sum.breakpoints.begin(), sum.breakpoints.end()), sum.breakpoints.end());
    if (sum.text.empty())
      result[i] = constant;
    else
      result[i] = formats::TimeExpression{fmt::format("{} + {:.17g}", sum.text, constant), sum.breakpoints, ""};
  }
  return result;
}

}  // namespace tisserand::test_support::crossings
