// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that gnuplot draws as a child process.
#pragma once

#include <string>

namespace tisserand {

/// Text as a gnuplot string in single quotes, in which gnuplot expands nothing. Control characters become visible.
std::string gnuplot_quoted(const std::string& text);

/// Lines of a script for the range and ticks of a logarithmic `axis` (x or y) from `low` to `high`, both positive.
/// Ticks are at 1, 2 and 5 times powers of ten where powers alone would be few.
std::string gnuplot_logarithmic_axis(const char* axis, double low, double high);

/// Bytes of the picture that gnuplot draws from `script`. The script requires terminal pngcairo, svg or pdfcairo and
/// sets no output. No file name reaches gnuplot, which would run "|command". `where`: begins the messages. Throws Error
/// if gnuplot is missing or fails, or if the picture is incomplete.
std::string gnuplot_picture(const std::string& script, const std::string& where);

}  // namespace tisserand
