// The producer of a picture, inside its file.
#pragma once

#include <string>

namespace tisserand::formats {

/// `picture` with its producer: the text "Software" of a PNG file, a comment in SVG and PDF, the line %%Creator of EPS.
/// Another kind of file, or one without the place for it, stays as it is.
std::string with_producer(std::string picture, const std::string& producer);

}  // namespace tisserand::formats
