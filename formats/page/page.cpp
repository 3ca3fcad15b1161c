// SPDX-License-Identifier: GPL-3.0-or-later
// Composes the HTML page from header and blocks.
#include "formats/page/page.hpp"

#include "common/base64.hpp"
#include "common/error.hpp"

// The bundle is read-only data of the program, so the compiler need not parse it.
__asm__(
    ".section .rodata\n"
    "tisserand_viewer_begin:\n"
    ".incbin \"" TISSERAND_VIEWER
    "\"\n"
    "tisserand_viewer_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" {
extern const char tisserand_viewer_begin[] __attribute__((visibility("hidden")));
extern const char tisserand_viewer_end[] __attribute__((visibility("hidden")));
}

namespace tisserand::formats {

std::string_view viewer_bundle() {
  return {tisserand_viewer_begin, static_cast<std::size_t>(tisserand_viewer_end - tisserand_viewer_begin)};
}

std::string header_text(const Json& header) {
  const std::string plain = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const std::string_view three = std::string_view(plain).substr(i, 3);
    if (plain[i] == '<')
      text += "\\u003c";
    else if (plain[i] == '>')
      text += "\\u003e";
    else if (plain[i] == '&')
      text += "\\u0026";
    else if (three == "\xe2\x80\xa8" || three == "\xe2\x80\xa9") {
      text += three == "\xe2\x80\xa8" ? "\\u2028" : "\\u2029";
      i += 2;
    } else
      text += plain[i];
  }
  return text;
}

std::string page_text(std::string_view bundle, Json header, const PageBlocks& blocks) {
  constexpr std::string_view mark = "<!-- tisserand-data -->";
  const std::size_t at = bundle.find(mark);
  TISSERAND_ENSURE(at != std::string_view::npos, "no data mark in the viewer of {} bytes", bundle.size());
  header["blocks"] = blocks.table();
  std::string text(bundle.substr(0, at));
  text += "<script type=\"application/json\" id=\"tisserand-header\">" + header_text(header) + "</script>\n";
  text += "<script type=\"text/plain\" id=\"tisserand-blocks\">" + base64(blocks.stream()) + "</script>";
  text += bundle.substr(at + mark.size());
  return text;
}

}  // namespace tisserand::formats
