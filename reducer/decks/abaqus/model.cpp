// SPDX-License-Identifier: GPL-3.0-or-later
// Names of nodes and elements, and numbers of data lines.
#include "reducer/decks/abaqus/model.hpp"

#include <fmt/format.h>

namespace tisserand::reducer::abaqus {

std::string Model::node_text(int node) const {
  const std::string& scope = scopes[node_scopes[node]].name;
  return scope.empty() ? fmt::format("node {}", node_ids[node]) : fmt::format("node {}.{}", scope, node_ids[node]);
}

std::string Model::element_text(const RawElement& element) const {
  const std::string& scope = scopes[element.scope].name;
  return scope.empty() ? fmt::format("element {} ({})", element.id, element.type->name)
                       : fmt::format("element {}.{} ({})", scope, element.id, element.type->name);
}

bool read_numbers(Model& model, const Block& block, const Line& line, std::span<double> values) {
  const std::vector<std::string_view> fields = split(line.text);
  if (fields.size() > values.size()) {
    model.fault(
        fmt::format("{}: the line has {} values, expected at most {}", block.title, fields.size(), values.size()), line,
        "compare the line with the manual of the keyword");
    return false;
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].empty()) continue;
    const std::optional<double> value = to_number(fields[i]);
    if (!value) {
      model.fault(fmt::format("{}: '{}' is not a number", block.title, fields[i]), line, "write a finite number");
      return false;
    }
    values[i] = *value;
  }
  return true;
}

}  // namespace tisserand::reducer::abaqus
