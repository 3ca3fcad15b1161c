// The commands that read results files and draw or list channels: channels, export, plot, compare.
#pragma once

#include <memory>
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

/// The first line of a help text.
std::string first_line(const char* text);

/// Where the words of the commands are kept while the command line is read.
class HistoryCommands {
 public:
  explicit HistoryCommands(CLI::App& app);
  ~HistoryCommands();
  HistoryCommands(const HistoryCommands&) = delete;
  HistoryCommands& operator=(const HistoryCommands&) = delete;

 private:
  struct Words;
  std::unique_ptr<Words> words_;
};

}  // namespace tisserand::mechanism
