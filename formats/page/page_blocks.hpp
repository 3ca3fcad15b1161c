// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a page, quantised and compressed into blocks, and their references in the header (formats/PAGE.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace tisserand::formats {

using Json = nlohmann::ordered_json;

/// Numbers row by row, as pages store them.
using PageRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Collects the data blocks of a page. Arrays added between two next() calls share a block. Each add function returns
/// the header object of its array.
class PageBlocks {
 public:
  /// Adds 32-bit floats, which may be NaN. `shape`: shape of the array, whose last extent is the number of columns of
  /// `values`.
  Json add_floats(const PageRows& values, const std::vector<std::int64_t>& shape);
  /// Adds times as differences from the first time.
  Json add_times(const Eigen::VectorXd& times);
  /// Adds one row per instant as 32-bit differences from the first row, so that positions far away keep their digits.
  /// Adds a single row if no row differs.
  Json add_track(const PageRows& values);
  /// Adds numbers as 16-bit integers: value = offset + scale × integer, with one scale and offset per column.
  Json add_positions(const PageRows& values);
  /// Adds unit quaternions [w x y z] per row as integers of scale 1/32767, with signs that make them continuous. Adds a
  /// single row if no row differs.
  Json add_rotations(const PageRows& values);
  /// Adds m modes of V x 3 values, mode k as integers in steps of `step[k]`. Requires finite values with |value| <=
  /// 32767 step.
  Json add_modes(const PageRows& values, const std::vector<double>& step);
  /// Adds indices in rows of `width`.
  Json add_indices(const std::vector<std::uint32_t>& values, int width);

  /// Ends the current block if it is not empty.
  void next();
  /// Table [[offset, length], ...] of the compressed blocks in stream() [bytes].
  Json table() const;
  const std::string& stream() const { return stream_; }

 private:
  template <class Word>
  Json add(const std::vector<Word>& words, const char* type, const std::vector<std::int64_t>& shape, int columns);

  std::string block_;   ///< not compressed yet
  std::string stream_;  ///< compressed blocks
  std::vector<std::pair<std::size_t, std::size_t>> extents_;
};

}  // namespace tisserand::formats
