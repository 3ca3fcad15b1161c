// SPDX-License-Identifier: GPL-3.0-or-later
// Commands that read results files and draw, compare or list channels: channels, export, plot, compare.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

struct SeriesArguments {
  SeriesRequest request;
  std::vector<std::string> references;
};

void add_series_arguments(CLI::App& command, SeriesArguments& arguments);

/// Request with the references parsed from the arguments. Throws Error.
SeriesRequest complete(SeriesArguments arguments);

/// Request for a page or a picture of a run. Throws Error for a results file as reference: it must be given as a run.
SeriesRequest complete_for_page(const SeriesArguments& arguments);

/// All files that the command reads.
std::vector<std::string> drawn_files(const SeriesArguments& arguments);

/// Adds a command. Its own help shows all of `about`, the help of the program shows the first line.
CLI::App* add_command(CLI::App& app, const char* name, const char* about);

void add_history_commands(CLI::App& app);

}  // namespace tisserand::mechanism
