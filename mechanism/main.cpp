// SPDX-License-Identifier: GPL-3.0-or-later
// Command line of `mechanism`.
#include <atomic>
#include <csignal>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "common/clock.hpp"
#include "common/console.hpp"
#include "common/error.hpp"
#include "common/memory/short_memory.hpp"
#include "common/output_path.hpp"
#include "common/program/version.hpp"
#include "common/progress.hpp"
#include "common/text.hpp"
#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"
#include "formats/yaml/override.hpp"
#include "mechanism/command_files.hpp"
#include "mechanism/help.hpp"
#include "mechanism/history_commands.hpp"
#include "mechanism/ledger/perform.hpp"
#include "mechanism/ledger/table.hpp"
#include "mechanism/run/analyses.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/study/accuracy.hpp"
#include "mechanism/study/study.hpp"
#include "mechanism/view/paraview.hpp"
#include "mechanism/view/picture.hpp"
#include "mechanism/view/view.hpp"

namespace {

using namespace tisserand;
using mechanism::add_command;
using mechanism::SeriesArguments;
using namespace tisserand::mechanism::help;

// Exit codes: 0 done, 1 error, 2 usage, 3 did not converge, 130 interrupted.
constexpr int exit_error = 1, exit_usage = 2, exit_not_converged = 3, exit_interrupted = 130;

std::atomic<bool> interrupt_requested{false};

void on_interrupt(int) { interrupt_requested = true; }

/// Makes Ctrl-C, `kill` and a closed terminal end the run in order. A second signal ends the program at once. A signal
/// that the caller ignores (nohup, a background job) stays ignored.
void listen_for_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action.sa_handler = on_interrupt;
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

struct RunArguments {
  std::string scene;
  std::string output;
  std::string analysis;
  std::string restart;
  std::optional<double> at;
  mechanism::Joining joining = mechanism::Joining::apart;
  mechanism::ChangedValues changed = mechanism::ChangedValues::refused;
  std::vector<std::string> settings;
};

formats::Scene read(const RunArguments& arguments) {
  std::vector<formats::Override> overrides;
  for (const std::string& text : arguments.settings) overrides.push_back(formats::parse_override(text));
  return formats::read_scene(arguments.scene, overrides);
}

int exit_code(const mechanism::RunReport& report) {
  using enum mechanism::RunOutcome;
  if (report.outcome == unstable) complain("mechanism", fmt::format("warning: {}", report.reason));
  if (report.outcome == not_converged) complain("mechanism", fmt::format("did not converge: {}", report.reason));
  return report.outcome == interrupted ? exit_interrupted : report.outcome == not_converged ? exit_not_converged : 0;
}

/// Reports printed so far: pre-flight warnings and notes that the analyses of a scene share, to print them once.
struct Reported {
  bool doubts = false;
  std::vector<std::string> notes;
};

/// Runs one analysis and prints its report without what `told` already holds.
mechanism::RunEnd run_one(const RunArguments& arguments, const mechanism::RunRequest& request, const std::string& name,
                          Reported& reported) {
  const double start = request.scene.integrator.start;
  Progress progress(name.empty() ? "simulating" : name, request.scene.integrator.end - start);
  mechanism::RunControl control;
  control.interrupted = [] { return interrupt_requested.load(std::memory_order_relaxed); };
  control.clock = wall_clock;
  control.progress = [&progress, start](double t) { progress.update(t - start, ""); };
  control.announce = [](const std::string& text) { complain("mechanism", text); };
  mechanism::RunEnd end = request.scene.integrator.accuracy ? mechanism::simulate_to_accuracy(request, control)
                                                            : mechanism::simulate(request, control);
  if (end.report.outcome != mechanism::RunOutcome::interrupted) progress.finish();
  if (reported.doubts) end.report.preflight = {};
  reported.doubts = reported.doubts || !mechanism::preflight_doubts(end.report.preflight, request.scene.units).empty();
  mechanism::drop_reported_notes(end.report, reported.notes);
  say(fmt::format("{}: {}{}\n{}  {:<16} {}\n", arguments.scene, request.scene.name,
                  name.empty() ? "" : fmt::format(": {}", name),
                  mechanism::report_text(end.report, request.scene.units), "results", end.report.results));
  return end;
}

int run(const RunArguments& arguments) {
  const formats::Scene scene = read(arguments);
  std::optional<mechanism::RestartFile> restart;
  if (!arguments.restart.empty()) restart = mechanism::find_restart(arguments.restart);
  const std::string output = mechanism::output_of(arguments.output, arguments.joining, restart);
  const bool chosen = !output.empty();
  std::vector<mechanism::PlannedAnalysis> planned = mechanism::plan(
      scene, arguments.analysis, {chosen ? output : mechanism::default_results(arguments.scene), chosen});
  std::vector<std::string> files_read = mechanism::inputs(scene);
  if (restart) {
    if (planned.size() > 1 && arguments.analysis.empty())
      throw Error("the scene has several analyses", arguments.scene, "choose the one to continue with --analysis");
    planned.erase(planned.begin(), planned.end() - 1);
    planned.back().from.clear();
    if (restart->checkpoint || arguments.joining == mechanism::Joining::apart) files_read.push_back(restart->path);
  }
  for (const mechanism::PlannedAnalysis& one : planned) {
    require_output(one.results, {".results.h5", ".h5"}, files_read);
    formats::require_unheld_results(one.results);
  }
  listen_for_interrupts();
  const mechanism::BodyFiles files = mechanism::read_body_files(scene);
  std::map<std::string, mechanism::State> ends;
  Reported reported;
  for (const mechanism::PlannedAnalysis& one : planned) {
    std::optional<mechanism::State> begin;
    if (!one.from.empty()) begin = ends.at(one.from);
    mechanism::RunEnd end = run_one(arguments,
                                    {one.scene, files, std::move(begin), one.results, arguments.restart, arguments.at,
                                     arguments.joining, arguments.changed},
                                    one.name, reported);
    if (const int code = exit_code(end.report); code != 0) return code;
    ends.insert_or_assign(one.name, std::move(end.state));
  }
  return interrupt_requested ? exit_interrupted : 0;
}

int check(const RunArguments& arguments) {
  const formats::Scene scene = read(arguments);
  std::vector<std::string> reported;
  for (const mechanism::PlannedAnalysis& one : mechanism::plan(scene, "", {})) {
    if (!one.from.empty()) continue;  // it starts at the end of another analysis
    mechanism::RunReport report = mechanism::inspect(one.scene, {});
    mechanism::drop_reported_notes(report, reported);
    say(fmt::format("{}: {}{}: no errors found\n{}", arguments.scene, scene.name,
                    one.name.empty() ? "" : fmt::format(": {}", one.name),
                    mechanism::report_text(report, scene.units)));
  }
  return 0;
}

struct LedgerArguments {
  RunArguments run;
  mechanism::LedgerSettings settings;
  bool json = false;
};

int ledger(const LedgerArguments& arguments) {
  listen_for_interrupts();
  Progress progress("ledger", 1.0);
  mechanism::RunControl control;
  control.interrupted = [] { return interrupt_requested.load(std::memory_order_relaxed); };
  control.clock = processor_clock;
  const formats::Scene scene = read(arguments.run);
  const mechanism::Ledger made =
      mechanism::perform_ledger(scene, arguments.run.analysis, arguments.settings, control,
                                [&](double done, const std::string& next) { progress.update(done, next); });
  if (!interrupt_requested) progress.finish();
  say(arguments.json ? mechanism::ledger_json(made)
                     : fmt::format("{}: {}: {}", scene.file, scene.name, mechanism::ledger_text(made, scene.units)));
  return interrupt_requested ? exit_interrupted : 0;
}

void add_run_arguments(CLI::App& command, RunArguments& arguments) {
  command.add_option("scene", arguments.scene, "scene file (formats/SCENE.md)")->required();
  command
      .add_option("--set", arguments.settings,
                  "change a value of the scene, e.g. integrator.step=0.005; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

int study(const mechanism::StudyRequest& request) {
  listen_for_interrupts();
  say(mechanism::perform_study(request, {[] { return interrupt_requested.load(); }, wall_clock}));
  return interrupt_requested ? exit_interrupted : 0;
}

void add_study(CLI::App& app, mechanism::StudyRequest& request, int& code) {
  CLI::App* command = add_command(app, "study", about_study);
  command->add_option("study", request.file, "study file (formats/STUDY.md)")->required();
  command->add_option("-o,--output", request.folder, "folder for runs and tables; default: <study>.study");
  command
      ->add_option("--tolerance", request.tolerance, "print the cheapest setting whose errors do not exceed this value")
      ->check(CLI::PositiveNumber);
  command->add_option("--of", request.quantity, "with --tolerance: the quantity to consider; default: all");
  command->add_flag_callback(
      "--slurm", [&] { request.place = mechanism::StudyPlace::slurm; }, "run the settings as a job array of Slurm");
  command->add_option("--task", request.task,
                      "run only the setting with this number, from 0, as a job of the array does");
  command->callback([&] { code = study(request); });
}

void add_ledger(CLI::App& app, LedgerArguments& arguments, int& code) {
  mechanism::LedgerSettings& ledger = arguments.settings;
  CLI::App* command = add_command(app, "ledger", about_ledger);
  add_run_arguments(*command, arguments.run);
  command->add_option("--analysis", arguments.run.analysis,
                      "one of the scene's `analyses`; default: the last one of type dynamics");
  command->add_option("--results", ledger.results,
                      "results file of this scene whose instants are the starts of windows; default: the scene runs "
                      "without storing results");
  command->add_option("--windows", ledger.windows.windows, "number of windows, evenly distributed over the run")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--share", ledger.windows.share,
                   "share of the run that the windows cover together; 1: the whole run")
      ->check(CLI::Range(1e-6, 1.0));
  command->add_option("--repeats", ledger.repeats, "repetitions of each window to measure its time")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--channel,-c", ledger.channels,
                   "channel, group or pattern to compare; default: positions, deflections and forces of joints")
      ->allow_extra_args(false);
  command->add_option("--effect", ledger.choice.effects, "only this effect, or inertia; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--of", ledger.choice.owners, "only of this body, joint or spring; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments.json, "print the table as JSON with all values");
  command->callback([&] { code = ::ledger(arguments); });
}

void add_page_options(CLI::App& command, mechanism::ViewRequest& page) {
  command.add_option("--title", page.title, "title; default: names of the scenes");
  command.add_option("--instants", page.instants, "largest number of instants of a run, evenly chosen")
      ->check(CLI::Range(2, 1'000'000));
  command.add_flag("--stress", page.shapes.stress,
                   "add the von Mises stress of bodies with recovery files as a colour");
  command.add_option("--recovery", page.shapes.recovery, "recovery file of a superelement of the run")
      ->allow_extra_args(false);
}

struct PictureArguments {
  SeriesArguments runs;
  mechanism::PictureRequest request;
};

void add_picture(CLI::App& app, PictureArguments& arguments) {
  mechanism::PictureRequest& request = arguments.request;
  CLI::App* command = add_command(app, "picture", about_picture);
  mechanism::add_series_arguments(*command, arguments.runs);
  add_page_options(*command, request.page);
  command->add_option("-o,--output", request.output, "picture file, .png; default: arm.png next to arm.results.h5");
  CLI::Option* time =
      command->add_option("--time,-t", request.times, "instant to draw; several: states from left to right");
  time->allow_extra_args(false);
  command->add_option("--mode", request.mode, "number of a mode of a `modes` analysis, from 1, instead of instants")
      ->check(CLI::PositiveNumber)
      ->excludes(time);
  command->add_option("--phase", request.phases_deg, "phase of the mode [deg]; several: states from left to right")
      ->allow_extra_args(false);
  command->add_option("--size", request.size, "width and height in pixels; default: 1200 700");
  command->add_option("--view", request.view,
                      "iso, front, back, left, right, top, bottom, or azimuth,elevation of the camera in degrees");
  command->add_option("--zoom", request.zoom, "zoom factor; 1: the shown objects fill the picture")
      ->check(CLI::Range(0.01, 1000.0));
  command
      ->add_option("--exaggerate", request.exaggeration,
                   "factor on deformations; default: 1, or more if the motion is invisible")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--follow", request.follow,
                      "body that the camera follows, or none; default: the heaviest body if all travel");
  command
      ->add_option("--stress-unit", request.stress_unit,
                   "Pa, kPa, MPa or GPa; default: the unit of the scene, MPa if lengths are in mm")
      ->check(CLI::IsMember(mechanism::picture_stress_units));
  command->add_flag_callback(
      "--no-sandbox", [&] { request.sandbox = mechanism::Sandbox::off; },
      "run Chromium without its sandbox, which does not work for root");
  command->add_option("--colour", request.colouring, "colour by body, displacement, deformation or stress")
      ->check(CLI::IsMember(mechanism::picture_colourings));
  command->add_option("--trace", request.traces, "node whose path is drawn")->allow_extra_args(false);
  for (auto& [option, things] : {std::pair{"--show", &request.shown}, std::pair{"--hide", &request.hidden}})
    command->add_option(option, *things, join(mechanism::picture_things(), ", "))
        ->allow_extra_args(false)
        ->check(CLI::IsMember(mechanism::picture_things()));
  command->add_flag_callback(
      "--bare", [&] { request.captions = mechanism::Captions::none; }, "draw no title and no times");
  command->callback([&] {
    request.page.shown = mechanism::complete_for_page(arguments.runs);
    if (request.output.empty()) request.output = mechanism::default_page(request.page.shown.files, ".png");
    require_output(request.output, {".png"}, mechanism::drawn_files(arguments.runs));
    say_of(request.output, mechanism::picture(request));
  });
}

/// Prints what is wrong with the command line, and the nearest valid words.
int report_usage(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<std::string> commands, options;
  const CLI::App* command = nullptr;
  for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(one->get_name());
    if (argc > 1 && one->get_name() == argv[1]) command = one;
  }
  for (const CLI::Option* one : (command == nullptr ? app : *command).get_options())
    for (const std::string& name : one->get_lnames()) options.push_back("--" + name);
  const bool is_word = argc > 1 && argv[1][0] != '-';
  complain("mechanism", fmt::format("{}\n`mechanism {}--help` explains.",
                                    is_word && command == nullptr ? unknown_command(argv[1], commands)
                                                                  : with_nearest_options(error.what(), options),
                                    command == nullptr ? "" : command->get_name() + " "));
  return exit_usage;
}

int command_line(int argc, char** argv) {
  CLI::App app{about};
  app.name("mechanism");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  int code = 0;

  RunArguments run_arguments;
  CLI::App* run_command = add_command(app, "run", about_run);
  add_run_arguments(*run_command, run_arguments);
  run_command->add_option("-o,--output", run_arguments.output,
                          "results file; default: <scene>.results.h5 next to the scene");
  run_command->add_option(
      "--analysis", run_arguments.analysis,
      "run only one of the scene's `analyses`, after those from which it starts; default: all, in order");
  run_command->add_option("--restart", run_arguments.restart,
                          "continue from a checkpoint or from an instant of a results file; needs -o or --append");
  run_command->add_option("--at", run_arguments.at,
                          "with --restart: a stored instant of a results file; default: the last");
  run_command->add_flag_callback(
      "--append", [&] { run_arguments.joining = mechanism::Joining::appended; },
      "with --restart: also store the rows of the previous run; without -o, the new file replaces its results");
  run_command->add_flag_callback(
      "--changed", [&] { run_arguments.changed = mechanism::ChangedValues::accepted; },
      "with --restart: continue although values of the scene have changed");
  run_command->callback([&] { code = run(run_arguments); });

  RunArguments check_arguments;
  CLI::App* check_command = add_command(app, "check", about_check);
  add_run_arguments(*check_command, check_arguments);
  check_command->callback([&] { code = check(check_arguments); });

  mechanism::StudyRequest study_request;
  add_study(app, study_request, code);

  LedgerArguments ledger_arguments;
  add_ledger(app, ledger_arguments, code);

  mechanism::add_history_commands(app);

  SeriesArguments view_arguments;
  mechanism::ViewRequest view_request;
  std::string paraview;
  CLI::App* view_command = add_command(app, "view", about_view);
  mechanism::add_series_arguments(*view_command, view_arguments);
  CLI::Option* page = view_command->add_option("-o,--output", view_request.output,
                                               "page, .html; default: arm.html next to arm.results.h5");
  view_command
      ->add_option("--paraview", paraview, "write files for ParaView (.pvd, .vtu) to this folder instead of a page")
      ->excludes(page);
  add_page_options(*view_command, view_request);
  view_command->callback([&] {
    view_request.shown = mechanism::complete_for_page(view_arguments);
    if (view_request.output.empty()) view_request.output = mechanism::default_page(view_request.shown.files, ".html");
    if (!paraview.empty()) return say(mechanism::write_paraview(view_request, paraview));
    require_output(view_request.output, {".html"}, mechanism::drawn_files(view_arguments));
    say_of(view_request.output, mechanism::view(view_request));
  });

  PictureArguments picture_arguments;
  add_picture(app, picture_arguments);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : report_usage(app, error, argc, argv);
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  tisserand::fill_standard_streams();
  tisserand::take_write_failures_as_errors();
  tisserand::report_short_memory("mechanism");
  try {
    return command_line(argc, argv);
  } catch (...) {
    tisserand::complain_of_exception("mechanism");
  }
  return exit_error;
}
