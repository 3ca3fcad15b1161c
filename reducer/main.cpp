// The command line of stage 1: reducer run, show, mesh. Linked twice: into the quick front and into the solver behind it.
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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

Exit codes: 0 done, 1 error, 2 wrong usage.)";

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(description, "reducer");
  app.set_version_flag("--version", "reducer " TISSERAND_VERSION " (Tisserand)");
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  using tisserand::reducer::Command;
  tisserand::reducer::Arguments arguments;
  CLI::App* const run_command = app.add_subcommand("run", "Reduce a part to a superelement file with certificate");
  run_command->add_option("part", arguments.input, "part.yaml")->required();
  run_command->add_option("-o,--output", arguments.output, "superelement file (default: beside the part)");
  run_command->add_option("--set", arguments.set, "path=value: override a value of the part, e.g. modes=4")->allow_extra_args(false);
  CLI::App* const show_command = app.add_subcommand("show", "Print the certificate of a superelement file");
  show_command->add_option("file", arguments.input, "name.superelement.h5")->required();
  CLI::App* const mesh_command = app.add_subcommand("mesh", "Mesh a part and write a gmsh file to look at");
  mesh_command->add_option("part", arguments.input, "part.yaml")->required();
  mesh_command->add_option("-o,--output", arguments.output, "gmsh file (default: beside the part)");
  mesh_command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  arguments.command = run_command->parsed()    ? Command::run
                      : show_command->parsed() ? Command::show
                                               : Command::mesh;
  try {
    return tisserand::reducer::perform(arguments, argv);
  } catch (const tisserand::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  }
  return 1;
}
