// The commands that read results files and draw or list channels: channels, export, plot, compare.
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

/// With the references that the words mean. Throws Error.
SeriesRequest complete(SeriesArguments arguments);

/// The same for a page or a picture of a run. Throws Error for a results file as reference: it is shown as a run.
SeriesRequest complete_for_page(const SeriesArguments& arguments);

/// All files that are read.
std::vector<std::string> drawn_files(const SeriesArguments& arguments);

/// A command that tells `about` in its own help, and the first line of it in that of the program.
CLI::App* add_command(CLI::App& app, const char* name, const char* about);

void add_history_commands(CLI::App& app);

}  // namespace tisserand::mechanism
