// SPDX-License-Identifier: GPL-3.0-or-later
// Producers inside pictures: the files stay valid.
#include "formats/page/picture_mark.hpp"

#include <gtest/gtest.h>

#include "common/base64.hpp"

namespace tisserand::picture_mark_test {
namespace {

// The smallest PNG, one transparent pixel. The chunk that comes in, with its sum, is what Python's zlib makes of it:
// zlib.crc32(b"tEXtSoftware\0Tisserand mechanism 0.2.0") = 0x0d15c4e7.
TEST(PictureMark, PngHasAChunkBehindItsHeader) {
  const std::string png = base64_decoded(
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg==");
  const std::string chunk =
      std::string("\0\0\0\x22tEXtSoftware\0", 17) + "Tisserand mechanism 0.2.0" + "\x0d\x15\xc4\xe7";
  EXPECT_EQ(formats::with_producer(png, "Tisserand mechanism 0.2.0"), png.substr(0, 33) + chunk + png.substr(33));
}

TEST(PictureMark, TextsHaveACommentWhereTheirFormatsTakeIt) {
  EXPECT_EQ(formats::with_producer("<?xml version=\"1.0\"?>\n<svg></svg>", "P 1"),
            "<?xml version=\"1.0\"?>\n<!-- P 1 -->\n<svg></svg>");
  EXPECT_EQ(formats::with_producer("%!PS-Adobe-3.0 EPSF-3.0\n%%Creator: cairo 1.16\n", "P 1"),
            "%!PS-Adobe-3.0 EPSF-3.0\n%%Creator: P 1, cairo 1.16\n");
  EXPECT_EQ(formats::with_producer("%PDF-1.5\n...%%EOF\n", "P 1"), "%PDF-1.5\n...%%EOF\n% P 1\n");
}

TEST(PictureMark, OtherFilesStay) {
  for (const std::string text : {"", "GIF89a", "\x89PNG\r\n", "%!PS without a creator"})
    EXPECT_EQ(formats::with_producer(text, "P 1"), text);
}

}  // namespace
}  // namespace tisserand::picture_mark_test
