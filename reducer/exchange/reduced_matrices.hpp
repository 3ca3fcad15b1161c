// SPDX-License-Identifier: GPL-3.0-or-later
// Common result of all readers of foreign matrices: rows with their nodes, places of nodes, S and M. It becomes a
// superelement.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer::exchange {

/// Component of a scalar point, which is a coordinate without direction, such as the amplitude of a mode.
inline constexpr int scalar_component = -1;

/// Largest number of rows of an import. Reduced matrices are dense, so this bounds the memory that a file can demand.
inline constexpr std::size_t most_rows = 4000;

/// Row of a foreign matrix: number of the node, and component. The component is 0 to 2 for translations, 3 to 5 for
/// rotations, or scalar_component.
struct RowKey {
  long node = 0;
  int component = 0;
  auto operator<=>(const RowKey&) const = default;
};

/// Text for a row in messages: "node 12, rotation y" or "scalar point 1001".
std::string key_text(const RowKey& key);

/// Entry of a matrix, as a text gives it.
struct MatrixEntry {
  RowKey row;
  RowKey column;
  double value = 0.0;
  std::size_t line = 0;  ///< line of the text, from 1; 0: none
};

/// Storage of a symmetric matrix in a text. An entry off the diagonal stands for its mirror image too (one_triangle)
/// or only for itself (square).
enum class Storage { one_triangle, square };

/// Matrix as a text gives it. Absent entries are 0.
struct TextMatrix {
  std::string title;  ///< name for messages: "KAAX", "the stiffness matrix"
  std::string file;
  Storage storage = Storage::one_triangle;
  std::vector<MatrixEntry> entries;
};

/// Appends an entry to `matrix`. Throws Error if there are more than most_rows² entries.
void add_entry(TextMatrix& matrix, const MatrixEntry& entry);

/// Name and position of a node in the part frame, and the axes (columns) of its components.
struct NodePlace {
  std::string name;  ///< name of the node; empty: it is called n<number>
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

using Places = std::map<long, NodePlace>;

/// Symmetric reduced matrices of another program, in the units and node axes of their file.
struct ReducedMatrices {
  std::string format;  ///< format of the file: "dmig", "abaqus", "calculix", "matrixmarket", "fmx"
  std::string source;  ///< file that messages name
  std::vector<RowKey> rows;
  std::set<long> modal;  ///< nodes whose rows are internal coordinates, in addition to scalar points
  Places places;         ///< places of nodes, which may be more than those of the rows
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd mass;
  double stiffness_asymmetry = 0.0;  ///< asymmetry of the stiffness that was removed: max |a_ij − a_ji| / √(a_ii a_jj)
  double mass_asymmetry = 0.0;
};

/// Whether a row is an internal coordinate. It is for a scalar point, a node in `modal`, and an internal node (number
/// < 0).
bool is_internal(const ReducedMatrices& matrices, const RowKey& key);

/// Sets the rows of `matrices` from the entries of both texts, by number of the node and component, with scalar points
/// last. Then it sets S and M. Throws Error for no entry, for more than most_rows rows, and for entries that are given
/// twice, not finite or not symmetric.
void assemble(const TextMatrix& stiffness, const TextMatrix& mass, ReducedMatrices& matrices);

/// Sets S and M of `matrices` for rows that are already known. Throws Error for an entry of another row.
void fill(const TextMatrix& stiffness, const TextMatrix& mass, ReducedMatrices& matrices);

}  // namespace tisserand::reducer::exchange
