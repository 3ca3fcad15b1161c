// SPDX-License-Identifier: GPL-3.0-or-later
// Sends a script to the standard input of gnuplot and reads the picture from its standard output.
#include "common/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "common/child.hpp"
#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand {

std::string gnuplot_quoted(const std::string& text) {
  // gnuplot 5.4 reads '' as an apostrophe, except at the beginning of a string or alone.
  std::string quoted = "'";
  for (const char c : printable_line(text, 1000)) {
    if (c == '\'')
      quoted += R"('."'".')";
    else
      quoted += c;
  }
  return quoted + "'";
}

std::string gnuplot_logarithmic_axis(const char* axis, double low, double high) {
  std::string script = fmt::format("set {}range [{:.9g}:{:.9g}]\n", axis, low, high);
  if (high > 300.0 * low) return script + fmt::format("set format {0} '10^{{%T}}'\nset {0}tics autofreq\n", axis);
  std::vector<std::string> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power)
    for (const double lead : {1.0, 2.0, 5.0})
      if (const double at = lead * std::pow(10.0, power); at >= low && at <= high)
        ticks.push_back(fmt::format("'{0:.6g}' {0:.6g}", at));
  return script + (ticks.size() < 2 ? fmt::format("set format {0} '%g'\nset {0}tics autofreq\n", axis)
                                    : fmt::format("set {}tics ({})\n", axis, join(ticks, ", ")));
}

std::string gnuplot_picture(const std::string& script, const std::string& where) {
  if (!is_program("gnuplot"))
    throw Error("gnuplot is not installed", where, "install it with: apt-get install gnuplot-nox");
  ChildRequest request;
  request.words = {"gnuplot", "-d"};  // without the user's settings
  request.input = script;
  request.most_text = std::size_t{1} << 28;
  ChildReport report = run_child(request);
  const bool failed = report.ending != ChildEnding::left || report.code != 0;
  if (failed && (report.complaint.empty() || report.complaint.find("failed to map segment") != std::string::npos))
    throw Error("gnuplot does not start: there may be too little memory", where,
                "close other programs, or raise the limit (`ulimit -v`)");
  if (failed)
    throw Error("gnuplot failed: " + report.complaint, where, "try other ranges or channels");
  constexpr std::array<std::string_view, 3> ends{"IEND\xae\x42\x60\x82", "</svg>", "%%EOF"};
  const std::string_view tail =
      std::string_view(report.text).substr(report.text.size() - std::min<std::size_t>(report.text.size(), 64));
  if (std::ranges::none_of(ends, [&](std::string_view end) { return tail.find(end) != std::string_view::npos; }))
    throw Error("the picture is incomplete: the disk is full, or the limit of the file size (`ulimit -f`) is too low",
                where, remedy_of_errno(ENOSPC));
  return std::move(report.text);
}

}  // namespace tisserand
