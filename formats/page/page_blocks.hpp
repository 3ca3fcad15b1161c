// Numbers of a page: quantised, packed and compressed into blocks, and how the header refers to them (formats/PAGE.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace tisserand::formats {

using Json = nlohmann::ordered_json;

/// Numbers row by row, as pages have them.
using PageRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Collects blocks. Arrays added between two next() calls share one; each is an object of the header.
class PageBlocks {
 public:
  /// 32-bit numbers; not-a-number stays. `shape`: its last extent is the number of columns of `values`.
  Json add_floats(const PageRows& values, const std::vector<std::int64_t>& shape);
  /// Times: differences from the first.
  Json add_times(const Eigen::VectorXd& times);
  /// One row per instant, as 32-bit differences from the first row, so that places far away keep their digits; a single
  /// row where nothing moves.
  Json add_track(const PageRows& values);
  /// 16-bit integers: offset + scale stored, with one scale and offset per column (the last extent).
  Json add_positions(const PageRows& values);
  /// Unit quaternions [w x y z] per row, continuous in sign, scale 1/32767; a single row where nothing turns.
  Json add_rotations(const PageRows& values);
  /// m blocks of V x 3, block k in steps of `step[k]`; all finite, |value| <= 32767 step. Returns what the page reads
  /// in `read`.
  Json add_modes(const PageRows& values, const std::vector<double>& step);
  /// Indices, rows of `width`.
  Json add_indices(const std::vector<std::uint32_t>& values, int width);

  /// Ends the present block, if anything is in it.
  void next();
  /// [[offset, length], ...] of the compressed blocks in stream().
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
