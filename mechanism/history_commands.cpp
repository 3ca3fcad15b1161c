// SPDX-License-Identifier: GPL-3.0-or-later
// Options and actions of the commands channels, export, plot and compare.
#include "mechanism/history_commands.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "common/console.hpp"
#include "common/error.hpp"
#include "common/output_path.hpp"
#include "mechanism/help.hpp"
#include "mechanism/histories/difference.hpp"
#include "mechanism/histories/plot.hpp"
#include "mechanism/histories/shown_units.hpp"
#include "mechanism/histories/tables.hpp"

namespace tisserand::mechanism {
namespace {

struct PlotWords {
  SeriesArguments series;
  PlotOptions options;
  std::vector<double> range, y_range;
  std::vector<std::string> units;
  std::string size, font;
  bool difference = false;
};

void draw(PlotWords& words) {
  PlotOptions& options = words.options;
  if (words.range.size() == 2) options.x_range = {{words.range[0], words.range[1]}};
  if (words.y_range.size() == 2) options.y_range = {{words.y_range[0], words.y_range[1]}};
  if (!words.size.empty()) options.size = parse_picture_size(words.size);
  if (!words.font.empty()) options.font = parse_picture_font(words.font);
  require_output(options.output, {".png", ".svg", ".pdf", ".eps"}, drawn_files(words.series));
  const std::vector<ShownUnit> units = parse_shown_units(words.units);
  const SeriesRequest request = complete(words.series);
  std::vector<Series> series = read_series(request);
  show_in(units, series);
  if (words.difference || !request.reference_runs.empty()) append_differences(series);
  const std::string reported = plot(series, options);
  say_of(options.output, fmt::format("{}picture: {}\n", reported, options.output));
}

void add_plot(CLI::App& app) {
  const auto kept = std::make_shared<PlotWords>();  // shared with the callback, which outlives this function
  PlotWords& words = *kept;
  CLI::App* command = add_command(app, "plot", help::about_plot);
  PlotOptions& options = words.options;
  add_series_arguments(*command, words.series);
  command->add_option("-o,--output", options.output, "picture, .png, .svg, .pdf or .eps")->required();
  command->add_flag("--difference", words.difference, "add a panel with the difference from the reference");
  command->add_option("--units", words.units, "units to show, such as mm,deg,MPa or length=mm,angle=deg")
      ->allow_extra_args(false);
  command->add_option("--size", words.size, "1400x800 (pixels), 160x100mm, 16x10cm or 6.3x4in");
  command->add_option(
      "--font", words.font,
      "name, size or both: 'DejaVu Sans,9'; size in points if --size is in mm, cm or in, else in pixels");
  command->add_option("--title", options.title, "title of the picture");
  command->add_option("--range", words.range, "first and last abscissa, in the units that are shown")->expected(2);
  command->add_option("--y-range", words.y_range, "lowest and highest ordinate, in the units that are shown")
      ->expected(2);
  command->add_option("--x-label", options.x_label, "default: name and unit of the abscissa");
  command->add_option("--y-label", options.y_label, "default: quantity and unit of the channels");
  command->add_flag_callback(
      "--log-x", [&options] { options.x_scale = AxisScale::logarithmic; }, "logarithmic abscissa");
  command->add_flag_callback(
      "--log-y", [&options] { options.y_scale = AxisScale::logarithmic; }, "logarithmic ordinate");
  command->add_flag_callback(
      "--points", [&options] { options.mark = Mark::line_with_points; }, "mark the points");
  command->callback([kept] { draw(*kept); });
}

struct TableWords {
  std::string file, output;
  std::vector<std::string> channels;
};

void add_export(CLI::App& app) {
  const auto words = std::make_shared<TableWords>();
  CLI::App* command = add_command(app, "export", help::about_export);
  command->add_option("results", words->file, "results file, also of an interrupted run")->required();
  command->add_option("--channel,-c", words->channels, "channel, group or pattern; default: all")
      ->allow_extra_args(false);
  command->add_option("-o,--output", words->output, "CSV file; - is standard output")->required();
  command->callback([words] {
    require_output(words->output, {".csv"}, {words->file});
    export_table(words->file, words->channels, words->output);
    if (!is_stream(words->output)) say(fmt::format("table: {}\n", words->output));
  });
}

void add_channels(CLI::App& app) {
  const auto words = std::make_shared<TableWords>();
  CLI::App* command = add_command(app, "channels", help::about_channels);
  command->add_option("results", words->file, "results file, also of an interrupted run")->required();
  command->add_option("--channel,-c", words->channels, "group or pattern; default: all")->allow_extra_args(false);
  command->callback([words] { say(channels_table(words->file, words->channels)); });
}

struct CompareWords {
  SeriesArguments series;
  TimeWindow window;
};

void add_compare(CLI::App& app) {
  const auto words = std::make_shared<CompareWords>();
  CLI::App* command = add_command(app, "compare", help::about_compare);
  add_series_arguments(*command, words->series);
  command->add_option("--from", words->window.from, "first instant compared [time of the run]; default: all");
  command->add_option("--to", words->window.to, "last instant compared; default: all");
  command->callback([words] { say(deviations_table(compare(complete(words->series), words->window))); });
}

}  // namespace

void add_history_commands(CLI::App& app) {
  add_export(app);
  add_channels(app);
  add_plot(app);
  add_compare(app);
}

CLI::App* add_command(CLI::App& app, const char* name, const char* about) {
  const std::string whole = about;
  CLI::App* command = app.add_subcommand(name, whole.substr(0, whole.find('\n')));
  command->preparse_callback([command, whole](std::size_t) { command->description(whole + "\n"); });
  return command;
}

void add_series_arguments(CLI::App& command, SeriesArguments& arguments) {
  command.add_option("results", arguments.request.files, "results files, also of interrupted runs");
  command
      .add_option("--channel,-c", arguments.request.channels,
                  "channel, group or pattern, e.g. nodes/position/beam/tip/*")
      ->allow_extra_args(false);
  command.add_option("--label", arguments.request.labels, "label of each file, in order")->allow_extra_args(false);
  command
      .add_option("--reference", arguments.references,
                  "file.csv:x column:y column[:label], columns by name or number; plot and compare: also "
                  "other.results.h5[:label]")
      ->allow_extra_args(false);
}

SeriesRequest complete(SeriesArguments arguments) {
  for (const std::string& text : arguments.references)
    if (auto run = parse_reference_run(text))
      arguments.request.reference_runs.push_back(std::move(*run));
    else
      arguments.request.references.push_back(parse_reference(text));
  return std::move(arguments.request);
}

SeriesRequest complete_for_page(const SeriesArguments& arguments) {
  SeriesRequest request = complete(arguments);
  if (!request.reference_runs.empty())
    throw Error("a page can have only CSV files as references", request.reference_runs.front().file,
                "give the results file as another run: the page shows both");
  return request;
}

std::vector<std::string> drawn_files(const SeriesArguments& arguments) {
  std::vector<std::string> files = arguments.request.files;
  const SeriesRequest request = complete(arguments);
  for (const ReferenceColumn& column : request.references) files.push_back(column.file);
  for (const ComparedRun& run : request.reference_runs) files.push_back(run.file);
  return files;
}

}  // namespace tisserand::mechanism
