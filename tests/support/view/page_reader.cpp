// SPDX-License-Identifier: GPL-3.0-or-later
// Base64, zlib, byte planes and differences back to numbers.
#include "tests/support/view/page_reader.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>

#include "common/base64.hpp"

namespace tisserand::test_support {
namespace {

using nlohmann::json;

std::string inflated(const std::string& compressed) {
  z_stream z{};
  if (inflateInit(&z) != Z_OK) throw std::runtime_error("zlib");
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
  z.avail_in = static_cast<uInt>(compressed.size());
  std::string bytes, piece(1u << 16, '\0');
  int code = Z_OK;
  while (code == Z_OK) {
    z.next_out = reinterpret_cast<Bytef*>(piece.data());
    z.avail_out = static_cast<uInt>(piece.size());
    code = inflate(&z, Z_NO_FLUSH);
    bytes.append(piece, 0, piece.size() - z.avail_out);
  }
  inflateEnd(&z);
  if (code != Z_STREAM_END) throw std::runtime_error("a block is no zlib stream");
  return bytes;
}

double number(std::uint32_t word, const std::string& type) {
  if (type == "i16") return static_cast<std::int16_t>(word);
  if (type != "f32") return word;
  float value = 0.0f;
  std::memcpy(&value, &word, sizeof value);
  return static_cast<double>(value);
}

Eigen::Vector3d vector_of(const json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

/// Row t, or the only one.
Eigen::VectorXd row_of(const Eigen::MatrixXd& rows, Eigen::Index t) {
  return rows.row(std::min(t, rows.rows() - 1)).transpose();
}

Eigen::Quaterniond quaternion_of(const Eigen::VectorXd& q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

}  // namespace

std::string script_of(const std::string& page, const std::string& id) {
  const std::size_t mark = page.find("id=\"" + id + "\"");
  if (mark == std::string::npos) throw std::runtime_error("the page has no element " + id);
  const std::size_t begin = page.find('>', mark) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

PageReader::PageReader(const std::string& page)
    : header_(json::parse(script_of(page, "tisserand-header"))),
      stream_(base64_decoded(script_of(page, "tisserand-blocks"))) {}

Eigen::MatrixXd PageReader::read(const json& array) const {
  const json& extent = header_["blocks"].at(array["block"].get<std::size_t>());
  const std::string block = inflated(stream_.substr(extent[0], extent[1]));
  const std::string type = array["type"];
  const std::size_t width = type == "u8" ? 1 : type == "i16" || type == "u16" ? 2 : 4, at = array["at"];
  std::size_t n = 1;
  for (const json& extent_of_axis : array["shape"]) n *= extent_of_axis.get<std::size_t>();
  const std::size_t columns = array["shape"].size() > 1 ? array["shape"].back().get<std::size_t>() : 1;
  if (at + n * width > block.size()) throw std::runtime_error("an array ends beyond its block");
  std::vector<std::uint32_t> words(n);
  const std::uint32_t mask = width == 4 ? 0xffffffffu : (1u << (8 * width)) - 1;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < width; ++k)
      words[i] |= static_cast<std::uint32_t>(static_cast<unsigned char>(block[at + k * n + i])) << (8 * k);
    if (i >= columns) words[i] = (words[i] + words[i - columns]) & mask;
  }
  const auto factor = [&](const char* key, std::size_t i, double fallback) {
    if (!array.contains(key)) return fallback;
    if (!array[key].is_array()) return array[key].get<double>();
    const std::size_t per_first = n / array["shape"][0].get<std::size_t>();
    return array[key][array["scaled"] == "last" ? i % columns : i / per_first].get<double>();
  };
  const auto rows = static_cast<Eigen::Index>(n / std::max<std::size_t>(columns, 1));
  Eigen::MatrixXd values(rows, static_cast<Eigen::Index>(columns));
  for (std::size_t i = 0; i < n; ++i)
    values(static_cast<Eigen::Index>(i / columns), static_cast<Eigen::Index>(i % columns)) =
        factor("offset", i, 0.0) + factor("scale", i, 1.0) * number(words[i], type);
  return values;
}

Eigen::Vector3d PageReader::place(const json& run, const json& place, Eigen::Index t) const {
  if (place.contains("position")) return row_of(read(place["position"]), t);
  const Eigen::Vector3d point = vector_of(place["point"]);
  if (!place.contains("body")) return point;
  const json& body = run["bodies"][place["body"].get<std::size_t>()];
  return Eigen::Vector3d(row_of(read(body["position"]), t)) + quaternion_of(row_of(read(body["rotation"]), t)) * point;
}

Eigen::Matrix3Xd PageReader::vertices(const json& run, const json& body, Eigen::Index t) const {
  const json& shape = run["shapes"][body["shape"].get<std::size_t>()];
  Eigen::Matrix3Xd local = read(shape["vertices"]).transpose();
  if (!shape["modes"].is_null()) {
    const Eigen::MatrixXd modes = read(shape["modes"]);
    const Eigen::VectorXd amplitudes = row_of(read(body["amplitudes"]), t);
    for (Eigen::Index k = 0; k < amplitudes.size(); ++k)
      local += amplitudes[k] * modes.middleRows(k * local.cols(), local.cols()).transpose();
  }
  const Eigen::Vector3d position = row_of(read(body["position"]), t);
  return (quaternion_of(row_of(read(body["rotation"]), t)).toRotationMatrix() * local).colwise() + position;
}

}  // namespace tisserand::test_support
