// SPDX-License-Identifier: GPL-3.0-or-later
// Readers that check every number of a file before use.
#include "formats/surface/surface_file.hpp"

#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string_view>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"

namespace tisserand::formats {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;
constexpr std::size_t most_triangles = 10'000'000;
constexpr std::size_t stl_head = 84, stl_triangle = 50;
constexpr const char* again = "export the surface again";

std::string read_bytes(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    const bool exists = std::filesystem::exists(path, ignored);
    throw Error(exists ? "is not a regular file" : "there is no such file", path, "give an .stl or .obj file");
  }
  const std::uint64_t size = std::filesystem::file_size(path, ignored);
  if (size > most_bytes)
    throw Error(fmt::format("has {} bytes; the limit is {}", size, most_bytes), path, "reduce the number of triangles");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(size, '\0');
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw Error(fmt::format("cannot read the file: {}", std::strerror(errno)), path, "check path and permission");
  return bytes;
}

/// Splits a text into lines and words, and knows the place for messages.
class Words {
 public:
  Words(std::string_view text, const std::string& path) : rest_(text), path_(path) {}

  /// Reads the words of the next line that has some. False at the end.
  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      std::string_view line = rest_.substr(0, end);
      rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
      ++line_;
      words_.clear();
      for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
        const std::size_t stop = std::min(line.find_first_of(" \t\r", at), line.size());
        words_.push_back(line.substr(at, stop - at));
        at = stop;
      }
      if (!words_.empty()) return true;
    }
    return false;
  }
  const std::vector<std::string_view>& words() const { return words_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(what, fmt::format("{}:{}", path_, line_), again);
  }

  /// Point given by the words from `first` on.
  Eigen::Vector3d point(std::size_t first) const {
    if (words_.size() < first + 3) fail("the line has fewer than three coordinates");
    Eigen::Vector3d point;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view word = words_[first + k];
      double value = 0.0;
      const std::size_t plus = word.starts_with('+') ? 1 : 0;
      const auto [end, status] = std::from_chars(word.data() + plus, word.data() + word.size(), value);
      if (status != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
        fail(fmt::format("'{}' is not a finite number", printable_line(word, 40)));
      point[static_cast<Eigen::Index>(k)] = value;
    }
    return point;
  }

 private:
  std::string_view rest_;
  const std::string& path_;
  int line_ = 0;
  std::vector<std::string_view> words_;
};

/// Collects triangles by their corners, and joins equal corners.
class Joined {
 public:
  explicit Joined(const std::string& path) : path_(path) {}

  void add(const std::array<Eigen::Vector3d, 3>& corners) {
    if (surface_.triangles.size() == most_triangles)
      throw Error(fmt::format("has more than {} triangles", most_triangles), path_, "reduce the number of triangles");
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, is_new] =
          index_.try_emplace({corners[k].x(), corners[k].y(), corners[k].z()}, count_of(surface_.vertices));
      if (is_new) surface_.vertices.push_back(corners[k]);
      triangle[k] = found->second;
    }
    const bool flat = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (!flat) surface_.triangles.push_back(triangle);
  }
  TriangleSurface take() { return std::move(surface_); }

 private:
  const std::string& path_;
  TriangleSurface surface_;
  std::map<std::array<double, 3>, int> index_;
};

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

TriangleSurface read_binary_stl(const std::string& bytes, const std::string& path) {
  const std::size_t count = little_endian(bytes.data() + 80), there = (bytes.size() - stl_head) / stl_triangle;
  if (there < count)
    throw Error(fmt::format("has {} of the {} triangles that its header announces", there, count), path, again);
  Joined joined(path);
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + stl_head + i * stl_triangle + 12;  // after the normal
    std::array<Eigen::Vector3d, 3> corners;
    for (int k = 0; k < 9; ++k)
      corners[k / 3][k % 3] = static_cast<double>(std::bit_cast<float>(little_endian(at + 4 * k)));
    for (const Eigen::Vector3d& corner : corners)
      if (!corner.allFinite())
        throw Error(fmt::format("triangle {} has a corner with a coordinate that is not a finite number", i + 1), path,
                    again);
    joined.add(corners);
  }
  return joined.take();
}

TriangleSurface read_text_stl(const std::string& bytes, const std::string& path) {
  Joined joined(path);
  Words words(bytes, path);
  std::array<Eigen::Vector3d, 3> corners;
  std::size_t found = 0;
  bool ended = false;
  while (words.next()) {
    const std::string_view word = words.words().front();
    if (word == "vertex") {
      if (found == 3) words.fail("a facet has more than three vertices");
      corners[found++] = words.point(1);
    } else if (word == "endfacet") {
      if (found != 3) words.fail(fmt::format("a facet has {} vertices instead of 3", found));
      joined.add(corners);
      found = 0;
    }
    ended = word == "endsolid";
  }
  if (!ended || found != 0) throw Error("is incomplete: its last line is not 'endsolid'", path, again);
  return joined.take();
}

/// Index of the vertex in a word of a face, "7", "7/2", "-1//3".
int vertex_of(const Words& words, std::string_view word, std::size_t vertices) {
  const std::string_view first = word.substr(0, word.find('/'));
  long index = 0;
  const auto [end, status] = std::from_chars(first.data(), first.data() + first.size(), index);
  const long count = static_cast<long>(vertices), at = index < 0 ? count + index : index - 1;
  if (status != std::errc{} || end != first.data() + first.size() || at < 0 || at >= count)
    words.fail(fmt::format("a face refers to vertex '{}', but there are {} vertices before it",
                           printable_line(word, 40), count));
  return static_cast<int>(at);
}

TriangleSurface read_obj(const std::string& bytes, const std::string& path) {
  TriangleSurface surface;
  Words words(bytes, path);
  while (words.next()) {
    const std::vector<std::string_view>& line = words.words();
    if (line.front() == "v") {
      surface.vertices.push_back(words.point(1));
    } else if (line.front() == "f") {
      if (line.size() < 4) words.fail("a face has fewer than three vertices");
      std::vector<int> corners;
      for (std::size_t k = 1; k < line.size(); ++k)
        corners.push_back(vertex_of(words, line[k], surface.vertices.size()));
      for (std::size_t k = 2; k < corners.size(); ++k)
        surface.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      if (surface.triangles.size() > most_triangles)
        words.fail(fmt::format("the file has more than {} triangles", most_triangles));
    }
  }
  return surface;
}

bool is_obj(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".obj";
}

/// Whether an STL file is binary, by its length. Binary files may begin with "solid" too.
bool is_binary_stl(const std::string& bytes) {
  if (bytes.size() < stl_head) return false;
  const std::uint64_t expected = stl_head + std::uint64_t{stl_triangle} * little_endian(bytes.data() + 80);
  const bool is_text = bytes.starts_with("solid") && bytes.find("facet") < 2000;
  return bytes.size() == expected || !is_text;
}

}  // namespace

TriangleSurface read_surface_file(const std::string& path) {
  const std::string bytes = read_bytes(path);
  TriangleSurface surface = is_obj(path)           ? read_obj(bytes, path)
                            : is_binary_stl(bytes) ? read_binary_stl(bytes, path)
                                                   : read_text_stl(bytes, path);
  if (surface.triangles.empty()) throw Error("has no triangles", path, again);
  return surface;
}

}  // namespace tisserand::formats
