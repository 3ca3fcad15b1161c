// The page itself: the bundle of the viewer with header and blocks put in.
#pragma once

#include <string>
#include <string_view>

#include "formats/page/page_blocks.hpp"

namespace tisserand::formats {

/// The viewer as it was built from web/ (dist/view.html); data take the place of one line of it.
std::string_view viewer_bundle();

/// JSON without characters that could end the element it stands in, or the line of a script.
std::string header_text(const Json& header);

/// `bundle` with its line `<!-- tisserand-data -->` replaced. A bundle without that line is a fault of the program.
std::string page_text(std::string_view bundle, Json header, const PageBlocks& blocks);

}  // namespace tisserand::formats
