// SPDX-License-Identifier: GPL-3.0-or-later
// Looks up parameters, each resolved once, and replaces them in formulas and text.
#include "formats/scene/expand/parameters.hpp"

#include <cmath>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/yaml/name_check.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {
namespace {

constexpr int longest_reference = 50;  ///< limit of a chain of parameters

bool is_name_character(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

/// Piece of a text: literal text, or the inside of ${..} or of $name.
struct Piece {
  bool replaced = false;
  bool braces = false;
  std::string text;
};

/// Splits "a$b${c}$$d" -> a, [b], [c], "$d". Nothing if a brace is not closed or no name follows a $.
std::optional<std::vector<Piece>> pieces_of(const std::string& text) {
  std::vector<Piece> pieces;
  std::string plain;
  const auto flush = [&] {
    if (!plain.empty()) pieces.push_back({false, false, plain});
    plain.clear();
  };
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      plain += text[i++];
    } else if (text.compare(i, 2, "$$") == 0) {
      plain += '$';
      i += 2;
    } else if (text.compare(i, 2, "${") == 0) {
      const std::size_t end = text.find('}', i);
      if (end == std::string::npos) return std::nullopt;
      flush();
      pieces.push_back({true, true, text.substr(i + 2, end - i - 2)});
      i = end + 1;
    } else {
      std::size_t end = i + 1;
      while (end < text.size() && is_name_character(text[end])) ++end;
      if (end == i + 1) return std::nullopt;
      flush();
      pieces.push_back({true, false, text.substr(i + 1, end - i - 1)});
      i = end;
    }
  }
  flush();
  return pieces;
}

bool is_plain_name(const std::string& text) {
  bool plain = !text.empty() && !(text[0] >= '0' && text[0] <= '9');
  for (const char c : text) plain = plain && is_name_character(c);
  return plain;
}

/// Marks a parameter during its resolution, also if that throws.
class Resolving {
 public:
  Resolving(Parameter& parameter, int& depth) : parameter_(parameter), depth_(depth) {
    parameter_.resolving = true;
    ++depth_;
  }
  ~Resolving() {
    parameter_.resolving = false;
    --depth_;
  }
  Resolving(const Resolving&) = delete;
  Resolving& operator=(const Resolving&) = delete;

 private:
  Parameter& parameter_;
  int& depth_;
};

std::optional<double> number_in(const YamlNode& node) {
  if (!looks_like_number(node)) return std::nullopt;
  return std::strtod(node.text.c_str(), nullptr);
}

}  // namespace

std::string number_text(double value) { return fmt::format("{}", value); }

void ParameterScope::define(const std::string& name, const std::string& text) {
  YamlNode node;
  node.kind = YamlKind::scalar;
  node.key = name;
  node.text = text;
  Parameter parameter{node, this, node, false, false};
  own_[name] = std::move(parameter);
}

Parameter* ParameterScope::find(const std::string& name) {
  const auto found = own_.find(name);
  if (found != own_.end()) return &found->second;
  return outer_ == nullptr ? nullptr : outer_->find(name);
}

std::vector<std::string> ParameterScope::names() const {
  std::vector<std::string> names = outer_ == nullptr ? std::vector<std::string>{} : outer_->names();
  for (const auto& [name, parameter] : own_) names.push_back(name);
  return names;
}

void ExpansionBudget::take(std::size_t values, const std::string& where) {
  taken_ += values;
  if (taken_ > most_values)
    throw Error(fmt::format("the scene has more than {} values after its instances are expanded", most_values), where,
                "use fewer or smaller instances");
}

void Substitution::fail(const YamlPlace& place, const std::string& what, const std::string& remedy) const {
  throw Error(what, document_.where(place), remedy);
}

const YamlNode& Substitution::value_of(Parameter& parameter, const YamlPlace& place) {
  parameter.used = true;
  if (parameter.value) return *parameter.value;
  if (parameter.resolving)
    fail(parameter.given.key_place, fmt::format("parameter '{}' refers to itself", parameter.given.key),
         "give it a value that does not depend on this parameter");
  if (depth_ >= longest_reference)
    fail(place, fmt::format("parameters refer to one another more than {} levels deep", longest_reference), "");
  const Resolving guard(parameter, depth_);
  YamlNode value = parameter.given;
  apply(value, *parameter.scope);
  parameter.value = std::move(value);
  return *parameter.value;
}

const YamlNode& Substitution::value_of(const std::string& name, ParameterScope& scope, const YamlPlace& place) {
  Parameter* parameter = scope.find(name);
  if (parameter != nullptr) return value_of(*parameter, place);
  const std::vector<std::string> known = scope.names();
  fail(place, fmt::format("there is no parameter '{}'", name),
       did_you_mean(name, known,
                    known.empty() ? "define it under `parameters`, or write $$ for the character $"
                                  : fmt::format("use one of {}", listed(known))));
}

std::optional<double> Substitution::named_number(const std::string& name, ParameterScope& scope,
                                                 const YamlPlace& place) {
  if (Parameter* parameter = scope.find(name)) {
    const YamlNode& value = value_of(*parameter, place);
    const std::optional<double> number = number_in(value);
    if (!number) {
      const bool vector = value.kind == YamlKind::sequence && value.children.size() == 3;
      fail(place, fmt::format("parameter '{}' is {}, not a number", name, describe(value)),
           vector ? fmt::format("write {0}.x, {0}.y or {0}.z", name) : "");
    }
    return number;
  }
  const std::size_t point = name.rfind('.');
  if (point == std::string::npos || point + 2 != name.size()) return std::nullopt;
  const std::size_t index = std::string("xyz").find(name.back());
  Parameter* parameter = scope.find(name.substr(0, point));
  if (index == std::string::npos || parameter == nullptr) return std::nullopt;
  const YamlNode& value = value_of(*parameter, place);
  const bool vector = value.kind == YamlKind::sequence && value.children.size() == 3;
  const std::optional<double> number = vector ? number_in(value.children[index]) : std::nullopt;
  if (!number)
    fail(place, fmt::format("parameter '{}' is {}, not a vector", name.substr(0, point), describe(value)), "");
  return number;
}

double Substitution::number_of(const std::string& formula, ParameterScope& scope, const YamlPlace& place) {
  double value = 0.0;
  try {
    value = calculator_(formula, [&](const std::string& name) { return named_number(name, scope, place); });
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    const std::vector<std::string> known = scope.names();
    fail(place, error.message(),
         !error.remedy().empty() ? error.remedy()
         : known.empty()         ? ""
                                 : fmt::format("parameters here are {}", listed(known)));
  }
  if (!std::isfinite(value)) fail(place, fmt::format("expression '{}' is {}, not a finite number", formula, value), "");
  return value;
}

std::string Substitution::text_of(const std::string& inner, ParameterScope& scope, const YamlPlace& place) {
  if (is_plain_name(inner) && scope.find(inner) != nullptr) {
    const YamlNode& value = value_of(inner, scope, place);
    if (value.kind != YamlKind::scalar)
      fail(place, fmt::format("parameter '{}' is {}, not a number or text", inner, describe(value)),
           "write it alone, without other text, or give it a number or text");
    return value.text;
  }
  return number_text(number_of(inner, scope, place));
}

std::string Substitution::interpolate(const YamlNode& node, ParameterScope& scope) {
  const auto pieces = pieces_of(node.text);
  if (!pieces)
    fail(node.place, fmt::format("a $ in {} is not followed by a name or a {{formula}}", describe(node)),
         "write $$ for the character $");
  std::string text;
  for (const Piece& piece : *pieces) {
    if (piece.replaced && !piece.braces) (void)value_of(piece.text, scope, node.place);
    text += piece.replaced ? text_of(piece.text, scope, node.place) : piece.text;
  }
  constexpr std::size_t longest_text = 100'000;
  if (text.size() > longest_text)
    fail(node.place,
         fmt::format("the text has more than {} characters after its parameters are replaced", longest_text), "");
  return text;
}

void Substitution::replace_scalar(YamlNode& node, ParameterScope& scope) {
  const auto pieces = pieces_of(node.text);
  const bool alone = pieces && pieces->size() == 1 && pieces->front().replaced;
  if (alone && is_plain_name(pieces->front().text) &&
      (!pieces->front().braces || scope.find(pieces->front().text) != nullptr)) {
    YamlNode value = value_of(pieces->front().text, scope, node.place);
    budget_.take(count_nodes(value), document_.where(node.place));
    value.key = std::move(node.key);
    value.key_place = node.key_place;
    if (value.place.line == 0) value.place = node.place;  // a value that is not from a file
    node = std::move(value);
  } else if (alone) {
    node.text = number_text(number_of(pieces->front().text, scope, node.place));
    node.quoted = false;
  } else {
    node.text = interpolate(node, scope);
  }
}

void Substitution::apply(YamlNode& node, ParameterScope& scope) {
  if (node.kind == YamlKind::scalar && node.text.find('$') != std::string::npos) {
    replace_scalar(node, scope);
    return;
  }
  for (YamlNode& child : node.children) apply(child, scope);
}

}  // namespace tisserand::formats
