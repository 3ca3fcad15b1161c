// SPDX-License-Identifier: GPL-3.0-or-later
// Tags and values of fmx files, as openfedem/fedem-solvers reads and writes them (vpmUtilities/binaryDB.c) with the
// tags of openfedem/fedem-foundation (FFaLib/FFaOS/FFaTag.C).
#include "reducer/exchange/fmx.hpp"

#include <array>
#include <cstring>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/decks/nastran/cards.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr std::size_t tag_length = 30;
constexpr std::int16_t byte_order = 0x1234;
constexpr const char* version = ";1.0;\n";
constexpr std::size_t head_length = tag_length + sizeof byte_order + 2 * sizeof(std::uint32_t) + 6;

std::string tag_of(FmxKind kind) {
  switch (kind) {
    case FmxKind::stiffness:
      return "#FEDEM stiffness matrix";
    case FmxKind::mass:
      return "#FEDEM mass matrix";
    case FmxKind::gravity:
      return "#FEDEM gravity force vectors";
  }
  return "";
}

TextMatrix read_matrix(const std::string& path, FmxKind kind, const std::vector<RowKey>& rows) {
  const TextLines file(path);
  const std::string& bytes = file.text();
  const std::string tag = tag_of(kind);
  const std::string_view found = trimmed(std::string_view(bytes).substr(0, tag_length));
  if (bytes.size() < head_length || found != tag)
    throw Error(fmt::format("begins with '{}', expected '{}'", shown(found), tag), path,
                "give the fmx files of stiffness and mass that FEDEM wrote for one part");
  std::int16_t order = 0;
  std::memcpy(&order, bytes.data() + tag_length, sizeof order);
  if (order != byte_order)
    throw Error("has the opposite byte order", path, "write the file on a machine with the byte order of this one");
  if (bytes.compare(head_length - std::strlen(version), std::strlen(version), version) != 0)
    throw Error("does not have version 1.0", path, "write the file with an open-source version of FEDEM");
  const std::size_t n = rows.size(), expected = head_length + n * n * sizeof(double);
  if (bytes.size() != expected)
    throw Error(fmt::format("has {} bytes, expected {} for the {} rows of the table", bytes.size(), expected, n), path,
                "give the table of rows that belongs to the matrices");
  TextMatrix matrix{fmt::format("the {}", tag.substr(std::strlen("#FEDEM "))), path, Storage::square, {}};
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      double value = 0.0;
      std::memcpy(&value, bytes.data() + head_length + (j * n + i) * sizeof value, sizeof value);
      add_entry(matrix, {rows[i], rows[j], value, 0});
    }
  return matrix;
}

}  // namespace

ReducedMatrices read_fmx(const TabledFiles& files) {
  ReducedMatrices matrices = read_rows("fmx", files);
  const TextMatrix stiffness = read_matrix(files.stiffness, FmxKind::stiffness, matrices.rows);
  fill(stiffness, read_matrix(files.mass, FmxKind::mass, matrices.rows), matrices);
  return matrices;
}

std::string fmx_bytes(FmxKind kind, std::uint32_t checksum, const Eigen::MatrixXd& values) {
  std::string bytes = tag_of(kind);
  bytes.resize(tag_length, ' ');
  const auto append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  const std::array<std::uint32_t, 2> sums{0, checksum};
  append(&byte_order, sizeof byte_order);
  append(sums.data(), sizeof sums);
  bytes += version;
  append(values.data(), static_cast<std::size_t>(values.size()) * sizeof(double));
  return bytes;
}

}  // namespace tisserand::reducer::exchange
