// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/page/picture_mark.hpp"

#include <cstdint>

#include <zlib.h>

namespace tisserand::formats {
namespace {

/// Bytes in big-endian order, as PNG requires.
std::string four_bytes(std::uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xffu);
  return bytes;
}

/// Text chunk of a PNG file (ISO/IEC 15948, 11.3.4.3).
std::string png_text(const std::string& keyword, const std::string& text) {
  const std::string data = "tEXt" + keyword + std::string(1, '\0') + text;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(data.data()), static_cast<uInt>(data.size()));
  return four_bytes(static_cast<std::uint32_t>(data.size() - 4)) + data + four_bytes(static_cast<std::uint32_t>(sum));
}

/// Inserts `text` after the first `mark`, if there is one.
void insert_behind(std::string& picture, const char* mark, const std::string& text) {
  if (const std::size_t at = picture.find(mark); at != std::string::npos)
    picture.insert(at + std::char_traits<char>::length(mark), text);
}

}  // namespace

std::string with_producer(std::string picture, const std::string& producer) {
  constexpr std::size_t png_header = 8 + 25;  // signature and chunk IHDR
  if (picture.starts_with("\x89PNG") && picture.size() > png_header)
    picture.insert(png_header, png_text("Software", producer));
  else if (picture.starts_with("<?xml"))
    insert_behind(picture, "?>", "\n<!-- " + producer + " -->");
  else if (picture.starts_with("%PDF"))
    picture += "% " + producer + "\n";
  else if (picture.starts_with("%!PS"))
    insert_behind(picture, "%%Creator: ", producer + ", ");
  return picture;
}

}  // namespace tisserand::formats
