// Pictures that gnuplot draws as a child process.
#pragma once

#include <functional>
#include <string>

namespace tisserand {

/// A gnuplot string in single quotes, in which nothing is expanded. Throws Error on control characters (a line end
/// would end the command).
std::string gnuplot_quoted(const std::string& text);

/// Has gnuplot write the picture `output` (.png, .svg): `script` makes the text that gnuplot reads from the name of the
/// file that it writes. The picture appears whole or not at all. Throws Error: no gnuplot, gnuplot's own message, a
/// folder that cannot be written, a full disk.
void draw_with_gnuplot(const std::string& output, const std::function<std::string(const std::string& picture)>& script);

}  // namespace tisserand
