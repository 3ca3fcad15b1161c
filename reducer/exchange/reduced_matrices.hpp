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

/// Component of a scalar point: a coordinate without direction, such as the amplitude of a mode.
inline constexpr int scalar_component = -1;

/// Largest number of rows of an import. Reduced matrices are dense, so this bounds the memory that a file can demand.
inline constexpr std::size_t most_rows = 4000;

/// Row of a foreign matrix: number of the node and 0-2 translations, 3-5 rotations, or scalar_component.
struct RowKey {
  long node = 0;
  int component = 0;
  auto operator<=>(const RowKey&) const = default;
};

/// Text for messages: "node 12, rotation y" or "scalar point 1001".
std::string key_text(const RowKey& key);

struct MatrixEntry {
  RowKey row;
  RowKey column;
  double value = 0.0;
  std::size_t line = 0;  ///< line of the text, from 1; 0: none
};

/// Whether an entry off the diagonal also represents its mirror image.
enum class Storage { one_triangle, square };

/// Matrix as given in the text; absent entries are 0.
struct TextMatrix {
  std::string title;  ///< for messages: "KAAX", "the stiffness matrix"
  std::string file;
  Storage storage = Storage::one_triangle;
  std::vector<MatrixEntry> entries;
};

/// Appends an entry. Throws Error if there are more than most_rows².
void add_entry(TextMatrix& matrix, const MatrixEntry& entry);

/// Position of a node in the part frame, and the axes (columns) of its components.
struct NodePlace {
  std::string name;  ///< empty: n<number>
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

using Places = std::map<long, NodePlace>;

/// Reduced matrices of another program, in the units and node axes of their file. Symmetric.
struct ReducedMatrices {
  std::string format;  ///< "dmig", "abaqus", "calculix", "matrixmarket", "fmx"
  std::string source;  ///< file that messages name
  std::vector<RowKey> rows;
  std::set<long> modal;  ///< nodes whose rows are internal coordinates, in addition to scalar points
  Places places;         ///< may hold more nodes than there are rows
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd mass;
  double stiffness_asymmetry = 0.0;  ///< as found, removed: max |a_ij − a_ji| / √(a_ii a_jj)
  double mass_asymmetry = 0.0;
};

/// Whether the row is an internal coordinate: a scalar point, a node in `modal`, or an internal node (number < 0).
bool is_internal(const ReducedMatrices& matrices, const RowKey& key);

/// Sets `rows` from the entries of both matrices, by number of the node and component, scalar points last; then S and
/// M. Throws Error: no entry, more than most_rows rows, an entry given twice, not finite, not symmetric.
void assemble(const TextMatrix& stiffness, const TextMatrix& mass, ReducedMatrices& matrices);

/// Sets S and M for `rows` that are already known. An entry of another row is an error.
void fill(const TextMatrix& stiffness, const TextMatrix& mass, ReducedMatrices& matrices);

}  // namespace tisserand::reducer::exchange
