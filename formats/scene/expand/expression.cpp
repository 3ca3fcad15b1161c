// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates formulas by muParser. Only names that occur in a formula are looked up.
#include "formats/scene/expand/expression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <muParser.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/scene/expand/steps.hpp"

namespace tisserand::formats {
namespace {

constexpr std::size_t longest_formula = 10'000;
constexpr int deepest_brackets = 100;  // limit for the recursive parser
constexpr std::size_t most_remembered = 1000;

bool starts_name(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Calls `visit(begin, end)` for each name or number. An index such as `[3]` belongs to the name before it.
template <class Visit>
void for_each_word(const std::string& formula, Visit visit) {
  const auto in_word = [](char c) { return starts_name(c) || is_digit(c) || c == '.'; };
  for (std::size_t i = 0; i < formula.size();) {
    std::size_t end = i;
    while (end < formula.size() && in_word(formula[end])) {
      ++end;
      std::size_t close = end + 1;
      while (close < formula.size() && is_digit(formula[close])) ++close;
      if (end < formula.size() && formula[end] == '[' && close > end + 1 && close < formula.size() &&
          formula[close] == ']')
        end = close + 1;
    }
    if (end > i) visit(i, end);
    i = std::max(end, i + 1);
  }
}

void check_extent(const std::string& formula) {
  int depth = 0, deepest = 0;
  for (const char c : formula) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    deepest = std::max(deepest, depth);
  }
  if (formula.size() > longest_formula || deepest > deepest_brackets)
    throw Error(fmt::format("the expression has more than {} characters or {} nested brackets", longest_formula,
                            deepest_brackets),
                "", "split it into parameters");
}

/// A call of a smooth step with its constant arguments.
struct StepCall {
  std::string name;
  std::string variable;                                   ///< text of the first argument
  std::vector<std::pair<std::string, double>> arguments;  ///< text and value; NaN: not constant
};

/// Value of a formula of `t` alone, or NaN.
double value_at(const std::string& formula, double t) {
  mu::Parser parser;
  parser.DefineConst("pi", steps::pi);
  parser.DefineConst("t", t);
  steps::define(parser);
  try {
    parser.SetExpr(formula);
    return parser.Eval();
  } catch (const mu::Parser::exception_type&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// Value of a formula without variables, or NaN.
double constant_value(const std::string& formula) {
  const double value = value_at(formula, 0.0);
  return value == value_at(formula, 1.0) ? value : std::numeric_limits<double>::quiet_NaN();
}

std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '\n'; });
  return text;
}

/// All calls of smooth steps, also nested ones. Calls with another number of arguments are left to the parser.
std::vector<StepCall> step_calls(const std::string& formula) {
  std::vector<StepCall> calls;
  for_each_word(formula, [&](std::size_t begin, std::size_t end) {
    const std::string name = formula.substr(begin, end - begin);
    const bool trapezoid = name == "step_trapezoid";
    if (!trapezoid && name != "step5" && name != "step_cycloid" && name != "step_harmonic") return;
    std::size_t i = formula.find_first_not_of(' ', end);
    if (i == std::string::npos || formula[i] != '(') return;
    std::vector<std::string> arguments(1);
    for (int depth = 0; i < formula.size(); ++i) {
      const char c = formula[i];
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      if (depth == 0) break;
      if (depth == 1 && c == ',')
        arguments.emplace_back();
      else if (depth > 1 || c != '(')
        arguments.back() += c;
    }
    if (arguments.size() != (trapezoid ? 6U : 5U)) return;
    StepCall call{name, without_blanks(arguments[0]), {}};
    for (const std::string& text : arguments) call.arguments.emplace_back(without_blanks(text), constant_value(text));
    calls.push_back(std::move(call));
  });
  return calls;
}

/// Instant at which a − b is zero, if it is linear in `t` and has no other variable.
std::optional<double> crossing(const std::string& a, const std::string& b) {
  const std::string difference = "(" + a + ")-(" + b + ")";
  const double at_0 = value_at(difference, 0.0), slope = value_at(difference, 1.0) - at_0;
  if (!std::isfinite(at_0) || !std::isfinite(slope) || slope == 0.0) return {};
  for (const double t : {-3.0, 2.0, 17.0})
    if (!(std::abs(value_at(difference, t) - at_0 - slope * t) <= 1e-9 * (std::abs(at_0) + std::abs(slope * t))))
      return {};
  return -at_0 / slope;
}

/// Operand that ends before `at` (backwards) or begins there. It extends to an unmatched bracket or to an operator of
/// lower precedence than a comparison.
std::string operand(const std::string& formula, std::size_t at, bool backwards) {
  const char opens = backwards ? ')' : '(', closes = backwards ? '(' : ')';
  int depth = 0;
  std::string text;
  for (std::size_t i = at; i < formula.size(); i += backwards ? std::size_t(-1) : 1U) {
    const char c = formula[i];
    depth += c == opens ? 1 : c == closes ? -1 : 0;
    if (depth < 0 || (depth == 0 && std::string(",?:&|<>=!").find(c) != std::string::npos)) break;
    text.insert(backwards ? text.begin() : text.end(), c);
  }
  return text;
}

/// Instants at which comparisons of `t` change, and at which arguments of abs, sign, min and max cross.
std::vector<double> comparison_instants(const std::string& formula) {
  std::vector<double> instants;
  const auto note = [&instants](const std::optional<double>& instant) {
    if (instant) instants.push_back(*instant);
  };
  for (std::size_t i = 1; i + 1 < formula.size(); ++i) {
    const bool pair = formula[i + 1] == '=';  // <=, >=, ==, !=
    if (formula[i] != '<' && formula[i] != '>' && !(pair && (formula[i] == '=' || formula[i] == '!'))) continue;
    note(crossing(operand(formula, i - 1, true), operand(formula, i + (pair ? 2 : 1), false)));
    i += pair ? 1 : 0;
  }
  for_each_word(formula, [&](std::size_t begin, std::size_t end) {
    const std::string name = formula.substr(begin, end - begin);
    const std::size_t open = formula.find_first_not_of(' ', end);
    if (open == std::string::npos || formula[open] != '(') return;
    const std::string first = operand(formula, open + 1, false);
    if (name == "abs" || name == "sign") note(crossing(first, "0"));
    const std::size_t comma = open + 1 + first.size();
    if ((name == "min" || name == "max") && comma < formula.size() && formula[comma] == ',')
      note(crossing(first, operand(formula, comma + 1, false)));
  });
  return instants;
}

/// Fault of the first call of a function that does not exist, or empty.
std::string call_fault(const std::string& formula) {
  static const std::vector<std::string> known = formula_functions();
  std::string fault;
  for_each_word(formula, [&](std::size_t begin, std::size_t end) {
    const std::size_t next = formula.find_first_not_of(' ', end);
    if (!fault.empty() || !starts_name(formula[begin]) || next == std::string::npos || formula[next] != '(') return;
    const std::string name = formula.substr(begin, end - begin);
    if (std::ranges::find(known, name) == known.end())
      fault = fmt::format("there is no function '{}'; use one of {}", name, join(known, ", "));
  });
  return fault;
}

/// Fault of the first smooth step whose constant times or share are out of range, or empty.
std::string step_fault(const std::string& formula) {
  if (formula.find("step") == std::string::npos) return {};
  for (const StepCall& call : step_calls(formula)) {
    const auto& start = call.arguments[1];
    const auto& end = call.arguments[3];
    if (end.second <= start.second)
      return fmt::format("{}: its end t1 = {} must be later than its start t0 = {}", call.name, end.first, start.first);
    if (call.arguments.size() < 6) continue;
    const auto& [text, share] = call.arguments[5];
    if (share <= 0.0 || share > 0.5)
      return fmt::format("{}: the share {} of the time with acceleration must be greater than 0 and at most 0.5",
                         call.name, text);
  }
  return {};
}

}  // namespace

std::vector<double> corner_instants(const std::string& formula) {
  std::vector<double> instants = comparison_instants(formula);
  if (formula.find("step") == std::string::npos) return instants;
  for (const StepCall& call : step_calls(formula)) {
    const double t0 = call.arguments[1].second, t1 = call.arguments[3].second;
    if (call.variable != "t" || !std::isfinite(t0) || !std::isfinite(t1)) continue;
    instants.insert(instants.end(), {t0, t1});
    if (call.arguments.size() < 6 || !std::isfinite(call.arguments[5].second)) continue;
    const double ramp = call.arguments[5].second * (t1 - t0);
    instants.insert(instants.end(), {t0 + ramp, t1 - ramp});
  }
  return instants;
}

std::set<std::string> names_of(const std::string& formula) {
  std::set<std::string> names;
  for_each_word(formula, [&](std::size_t begin, std::size_t end) {
    if (starts_name(formula[begin])) names.insert(formula.substr(begin, end - begin));
  });
  return names;
}

std::string formula_fault(const std::string& formula) {
  std::vector<bool> is_call;  // for each open bracket
  char before = '\0';         // last character that is not blank
  for (std::size_t i = 0; i < formula.size(); ++i) {
    const char c = formula[i], next = i + 1 < formula.size() ? formula[i + 1] : '\0';
    if (c == '(') is_call.push_back(starts_name(before) || is_digit(before));
    if (c == ')' && !is_call.empty()) is_call.pop_back();
    if (c == ',' && (is_call.empty() || !is_call.back()))
      return "a comma may only separate arguments of a function; write decimals with a point: 2.5, not 2,5";
    const bool compares = next == '=' || before == '=' || before == '<' || before == '>' || before == '!';
    if (c == '=' && !compares) return "'=' cannot assign a value here; compare with ==, or write the value alone";
    if (c != ' ' && c != '\t') before = c;
  }
  const std::string fault = call_fault(formula);
  return fault.empty() ? step_fault(formula) : fault;
}

std::vector<std::string> formula_functions() {
  mu::Parser parser;
  steps::define(parser);
  std::vector<std::string> names;
  for (const auto& [name, function] : parser.GetFunDef()) names.push_back(name);
  return names;
}

std::string with_names(const std::string& formula, const std::function<std::string(const std::string&)>& replacement) {
  std::string text;
  std::size_t done = 0;
  for_each_word(formula, [&](std::size_t begin, std::size_t end) {
    const std::size_t next = formula.find_first_not_of(' ', end);
    if (!starts_name(formula[begin]) || (next != std::string::npos && formula[next] == '(')) return;
    text += formula.substr(done, begin - done) + replacement(formula.substr(begin, end - begin));
    done = end;
  });
  return text + formula.substr(done);
}

std::string expression_name(std::string path) {
  std::ranges::replace(path, '/', '.');
  return path;
}

using KnownValues = std::map<std::string, double>;

struct Calculator::Parser {
  mu::Parser parser;
  /// Inputs and result of the latest evaluation of each formula, since copies of an assembly repeat them.
  std::map<std::string, std::pair<KnownValues, double>> last;
};

Calculator::Calculator() : parser_(std::make_unique<Parser>()) {
  parser_->parser.DefineConst("pi", 3.14159265358979323846);
  steps::define(parser_->parser);
  parser_->parser.DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
}
Calculator::~Calculator() = default;

double Calculator::operator()(const std::string& formula, const NamedValues& values) {
  check_extent(formula);
  if (const std::string fault = formula_fault(formula); !fault.empty())
    throw Error(fmt::format("expression '{}': {}", formula, fault), "", "");
  KnownValues known;  // looked up before the parser is used: values may be formulas themselves
  for (const std::string& name : names_of(formula))
    if (const std::optional<double> value = values(name)) known[name] = *value;
  if (const auto same = parser_->last.find(formula); same != parser_->last.end() && same->second.first == known)
    return same->second.second;
  if (parser_->last.size() >= most_remembered) parser_->last.clear();
  mu::Parser& parser = parser_->parser;
  try {
    parser.ClearVar();
    for (auto& [name, value] : known) parser.DefineVar(name, &value);
    parser.SetExpr(formula);
    const double result = parser.Eval();
    parser.ClearVar();
    parser_->last[formula] = {std::move(known), result};
    return result;
  } catch (const mu::Parser::exception_type& error) {
    parser.ClearVar();
    throw Error(fmt::format("expression '{}': {}", formula, error.GetMsg()), "", "");
  }
}

}  // namespace tisserand::formats
