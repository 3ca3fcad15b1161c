// SPDX-License-Identifier: GPL-3.0-or-later
// Commands that read results files and draw, compare or list channels: channels, export, plot, compare.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

/// Arguments of a command that select series: a request, and references as unparsed text.
struct SeriesArguments {
  SeriesRequest request;
  std::vector<std::string> references;
};

/// Adds the options that fill in `arguments` to the command line parser of `command`.
void add_series_arguments(CLI::App& command, SeriesArguments& arguments);

/// Request that also contains the references, parsed from their text. Throws Error.
SeriesRequest complete(SeriesArguments arguments);

/// Request for a page or a picture of a run, with parsed references. Throws Error if a reference is a results file: for
/// a page it must be given as a run.
SeriesRequest complete_for_page(const SeriesArguments& arguments);

/// Paths of all files that the command reads: results and references.
std::vector<std::string> drawn_files(const SeriesArguments& arguments);

/// Adds the command `name` to the program. The help of the command shows all of `about`, the help of the program only
/// the first line.
CLI::App* add_command(CLI::App& app, const char* name, const char* about);

/// Adds the commands channels, export, plot and compare to the program.
void add_history_commands(CLI::App& app);

}  // namespace tisserand::mechanism
