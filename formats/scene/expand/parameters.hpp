// SPDX-License-Identifier: GPL-3.0-or-later
// Named values of a scene and of its assemblies: `$name`, `${formula}` and text with both are replaced in the tree.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene/expand/expression.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

class ParameterScope;

/// Parameter: its value as written in the file, and the scope in which names in this value are searched. The value is
/// resolved when the parameter is first used.
struct Parameter {
  YamlNode given;
  ParameterScope* scope = nullptr;
  std::optional<YamlNode> value;
  bool resolving = false;
  bool used = false;
};

/// Parameters of one scene or instance. Names that it does not define are searched in the outer scope.
class ParameterScope {
 public:
  explicit ParameterScope(ParameterScope* outer) : outer_(outer) {}
  ParameterScope(const ParameterScope&) = delete;
  ParameterScope& operator=(const ParameterScope&) = delete;

  /// Defines the parameter `given` (key and value) and replaces an earlier definition. `scope`: scope of the names in
  /// its value.
  void define(const YamlNode& given, ParameterScope& scope) { own_[given.key] = {given, &scope, {}, false, false}; }
  /// Defines a parameter whose value is not a formula.
  void define(const std::string& name, const std::string& text);
  Parameter* find(const std::string& name);
  std::vector<std::string> names() const;
  std::map<std::string, Parameter>& own() { return own_; }
  const std::map<std::string, Parameter>& own() const { return own_; }

 private:
  ParameterScope* outer_;
  std::map<std::string, Parameter> own_;
};

/// Counts the values of an expanded scene, so that a few lines cannot fill the memory.
class ExpansionBudget {
 public:
  /// Counts `values` more values. Throws Error at `where` if the total exceeds `most_values`.
  void take(std::size_t values, const std::string& where);

 private:
  static constexpr std::size_t most_values = 3'000'000;
  std::size_t taken_ = 0;
};

/// Replaces parameters in a tree by their values.
class Substitution {
 public:
  Substitution(const YamlDocument& document, ExpansionBudget& budget) : document_(document), budget_(budget) {}

  /// Replaces parameters in the node and in everything below it. A scalar `$name` becomes the parameter's value (a
  /// scalar, list or map), with its place. A scalar `${formula}` becomes a number. Within other text, `$name` and
  /// `${formula}` become text. Throws Error.
  void apply(YamlNode& node, ParameterScope& scope);

 private:
  const YamlNode& value_of(Parameter& parameter, const YamlPlace& place);
  const YamlNode& value_of(const std::string& name, ParameterScope& scope, const YamlPlace& place);
  double number_of(const std::string& formula, ParameterScope& scope, const YamlPlace& place);
  std::optional<double> named_number(const std::string& name, ParameterScope& scope, const YamlPlace& place);
  std::string text_of(const std::string& inner, ParameterScope& scope, const YamlPlace& place);
  void replace_scalar(YamlNode& node, ParameterScope& scope);
  std::string interpolate(const YamlNode& node, ParameterScope& scope);
  [[noreturn]] void fail(const YamlPlace& place, const std::string& what, const std::string& remedy) const;

  const YamlDocument& document_;
  ExpansionBudget& budget_;
  Calculator calculator_;
  int depth_ = 0;
};

/// Shortest text that reads back as the same number.
std::string number_text(double value);

}  // namespace tisserand::formats
