// SPDX-License-Identifier: GPL-3.0-or-later
// Header, sizes and entries of Matrix Market files.
#include "reducer/exchange/matrix_market.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/decks/nastran/cards.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

enum class Layout { coordinate, array };

struct Header {
  Layout layout = Layout::coordinate;
  Storage storage = Storage::square;
};

Header read_header(TextLines& lines) {
  std::string_view line;
  lines.next(line);
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() != 5 || !same_word(words[0], "%%MatrixMarket") || !same_word(words[1], "matrix"))
    throw Error(fmt::format("begins with '{}', expected '%%MatrixMarket matrix ...'", shown(line)), lines.path(),
                "give a Matrix Market file");
  const bool coordinate = same_word(words[2], "coordinate");
  if (!coordinate && !same_word(words[2], "array"))
    throw Error(fmt::format("format '{}', expected coordinate or array", shown(words[2])), lines.where(),
                "correct the header");
  if (!same_word(words[3], "real") && !same_word(words[3], "double") && !same_word(words[3], "integer"))
    throw Error(fmt::format("field '{}', expected real or integer", shown(words[3])), lines.where(),
                "give real matrices");
  const bool symmetric = same_word(words[4], "symmetric");
  if (!symmetric && !same_word(words[4], "general"))
    throw Error(fmt::format("symmetry '{}', expected symmetric or general", shown(words[4])), lines.where(),
                "give symmetric matrices");
  return {coordinate ? Layout::coordinate : Layout::array, symmetric ? Storage::one_triangle : Storage::square};
}

/// Words of the next line that has any; empty at the end.
std::vector<std::string_view> next_words(TextLines& lines) {
  std::string_view line;
  while (lines.next(line)) {
    if (!line.empty() && line[0] == '%') continue;
    std::vector<std::string_view> words = words_of(line);
    if (!words.empty()) return words;
  }
  return {};
}

std::size_t row_index(std::string_view word, std::size_t n, const TextLines& lines) {
  const long i = integer_of(word, "a row or column", lines);
  if (i < 1 || i > static_cast<long>(n))
    throw Error(fmt::format("row or column is {}, expected 1 to {}", i, n), lines.where(), "correct the number");
  return static_cast<std::size_t>(i) - 1;
}

void read_coordinates(TextLines& lines, const std::vector<RowKey>& rows, long count, TextMatrix& matrix) {
  for (long k = 0; k < count; ++k) {
    const std::vector<std::string_view> words = next_words(lines);
    if (words.empty())
      throw Error(fmt::format("ends after {} of {} entries", k, count), lines.path(), "write the whole file again");
    if (words.size() != 3)
      throw Error(fmt::format("has {} numbers, expected 3: row, column, value", words.size()), lines.where(),
                  "correct the line");
    const std::size_t i = row_index(words[0], rows.size(), lines), j = row_index(words[1], rows.size(), lines);
    add_entry(matrix, {rows[i], rows[j], number_of(words[2], "the value", lines), lines.number()});
  }
}

void read_array(TextLines& lines, const std::vector<RowKey>& rows, TextMatrix& matrix) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = matrix.storage == Storage::one_triangle ? j : 0; i < rows.size(); ++i, ++at) {
      if (at == words.size()) words = next_words(lines), at = 0;
      if (words.empty())
        throw Error(fmt::format("ends before row {} of column {}", i + 1, j + 1), lines.path(),
                    "write the whole file again");
      add_entry(matrix, {rows[i], rows[j], number_of(words[at], "the value", lines), lines.number()});
    }
  if (at < words.size())
    throw Error("holds more values than the line of sizes announces", lines.where(), "correct the size");
}

TextMatrix read_matrix(const std::string& path, const std::string& title, const std::vector<RowKey>& rows) {
  TextLines lines(path);
  const Header header = read_header(lines);
  TextMatrix matrix{title, path, header.storage, {}};
  const std::vector<std::string_view> sizes = next_words(lines);
  const std::size_t expected = header.layout == Layout::coordinate ? 3 : 2;
  if (sizes.size() != expected)
    throw Error(fmt::format("the line of sizes has {} numbers, expected {}", sizes.size(), expected), lines.where(),
                "give the numbers of rows and columns and, for format coordinate, the number of entries");
  const auto n = static_cast<long>(rows.size());
  const long found = integer_of(sizes[0], "the number of rows", lines);
  if (found != n || integer_of(sizes[1], "the number of columns", lines) != n)
    throw Error(fmt::format("is {} x {}, but the table names {} rows", shown(sizes[0]), shown(sizes[1]), n),
                lines.where(), "give the table of rows that belongs to the matrix");
  if (header.layout == Layout::array) {
    read_array(lines, rows, matrix);
  } else {
    const long count = integer_of(sizes[2], "the number of entries", lines);
    if (count < 0 || count > n * n)
      throw Error(fmt::format("the number of entries is {} for a matrix of {} rows", count, n), lines.where(),
                  "correct the number");
    read_coordinates(lines, rows, count, matrix);
  }
  if (!next_words(lines).empty())
    throw Error("holds more lines than the line of sizes announces", lines.where(),
                "correct the size, or write the file again");
  return matrix;
}

}  // namespace

ReducedMatrices read_matrix_market(const TabledFiles& files) {
  ReducedMatrices matrices = read_rows("matrixmarket", files);
  const TextMatrix stiffness = read_matrix(files.stiffness, "the stiffness matrix", matrices.rows);
  fill(stiffness, read_matrix(files.mass, "the mass matrix", matrices.rows), matrices);
  return matrices;
}

std::string matrix_market_text(const Eigen::MatrixXd& A, const std::string& comment) {
  std::string entries;
  std::size_t count = 0;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = j; i < A.rows(); ++i) {
      if (A(i, j) == 0.0 && !std::signbit(A(i, j))) continue;
      entries += fmt::format("{} {} {:.17g}\n", i + 1, j + 1, A(i, j));
      ++count;
    }
  return fmt::format("%%MatrixMarket matrix coordinate real symmetric\n% {}\n{} {} {}\n{}", comment, A.rows(), A.cols(),
                     count, entries);
}

}  // namespace tisserand::reducer::exchange
