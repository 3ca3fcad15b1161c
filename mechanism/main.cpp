// Command line of the second stage.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/error.hpp"
#include "common/progress.hpp"
#include "formats/override.hpp"
#include "formats/scene.hpp"
#include "mechanism/plot.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/tables.hpp"

namespace {

using namespace tisserand;

// Exit codes: 0 done, 1 error, 2 usage, 3 did not converge, 130 interrupted.
constexpr int exit_error = 1, exit_usage = 2, exit_not_converged = 3, exit_interrupted = 130;

std::atomic<bool> interrupt_requested{false};

void on_interrupt(int) { interrupt_requested = true; }

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// "dir/pendulum.scene.yaml" -> "pendulum.results.h5" in the working folder.
std::string default_results(const std::string& scene) {
  std::string stem = std::filesystem::path(scene).filename().string();
  for (const char* ending : {".yaml", ".yml", ".scene"})
    if (stem.ends_with(ending)) stem.resize(stem.size() - std::string(ending).size());
  return stem + ".results.h5";
}

struct RunArguments {
  std::string scene;
  std::string output;
  std::vector<std::string> settings;
};

formats::Scene read(const RunArguments& arguments) {
  std::vector<formats::Override> overrides;
  for (const std::string& text : arguments.settings) overrides.push_back(formats::parse_override(text));
  return formats::read_scene(arguments.scene, overrides);
}

int run(const RunArguments& arguments) {
  const formats::Scene scene = read(arguments);
  const std::string path = arguments.output.empty() ? default_results(arguments.scene) : arguments.output;
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  const double start = scene.integrator.start;
  Progress progress("simulating", scene.integrator.end - start);
  mechanism::RunControl control;
  control.interrupted = [] { return interrupt_requested.load(std::memory_order_relaxed); };
  control.clock = wall_clock;
  control.progress = [&progress, start](double t) { progress.update(t - start, ""); };
  const mechanism::RunReport report = mechanism::simulate(scene, path, control);
  progress.finish();
  fmt::print("{}: {}\n{}  {:<16} {}\n", arguments.scene, scene.name, mechanism::report_text(report, scene.units), "results",
             report.results);
  switch (report.outcome) {
    case mechanism::RunOutcome::completed: return 0;
    case mechanism::RunOutcome::not_converged:
      fmt::print(stderr, "mechanism: did not converge: {}\n", report.reason);
      return exit_not_converged;
    case mechanism::RunOutcome::interrupted: return exit_interrupted;
  }
  return exit_error;
}

int check(const RunArguments& arguments) {
  const formats::Scene scene = read(arguments);
  const mechanism::RunReport report = mechanism::inspect(scene, {});
  fmt::print("{}: {}: no errors found\n{}", arguments.scene, scene.name, mechanism::report_text(report, scene.units));
  return 0;
}

void add_run_arguments(CLI::App& command, RunArguments& arguments) {
  command.add_option("scene", arguments.scene, "scene file (formats/SCENE.md)")->required();
  command.add_option("--set", arguments.settings, "change a value of the scene: path=value, e.g. integrator.step=0.005")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

struct SeriesArguments {
  mechanism::SeriesRequest request;
  std::vector<std::string> references;
};

void add_series_arguments(CLI::App& command, SeriesArguments& arguments) {
  command.add_option("results", arguments.request.files, "results files, also of interrupted runs");
  command.add_option("--channel,-c", arguments.request.channels, "channel, group or pattern, e.g. nodes/position/beam/tip/*")
      ->allow_extra_args(false);
  command.add_option("--label", arguments.request.labels, "label of each file, in order")->allow_extra_args(false);
  command.add_option("--reference", arguments.references, "history from a CSV file: file.csv:x column:y column[:label]")
      ->allow_extra_args(false);
}

mechanism::SeriesRequest complete(SeriesArguments arguments) {
  for (const std::string& text : arguments.references)
    arguments.request.references.push_back(mechanism::parse_reference(text));
  return arguments.request;
}

int command_line(int argc, char** argv) {
  CLI::App app{"mechanism: dynamics and statics of flexible mechanisms from superelement files.\n\n"
               "  superelement.h5 + scene.yaml -> model -> steps -> results.h5 -> pictures and tables\n\n"
               "Example:\n"
               "  mechanism check examples/hinged_beam/floating_b.scene.yaml\n"
               "  mechanism run examples/hinged_beam/floating_b.scene.yaml --set integrator.step=0.005 -o b.results.h5\n"
               "  mechanism plot b.results.h5 -c nodes/angular_velocity/beam/base/z -o b.png\n\n"
               "Exit codes: 0 done, 1 error, 2 wrong usage, 3 did not converge, 130 interrupted."};
  app.name("mechanism");
  app.set_version_flag("--version", std::string("tisserand mechanism ") + TISSERAND_VERSION);
  app.require_subcommand(1);
  int code = 0;

  RunArguments run_arguments;
  CLI::App* run_command = app.add_subcommand("run", "simulate a scene and write its results");
  add_run_arguments(*run_command, run_arguments);
  run_command->add_option("-o,--output", run_arguments.output, "results file; default: <scene>.results.h5 in this folder");
  run_command->callback([&] { code = run(run_arguments); });

  RunArguments check_arguments;
  CLI::App* check_command =
      app.add_subcommand("check", "read everything, count coordinates, constraints and mobility, run nothing");
  add_run_arguments(*check_command, check_arguments);
  check_command->callback([&] { code = check(check_arguments); });

  std::string export_file, export_output;
  std::vector<std::string> export_channels;
  CLI::App* export_command = app.add_subcommand("export", "write channels of a results file as CSV");
  export_command->add_option("results", export_file, "results file, also of an interrupted run")->required();
  export_command->add_option("--channel,-c", export_channels, "channel, group or pattern; default: all")->allow_extra_args(false);
  export_command->add_option("-o,--output", export_output, "CSV file")->required();
  export_command->callback([&] { mechanism::export_table(export_file, export_channels, export_output); });

  std::string channels_file;
  std::vector<std::string> channels_patterns;
  CLI::App* channels_command = app.add_subcommand("channels", "list the channels of a results file with their units");
  channels_command->add_option("results", channels_file, "results file, also of an interrupted run")->required();
  channels_command->add_option("--channel,-c", channels_patterns, "group or pattern; default: all")->allow_extra_args(false);
  channels_command->callback([&] { fmt::print("{}", mechanism::channels_table(channels_file, channels_patterns)); });

  SeriesArguments plot_arguments;
  mechanism::PlotOptions plot_options;
  std::vector<double> plot_range, plot_y_range;
  CLI::App* plot_command = app.add_subcommand("plot", "draw channels of results files over one another (png or svg)");
  add_series_arguments(*plot_command, plot_arguments);
  plot_command->add_option("-o,--output", plot_options.output, "picture, .png or .svg")->required();
  plot_command->add_option("--title", plot_options.title, "title of the picture");
  plot_command->add_option("--range", plot_range, "first and last abscissa")->expected(2);
  plot_command->add_option("--y-range", plot_y_range, "lowest and highest ordinate")->expected(2);
  plot_command->add_option("--x-label", plot_options.x_label, "default: name and unit of the abscissa");
  plot_command->add_option("--y-label", plot_options.y_label, "default: quantity and unit of the channels");
  plot_command->add_flag_callback("--log-x", [&] { plot_options.x_scale = mechanism::AxisScale::logarithmic; });
  plot_command->add_flag_callback("--log-y", [&] { plot_options.y_scale = mechanism::AxisScale::logarithmic; });
  plot_command->add_flag_callback("--points", [&] { plot_options.mark = mechanism::Mark::line_with_points; },
                                  "mark the points");
  plot_command->callback([&] {
    if (plot_range.size() == 2) plot_options.x_range = {{plot_range[0], plot_range[1]}};
    if (plot_y_range.size() == 2) plot_options.y_range = {{plot_y_range[0], plot_y_range[1]}};
    mechanism::plot(mechanism::read_series(complete(plot_arguments)), plot_options);
    fmt::print("picture: {}\n", plot_options.output);
  });

  SeriesArguments compare_arguments;
  mechanism::TimeWindow window;
  CLI::App* compare_command = app.add_subcommand("compare", "measure channels against a reference history");
  add_series_arguments(*compare_command, compare_arguments);
  compare_command->add_option("--from", window.from, "first instant compared");
  compare_command->add_option("--to", window.to, "last instant compared");
  compare_command->callback(
      [&] { fmt::print("{}", mechanism::deviations_table(mechanism::compare(complete(compare_arguments), window))); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return command_line(argc, argv);
  } catch (const tisserand::Error& error) {
    fmt::print(stderr, "mechanism: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "mechanism: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "mechanism: internal error: {}\n", error.what());
  }
  return exit_error;
}
