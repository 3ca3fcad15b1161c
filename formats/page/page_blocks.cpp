// SPDX-License-Identifier: GPL-3.0-or-later
// Packs numbers as differences between rows in byte planes, compressed by zlib.
#include "formats/page/page_blocks.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

constexpr double largest_word = 32767.0;
constexpr double round_off = 1e-9;  // columns of a smaller relative range count as constant

/// Bytes of the differences between rows: first the low bytes of all words, then the next ones, and so on. Slow changes
/// become long runs of zeros.
template <class Word>
std::string packed(const std::vector<Word>& words, int columns) {
  const std::size_t n = words.size(), step = static_cast<std::size_t>(columns);
  std::string bytes(n * sizeof(Word), '\0');
  for (std::size_t i = 0; i < n; ++i) {
    const Word difference = i < step ? words[i] : static_cast<Word>(words[i] - words[i - step]);
    for (std::size_t k = 0; k < sizeof(Word); ++k) bytes[k * n + i] = static_cast<char>(difference >> (8 * k) & 0xff);
  }
  return bytes;
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                             bytes.size(), 6);
  TISSERAND_ENSURE(code == Z_OK, "zlib: {}", code);
  out.resize(size);
  return out;
}

std::uint16_t word16(double value) {
  TISSERAND_ENSURE(std::abs(value) <= largest_word + 0.5, "{} does not fit 16 bits", value);
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lrint(value)));
}

struct Range {
  double middle = 0.0, step = 1.0;
};

/// All rows, or only the first if all are equal.
PageRows moving_rows(const PageRows& values) {
  const bool moves = (values.rowwise() - values.row(0)).cwiseAbs().maxCoeff() > 0.0;
  return moves ? values : PageRows(values.topRows(1));
}

std::vector<Range> ranges_of(const PageRows& values) {
  std::vector<Range> ranges;
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const double least = values.rows() > 0 ? values.col(c).minCoeff() : 0.0,
                 most = values.rows() > 0 ? values.col(c).maxCoeff() : 0.0;
    const double half = 0.5 * (most - least);
    const bool spreads = half > round_off * std::max(std::abs(least), std::abs(most));
    ranges.push_back({least + half, spreads ? half / largest_word : 1.0});
  }
  return ranges;
}

}  // namespace

template <class Word>
Json PageBlocks::add(const std::vector<Word>& words, const char* type, const std::vector<std::int64_t>& shape,
                     int columns) {
  Json array{{"block", extents_.size()}, {"at", block_.size()}, {"type", type}, {"shape", shape}, {"packed", true}};
  block_ += packed(words, columns);
  return array;
}

Json PageBlocks::add_floats(const PageRows& values, const std::vector<std::int64_t>& shape) {
  std::vector<std::uint32_t> words;
  words.reserve(static_cast<std::size_t>(values.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(values.data()[i])));
  return add(words, "f32", shape, static_cast<int>(shape.size() > 1 ? shape.back() : 1));
}

Json PageBlocks::add_times(const Eigen::VectorXd& times) {
  Json array = add_floats(PageRows(times.array() - times[0]), {times.size()});
  array["offset"] = times[0];
  return array;
}

Json PageBlocks::add_track(const PageRows& values) {
  const PageRows moved = moving_rows(values);
  Json array = add_floats(moved.rowwise() - moved.row(0), {moved.rows(), moved.cols()});
  array["scaled"] = "last";
  for (const double x : moved.row(0)) array["offset"].push_back(x);
  return array;
}

Json PageBlocks::add_positions(const PageRows& values) {
  const std::vector<Range> ranges = ranges_of(values);
  std::vector<std::uint16_t> words;
  words.reserve(static_cast<std::size_t>(values.size()));
  for (Eigen::Index r = 0; r < values.rows(); ++r)
    for (Eigen::Index c = 0; c < values.cols(); ++c)
      words.push_back(word16((values(r, c) - ranges[c].middle) / ranges[c].step));
  Json array = add(words, "i16", {values.rows(), values.cols()}, static_cast<int>(values.cols()));
  array["scaled"] = "last";
  for (const Range& range : ranges) {
    array["scale"].push_back(range.step);
    array["offset"].push_back(range.middle);
  }
  return array;
}

Json PageBlocks::add_rotations(const PageRows& all) {
  const PageRows values = moving_rows(all);
  std::vector<std::uint16_t> words;
  Eigen::RowVector4d before = Eigen::RowVector4d::Zero();
  for (Eigen::Index r = 0; r < values.rows(); ++r) {
    Eigen::RowVector4d q = values.row(r).normalized();
    if (q.dot(before) < 0.0) q = -q;
    for (const double x : q) words.push_back(word16(largest_word * x));
    before = q;
  }
  Json array = add(words, "i16", {values.rows(), 4}, 4);
  array["scale"] = 1.0 / largest_word;
  return array;
}

Json PageBlocks::add_modes(const PageRows& values, const std::vector<double>& step) {
  const auto modes = static_cast<Eigen::Index>(step.size());
  const Eigen::Index vertices = modes > 0 ? values.rows() / modes : 0;
  std::vector<std::uint16_t> words;
  words.reserve(static_cast<std::size_t>(values.size()));
  for (Eigen::Index r = 0; r < values.rows(); ++r)
    for (Eigen::Index c = 0; c < values.cols(); ++c) words.push_back(word16(values(r, c) / step[r / vertices]));
  Json array = add(words, "i16", {modes, vertices, values.cols()}, static_cast<int>(values.cols()));
  array["scaled"] = "first";
  array["scale"] = step;
  return array;
}

Json PageBlocks::add_indices(const std::vector<std::uint32_t>& values, int width) {
  return add(values, "u32", {static_cast<std::int64_t>(values.size()) / width, width}, width);
}

void PageBlocks::next() {
  if (block_.empty()) return;
  const std::string compressed = deflated(block_);
  extents_.emplace_back(stream_.size(), compressed.size());
  stream_ += compressed;
  block_.clear();
}

Json PageBlocks::table() const {
  Json table = Json::array();
  for (const auto& [offset, length] : extents_) table.push_back({offset, length});
  return table;
}

}  // namespace tisserand::formats
