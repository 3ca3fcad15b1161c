// The command line of stage 1: reducer run, show, mesh. Linked twice: into the quick front and into the solver behind
// it.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "common/console.hpp"
#include "common/error.hpp"
#include "reducer/commands.hpp"

namespace {

constexpr const char* description =
    R"(reducer: from a part (beams, masses, boundary nodes) to a superelement file.

    part.yaml -> mesh -> S, M -> modes -> name.superelement.h5

Examples:
  reducer run beam.part.yaml                     writes beam.superelement.h5 beside the part, prints its certificate
  reducer run beam.part.yaml -o out/arm.superelement.h5
  reducer run beam.part.yaml --set modes=4       any value of the part can be set from here
  reducer show beam.superelement.h5              the certificate: mass, frequencies, checks
  reducer mesh beam.part.yaml                    writes beam.msh, to look at with gmsh

A part in ten lines:
  part: beam
  materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
  sections: {tube: {shape: hollow_circle, radius: 0.03, thickness: 0.002}}
  points: {base: [0, 0, 0], tip: [2, 0, 0]}
  beams: {spar: {from: base, to: tip, section: tube, material: steel, elements: 40}}
  boundary: {base: all, tip: all}
  modes: 8

Units are those that the part names, by default m, kg, s; frequencies in 1/time (Hz).
Exit codes: 0 done, 1 error, 2 wrong usage.)";

constexpr const char* about_run = R"help(Reduces a part to a superelement file with certificate.

  reducer run beam.part.yaml
  reducer run beam.part.yaml -o out/arm.superelement.h5 --set modes=4 --set points.tip='[2, 0, 0]'
  reducer run beam.part.yaml --set cutoff=500       internal modes up to 500 1/time

Writes name.superelement.h5 and name.certificate.json, whole or not at all.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_show = R"help(Prints the certificate of a superelement file: mass, frequencies, checks.

  reducer show beam.superelement.h5)help";

constexpr const char* about_mesh = R"help(Meshes a part and writes a gmsh file to look at.

  reducer mesh beam.part.yaml -o beam.msh && gmsh beam.msh)help";

/// The list of commands shows one line of each; its own help shows all.
CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& about, const std::string& asked) {
  return app.add_subcommand(name, asked == name ? about + "\n" : about.substr(0, about.find('\n')));
}

/// Prints what is wrong with the words of the command line.
int tell_usage(const CLI::ParseError& error, const std::string& asked) {
  const std::vector<std::string> commands{"run", "show", "mesh"};
  const bool known = std::find(commands.begin(), commands.end(), asked) != commands.end();
  const bool is_word = !asked.empty() && asked[0] != '-';
  fmt::print(stderr, "reducer: {}\n`reducer {}--help` explains.\n",
             is_word && !known ? tisserand::unknown_command(asked, commands) : std::string(error.what()),
             known ? asked + " " : "");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  tisserand::take_write_failures_as_errors();
  const std::string asked = argc > 1 ? argv[1] : "";
  CLI::App app(description, "reducer");
  app.set_version_flag("--version", "reducer " TISSERAND_VERSION " (Tisserand)");
  app.require_subcommand(1);
  using tisserand::reducer::Command;
  tisserand::reducer::Arguments arguments;
  CLI::App* const run_command = add_command(app, "run", about_run, asked);
  run_command->add_option("part", arguments.input, "part.yaml")->required();
  run_command->add_option("-o,--output", arguments.output, "superelement file (default: beside the part)");
  run_command->add_option("--set", arguments.set, "path=value: override a value of the part, e.g. modes=4")
      ->allow_extra_args(false);
  CLI::App* const show_command = add_command(app, "show", about_show, asked);
  show_command->add_option("file", arguments.input, "name.superelement.h5")->required();
  CLI::App* const mesh_command = add_command(app, "mesh", about_mesh, asked);
  mesh_command->add_option("part", arguments.input, "part.yaml")->required();
  mesh_command->add_option("-o,--output", arguments.output, "gmsh file (default: beside the part)");
  mesh_command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : tell_usage(error, asked);
  }
  arguments.command = run_command->parsed() ? Command::run : show_command->parsed() ? Command::show : Command::mesh;
  try {
    return tisserand::reducer::perform(arguments, argv);
  } catch (const tisserand::Error& error) {
    fmt::print(stderr, "reducer: {}\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "reducer: {}\n", error.what());
  }
  return 1;
}
