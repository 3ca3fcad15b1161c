// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices from linear user elements and node-component lists.
#include "reducer/exchange/abaqus_matrix.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/decks/abaqus/lines.hpp"
#include "reducer/decks/nastran/cards.hpp"
#include "reducer/decks/nastran/fields.hpp"
#include "reducer/exchange/places.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

/// Key of a row. Components of Abaqus are 1 to 6; rows of modes may have any number.
RowKey make_key(long node, long component, const std::set<long>& modal, const std::string& where) {
  const bool internal = node < 0 || modal.contains(node);
  if (node == 0 || component < 1 || (!internal && component > 6) || component > 1000)
    throw Error(fmt::format("component {} of node {}, expected 1 to 6", component, node), where,
                "give displacements and rotations only, or use --modal to name the nodes that carry modes");
  return {node, static_cast<int>(component) - 1};
}

/// Node numbers in the comment lines after the comment "** ELEMENT NODES".
std::vector<long> commented_nodes(TextLines& lines) {
  std::vector<long> nodes;
  std::string_view line;
  bool inside = false;
  while (lines.next(line)) {
    const bool comment = line.substr(0, 2) == "**";
    const std::vector<std::string_view> words = comment ? words_of(line.substr(2)) : std::vector<std::string_view>();
    if (inside) {
      if (words.empty() ||
          !std::all_of(words.begin(), words.end(), [](auto w) { return parse_integer(w).has_value(); }))
        return nodes;
      for (const std::string_view word : words) nodes.push_back(*parse_integer(word));
    } else if (words.size() == 2 && same_word(words[0], "ELEMENT") && same_word(words[1], "NODES")) {
      inside = true;
    }
  }
  return nodes;
}

const abaqus::Block* only(const abaqus::Input& input, const std::string& keyword) {
  const abaqus::Block* found = nullptr;
  for (const abaqus::Block& block : input.blocks) {
    if (block.keyword != keyword) continue;
    if (found != nullptr)
      throw Error(fmt::format("the file has a second {}", block.title), input.where(block),
                  "give one user element per file");
    found = &block;
  }
  return found;
}

long whole(std::string_view field, const abaqus::Input& input, const abaqus::Line& line) {
  if (const std::optional<long> value = abaqus::to_integer(field)) return *value;
  throw Error(fmt::format("'{}' is not a whole number", shown(field)), input.where(line), "correct the number");
}

/// Node numbers of the only element, from its comment or *ELEMENT.
std::vector<long> element_nodes(const abaqus::Input& input, const abaqus::Block& user, const std::string& path) {
  const std::string* text = user.find("NODES");
  const std::optional<long> count = text == nullptr ? std::nullopt : abaqus::to_integer(*text);
  if (!count || *count < 1 || *count > static_cast<long>(most_rows))
    throw Error(fmt::format("NODES={}, expected 1 to {}", text == nullptr ? "" : shown(*text), most_rows),
                input.where(user), "write *USER ELEMENT, NODES=number, LINEAR");
  TextLines lines(path);
  std::vector<long> nodes = commented_nodes(lines);
  if (const abaqus::Block* element = only(input, "ELEMENT"); nodes.empty() && element != nullptr) {
    for (const abaqus::Line& line : element->data)
      for (const std::string_view field : abaqus::split(line.text)) nodes.push_back(whole(field, input, line));
    if (!nodes.empty()) nodes.erase(nodes.begin());  // number of the element
  }
  if (static_cast<long>(nodes.size()) != *count)
    throw Error(fmt::format("NODES={}, but {} node numbers are given", *count, nodes.size()), input.where(user),
                "give them in the comment '** ELEMENT NODES', which Abaqus writes, or with *ELEMENT");
  return nodes;
}

/// Rows from the data lines of *USER ELEMENT: components of the first node, then position of a node and its components.
std::vector<RowKey> element_rows(const abaqus::Input& input, const abaqus::Block& user, const std::vector<long>& nodes,
                                 const std::set<long>& modal) {
  std::map<std::size_t, std::vector<long>> from;
  for (const abaqus::Line& line : user.data) {
    std::vector<long> numbers;
    for (const std::string_view field : abaqus::split(line.text))
      if (!field.empty()) numbers.push_back(whole(field, input, line));
    if (numbers.empty()) continue;
    long position = 1;
    if (!from.empty()) position = numbers.front(), numbers.erase(numbers.begin());
    if (position < 1 || position > static_cast<long>(nodes.size()) || numbers.empty() || numbers.size() > 1000)
      throw Error(fmt::format("position {} with {} components does not fit an element of {} nodes", position,
                              numbers.size(), nodes.size()),
                  input.where(line), "give the position of a node and its components");
    from[position] = numbers;
  }
  if (!from.contains(1))
    throw Error("*USER ELEMENT has no components", input.where(user), "give a line such as 1, 2, 3, 4, 5, 6");
  std::vector<RowKey> rows;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const long component : std::prev(from.upper_bound(i + 1))->second) {
      rows.push_back(make_key(nodes[i], component, modal, input.where(user)));
      if (rows.size() > most_rows)
        throw Error(fmt::format("more than {} rows", most_rows), input.where(user), "give reduced matrices");
    }
  return rows;
}

/// Matrix from the numbers of the data lines in sequence: rows of the lower triangle, or columns of the square.
TextMatrix block_matrix(const abaqus::Input& input, const abaqus::Block& block, const std::vector<RowKey>& rows,
                        Storage storage) {
  TextMatrix matrix{
      fmt::format("{}, TYPE={}", block.title, capitals(block.name_of("TYPE"))), input.paths[block.file], storage, {}};
  const std::size_t n = rows.size(), expected = storage == Storage::square ? n * n : n * (n + 1) / 2;
  std::size_t i = 0, j = 0;
  for (const abaqus::Line& line : block.data)
    for (const std::string_view field : abaqus::split(line.text)) {
      if (field.empty()) continue;
      const std::optional<double> value = abaqus::to_number(field);
      if (!value)
        throw Error(fmt::format("'{}' is not a finite number", shown(field)), input.where(line), "correct the number");
      if (matrix.entries.size() == expected)
        throw Error(fmt::format("more numbers than the {} for {} rows", expected, n), input.where(line),
                    "correct the components of *USER ELEMENT");
      add_entry(matrix, {rows[i], rows[j], *value, line.number});
      const std::size_t row_end = storage == Storage::square ? n - 1 : i;
      if (j == row_end)
        ++i, j = 0;
      else
        ++j;
    }
  if (matrix.entries.size() != expected)
    throw Error(fmt::format("has {} numbers, expected {} for {} rows", matrix.entries.size(), expected, n),
                input.where(block), "correct the components of *USER ELEMENT, or write the whole file again");
  return matrix;
}

/// Matrices of a linear user element in the order STIFFNESS, MASS; entries are empty if there is none.
struct UserElement {
  std::vector<RowKey> rows;
  TextMatrix stiffness;
  TextMatrix mass;
};

UserElement read_user_element(const std::string& path, const std::set<long>& modal) {
  const abaqus::Input input = abaqus::read_input(path);
  const abaqus::Block* user = only(input, "USERELEMENT");
  if (user == nullptr) throw Error("has *MATRIX, but no *USER ELEMENT", path, "give the whole file");
  UserElement element;
  element.rows = element_rows(input, *user, element_nodes(input, *user, path), modal);
  const bool square = user->find("UNSYMM") != nullptr || user->find("UNSYM") != nullptr;
  for (const abaqus::Block& block : input.blocks) {
    if (block.keyword != "MATRIX") continue;
    const std::string type = block.name_of("TYPE");
    if (type != "stiffness" && type != "mass") continue;
    TextMatrix& matrix = type == "mass" ? element.mass : element.stiffness;
    if (!matrix.entries.empty())
      throw Error(fmt::format("the file has a second *MATRIX, TYPE={}", capitals(type)), input.where(block),
                  "keep one of them");
    matrix = block_matrix(input, block, element.rows, square ? Storage::square : Storage::one_triangle);
  }
  return element;
}

TextMatrix read_list(const std::string& path, const std::string& title, const std::set<long>& modal) {
  TextLines lines(path);
  TextMatrix matrix{title, path, Storage::one_triangle, {}};
  std::string_view line;
  while (lines.next(line)) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty() || words[0][0] == '*') continue;
    if (words.size() == 3)
      throw Error("has three numbers: FORMAT=COORDINATE does not name nodes", lines.where(),
                  "write the matrices with *MATRIX OUTPUT, FORMAT=MATRIX INPUT");
    if (words.size() != 5)
      throw Error(fmt::format("has {} fields, expected 5: node, component, node, component, value", words.size()),
                  lines.where(), "write the matrices with *MATRIX OUTPUT, FORMAT=MATRIX INPUT");
    std::array<long, 4> k{};
    for (std::size_t i = 0; i < 4; ++i) k[i] = integer_of(words[i], "a node or component", lines);
    add_entry(matrix, {make_key(k[0], k[1], modal, lines.where()), make_key(k[2], k[3], modal, lines.where()),
                       number_of(words[4], "the value", lines), lines.number()});
  }
  return matrix;
}

bool is_user_element(const std::string& path) {
  const TextLines lines(path);
  return has_line(lines.text(), "*USER ELEMENT") || has_line(lines.text(), "*USERELEMENT");
}

}  // namespace

ReducedMatrices read_abaqus_matrices(const AbaqusSource& source, const std::set<long>& modal) {
  ReducedMatrices matrices;
  matrices.format = "abaqus";
  matrices.source = source.path;
  matrices.modal = modal;
  if (!is_user_element(source.path)) {
    if (source.mass.empty())
      throw Error("holds only one matrix", source.path, "give the file of the mass matrix with --mass");
    const TextMatrix stiffness = read_list(source.path, "the stiffness matrix", modal);
    assemble(stiffness, read_list(source.mass, "the mass matrix", modal), matrices);
    return matrices;
  }
  UserElement element = read_user_element(source.path, modal);
  if (!source.mass.empty()) {
    UserElement second = read_user_element(source.mass, modal);
    if (second.rows != element.rows)
      throw Error(fmt::format("its rows differ from those of {}", source.path), source.mass,
                  "give two matrices of the same element");
    element.mass = std::move(second.mass);
  }
  if (element.stiffness.entries.empty() || element.mass.entries.empty())
    throw Error(fmt::format("has no *MATRIX, TYPE={}", element.mass.entries.empty() ? "MASS" : "STIFFNESS"),
                source.path, "write both matrices, or name the file of the mass matrix with --mass");
  matrices.rows = element.rows;
  fill(element.stiffness, element.mass, matrices);
  if (has_line(TextLines(source.path).text(), "*NODE")) matrices.places = read_places(source.path);
  return matrices;
}

}  // namespace tisserand::reducer::exchange
