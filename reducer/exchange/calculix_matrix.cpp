// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices from the lines of .sti, .mas and .dof files.
#include "reducer/exchange/calculix_matrix.hpp"

#include <array>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/decks/nastran/cards.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr const char* job_files =
    "give the files .sti, .mas and .dof that CalculiX wrote for one job with SOLVER=MATRIXSTORAGE";

/// Reads rows: "12.3" is node 12, direction 3.
void read_directions(const std::string& path, ReducedMatrices& matrices) {
  TextLines lines(path);
  std::string_view line;
  while (lines.next(line)) {
    line = trimmed(line);
    if (line.empty()) continue;
    const std::size_t dot = line.find('.');
    if (dot == std::string_view::npos)
      throw Error(fmt::format("'{}', expected node.direction", shown(line)), lines.where(), job_files);
    const long node = integer_of(line.substr(0, dot), "the node", lines);
    const long direction = integer_of(line.substr(dot + 1), "the direction", lines);
    if (node < 1 || direction < 1 || direction > 6)
      throw Error(fmt::format("direction {} of node {}, expected 1 to 6", direction, node), lines.where(), job_files);
    if (matrices.rows.size() == most_rows)
      throw Error(fmt::format("more than {} rows", most_rows), lines.where(),
                  "reduce the part with `reducer run` from its mesh instead");
    matrices.rows.push_back({node, static_cast<int>(direction) - 1});
  }
}

TextMatrix read_triangle(const std::string& path, const std::string& title, const std::vector<RowKey>& rows) {
  TextLines lines(path);
  TextMatrix matrix{title, path, Storage::one_triangle, {}};
  std::string_view line;
  while (lines.next(line)) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    if (words.size() != 3)
      throw Error(fmt::format("has {} fields, expected 3: row, column, value", words.size()), lines.where(), job_files);
    std::array<std::size_t, 2> k{};
    for (std::size_t i = 0; i < 2; ++i) {
      const long number = integer_of(words[i], "a row", lines);
      if (number < 1 || number > static_cast<long>(rows.size()))
        throw Error(
            fmt::format("the matrix has an entry in row {}, but the .dof file names {} rows", number, rows.size()),
            lines.where(), job_files);
      k[i] = static_cast<std::size_t>(number) - 1;
    }
    add_entry(matrix, {rows[k[0]], rows[k[1]], number_of(words[2], "the value", lines), lines.number()});
  }
  return matrix;
}

}  // namespace

ReducedMatrices read_calculix_matrices(const std::string& stiffness, const std::set<long>& modal) {
  const std::size_t dot = stiffness.rfind('.');
  if (dot == std::string::npos || stiffness.substr(dot) != ".sti")
    throw Error("does not end in .sti", stiffness, "give job.sti, with job.mas and job.dof in the same folder");
  ReducedMatrices matrices;
  matrices.format = "calculix";
  matrices.source = stiffness;
  matrices.modal = modal;
  read_directions(stiffness.substr(0, dot) + ".dof", matrices);
  const TextMatrix S = read_triangle(stiffness, "the stiffness matrix", matrices.rows);
  fill(S, read_triangle(stiffness.substr(0, dot) + ".mas", "the mass matrix", matrices.rows), matrices);
  return matrices;
}

}  // namespace tisserand::reducer::exchange
