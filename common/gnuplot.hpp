// Pictures that gnuplot draws as a child process.
#pragma once

#include <string>

namespace tisserand {

/// A gnuplot string in single quotes, in which nothing is expanded, joined with apostrophes; control characters become visible.
std::string gnuplot_quoted(const std::string& text);

/// Range and ticks of a logarithmic `axis` (x or y) from `low` to `high`, both positive, as lines of a script: ticks at 1, 2
/// and 5 times powers of ten where powers alone would be few.
std::string gnuplot_logarithmic_axis(const char* axis, double low, double high);

/// The picture that gnuplot makes of `script`, whose terminal is pngcairo, svg or pdfcairo, with no output set: no name
/// of a file reaches gnuplot, which would run "|command". `where`: what messages name. Throws Error: no gnuplot,
/// gnuplot's own message, a picture that is cut short.
std::string gnuplot_picture(const std::string& script, const std::string& where);

}  // namespace tisserand
