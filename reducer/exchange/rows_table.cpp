// SPDX-License-Identifier: GPL-3.0-or-later
// Keys and places from the lines of the table of rows, and the reverse.
#include "reducer/exchange/rows_table.hpp"

#include <array>
#include <optional>

#include <fmt/format.h>

#include "common/error.hpp"
#include "formats/yaml/name_check.hpp"
#include "reducer/decks/nastran/cards.hpp"
#include "reducer/decks/nastran/fields.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr std::array<const char*, 6> component_words{"x", "y", "z", "rx", "ry", "rz"};
constexpr const char* mode_word = "mode";
constexpr const char* heading = "row,node,component,x,y,z";

/// Component 0 to 5 or scalar_component; empty for other words.
std::optional<int> component_of(std::string_view cell) {
  if (same_word(cell, mode_word)) return scalar_component;
  for (int k = 0; k < std::ssize(component_words); ++k)
    if (same_word(cell, component_words[k])) return k;
  const std::optional<long> number = parse_integer(cell);
  if (number && *number >= 1 && *number <= 6) return static_cast<int>(*number) - 1;
  return std::nullopt;
}

struct RowReader {
  const TextLines& lines;
  ReducedMatrices& matrices;
  std::map<std::string, long> number_of_name;

  void row(const std::vector<std::string_view>& cells);
  long node(const std::vector<std::string_view>& cells);
};

/// Number of the node, from 1 in the order of the table. Its place is entered once and must not change.
long RowReader::node(const std::vector<std::string_view>& cells) {
  const std::optional<long> number = parse_integer(cells[1]);
  const std::string name = number ? fmt::format("n{}", *number) : std::string(cells[1]);
  if (!formats::is_name(name))
    throw Error(fmt::format("'{}' is not a valid name of a node", shown(cells[1])), lines.where(),
                "begin with a letter or _ and use letters, digits, _ and -; or give a whole number");
  NodePlace place;
  place.name = name;
  if (cells.size() != 6)
    throw Error(fmt::format("has {} cells, expected 6: {}", cells.size(), heading), lines.where(), "complete the line");
  for (std::size_t k = 0; k < 3; ++k) place.position[k] = number_of(cells[k + 3], "a coordinate", lines);
  const auto [found, is_new] = number_of_name.emplace(name, static_cast<long>(number_of_name.size()) + 1);
  if (is_new)
    matrices.places.emplace(found->second, place);
  else if (matrices.places.at(found->second).position != place.position)
    throw Error(fmt::format("node '{}' had a different position in an earlier row", name), lines.where(),
                "give the node the same position in all its rows");
  return found->second;
}

void RowReader::row(const std::vector<std::string_view>& cells) {
  const std::size_t expected = matrices.rows.size() + 1;
  if (cells.size() < 3)
    throw Error(fmt::format("has {} cells, expected 6: {}", cells.size(), heading), lines.where(), "complete the line");
  if (integer_of(cells[0], "the number of the row", lines) != static_cast<long>(expected))
    throw Error(fmt::format("the number of the row is {}, expected {}", shown(cells[0]), expected), lines.where(),
                "give the rows in order, from 1");
  if (expected > most_rows)
    throw Error(fmt::format("more than {} rows", most_rows), lines.where(), "give reduced matrices");
  const std::optional<int> component = component_of(cells[2]);
  if (!component)
    throw Error(fmt::format("component '{}', expected x, y, z, rx, ry, rz or mode", shown(cells[2])), lines.where(),
                "correct the component");
  if (*component == scalar_component)
    matrices.rows.push_back({static_cast<long>(expected), scalar_component});
  else
    matrices.rows.push_back({node(cells), *component});
}

}  // namespace

ReducedMatrices read_rows(const std::string& format, const TabledFiles& files) {
  ReducedMatrices matrices;
  matrices.format = format;
  matrices.source = files.stiffness;
  TextLines lines(files.rows);
  RowReader reader{lines, matrices, {}};
  std::string_view line;
  bool first = true;
  while (lines.next(line)) {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::vector<std::string_view> cells = cells_of(line);
    const bool is_heading = first && same_word(cells[0], "row");
    first = false;
    if (!is_heading) reader.row(cells);
  }
  if (matrices.rows.empty()) throw Error("has no rows", files.rows, fmt::format("give lines with {}", heading));
  return matrices;
}

std::string rows_text(const formats::Superelement& element) {
  std::string text = fmt::format("{}\n", heading);
  for (std::size_t i = 0; i < element.dof_node.size(); ++i) {
    const int node = element.dof_node[i];
    if (node < 0) {
      text += fmt::format("{},,{},,,\n", i + 1, mode_word);
      continue;
    }
    const Eigen::RowVector3d x = element.node_position.row(node);
    text += fmt::format("{},{},{},{:.17g},{:.17g},{:.17g}\n", i + 1, element.node_name[node],
                        component_words[element.dof_component[i]], x[0], x[1], x[2]);
  }
  return text;
}

}  // namespace tisserand::reducer::exchange
