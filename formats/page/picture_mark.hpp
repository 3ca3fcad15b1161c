// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the name of the producing program into picture files.
#pragma once

#include <string>

namespace tisserand::formats {

/// `picture` with the name of its producer: text "Software" in PNG, a comment in SVG and PDF, the line %%Creator in
/// EPS. Other files, and files without the place for it, are returned unchanged.
std::string with_producer(std::string picture, const std::string& producer);

}  // namespace tisserand::formats
