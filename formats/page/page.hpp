// SPDX-License-Identifier: GPL-3.0-or-later
// The HTML page: the bundle of the viewer with header and blocks inserted.
#pragma once

#include <string>
#include <string_view>

#include "formats/page/page_blocks.hpp"

namespace tisserand::formats {

/// HTML of the viewer, built from web/ (dist/view.html). page_text() replaces one line of it by data.
std::string_view viewer_bundle();

/// Text of a JSON header without characters that could end the HTML element or the script line around it.
std::string header_text(const Json& header);

/// Page: `bundle` with its line `<!-- tisserand-data -->` replaced by header and blocks. Without this line the program
/// aborts.
std::string page_text(std::string_view bundle, Json header, const PageBlocks& blocks);

}  // namespace tisserand::formats
