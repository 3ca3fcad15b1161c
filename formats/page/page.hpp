// SPDX-License-Identifier: GPL-3.0-or-later
// The HTML page: the bundle of the viewer with header and blocks inserted.
#pragma once

#include <string>
#include <string_view>

#include "formats/page/page_blocks.hpp"

namespace tisserand::formats {

/// Viewer built from web/ (dist/view.html). Data replace one line of it.
std::string_view viewer_bundle();

/// Text of JSON without characters that could end the HTML element or the script line around it.
std::string header_text(const Json& header);

/// `bundle` with its line `<!-- tisserand-data -->` replaced by the data. Without this line the program aborts.
std::string page_text(std::string_view bundle, Json header, const PageBlocks& blocks);

}  // namespace tisserand::formats
