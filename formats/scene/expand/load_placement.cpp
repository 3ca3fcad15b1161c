// SPDX-License-Identifier: GPL-3.0-or-later
// Computes sums of scaled numbers, expressions and tables.
#include "formats/scene/expand/load_placement.hpp"

#include <cmath>

#include "formats/scene/expand/parameters.hpp"

namespace tisserand::formats {
namespace {

/// Limit of entries of a rotation that count as zero: round-off of angles such as 90 degrees.
constexpr double negligible = 1e-15;

bool is_zero(const YamlNode& function) {
  return looks_like_number(function) && std::strtod(function.text.c_str(), nullptr) == 0.0;
}

YamlNode scalar(const std::string& text, const YamlNode& like) {
  YamlNode node;
  node.kind = YamlKind::scalar;
  node.text = text;
  node.place = like.place;
  return node;
}

/// Multiplies the values of {table: [[t, f], ..]} by the factor.
void scale_table(const Context& context, double factor, YamlNode& table) {
  for (YamlNode& row : table.children)
    if (row.kind == YamlKind::sequence && row.children.size() == 2)
      row.children[1] = scalar(number_text(factor * read_number(context, row.children[1], "table")), row.children[1]);
}

/// A function of time multiplied by the factor.
YamlNode scaled(const Context& context, double factor, const YamlNode& function) {
  if (factor == 1.0) return function;
  if (looks_like_number(function))
    return scalar(number_text(factor * read_number(context, function, "value")), function);
  if (function.kind == YamlKind::scalar)
    return scalar(fmt::format("({}) * ({})", number_text(factor), function.text), function);
  YamlNode copy = function;
  if (YamlNode* text = find_child(copy, "expression")) {
    text->text = fmt::format("({}) * ({})", number_text(factor), text->text);
  } else if (YamlNode* table = find_child(copy, "table")) {
    scale_table(context, factor, *table);
  } else {
    context.fail(function.place, "this function of time cannot be rotated with its assembly",
                 "give a table or an expression, or give the load with axes: body");
  }
  return copy;
}

}  // namespace

void turn_components(const Context& context, const Eigen::Matrix3d& by, YamlNode& value) {
  if (value.kind != YamlKind::sequence || value.children.size() != 3) return;
  YamlNode turned = value;
  for (int i = 0; i < 3; ++i) {
    std::vector<YamlNode> terms;
    for (int k = 0; k < 3; ++k) {
      const YamlNode& function = value.children[k];
      if (std::abs(by(i, k)) > negligible && !is_zero(function)) terms.push_back(scaled(context, by(i, k), function));
    }
    YamlNode& component = turned.children[i];
    if (terms.empty()) {
      component = scalar("0", component);
    } else if (terms.size() == 1) {
      component = terms.front();
    } else {
      std::string sum;
      for (const YamlNode& term : terms) {
        if (term.kind != YamlKind::scalar)
          context.fail(term.place,
                       "the rotated assembly adds components of this load, and tables and files cannot be added",
                       "give expressions, or give the load with axes: body");
        sum += (sum.empty() ? "(" : " + (") + term.text + ")";
      }
      component = scalar(sum, component);
    }
  }
  value = std::move(turned);
}

}  // namespace tisserand::formats
