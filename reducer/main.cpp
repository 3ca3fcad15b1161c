// The command line of stage 1: reducer run, show, mesh.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/error.hpp"
#include "formats/override.hpp"
#include "formats/part.hpp"
#include "formats/superelement.hpp"
#include "reducer/certificate.hpp"
#include "reducer/mesher.hpp"
#include "reducer/petsc.hpp"
#include "reducer/phases.hpp"
#include "reducer/reduce.hpp"
#include "reducer/startup.hpp"

namespace {

using namespace tisserand;

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

struct Arguments {
  std::string input;
  std::string output;
  std::vector<std::string> set;
};

std::vector<formats::Override> overrides(const Arguments& arguments) {
  std::vector<formats::Override> result;
  for (const std::string& text : arguments.set) result.push_back(formats::parse_override(text));
  return result;
}

/// The input's path without .part.yaml or .yaml, plus `ending`.
std::string beside(const std::string& input, const std::string& ending) {
  for (const std::string known : {".part.yaml", ".part.yml", ".yaml", ".yml"})
    if (input.size() > known.size() && input.ends_with(known)) return input.substr(0, input.size() - known.size()) + ending;
  return input + ending;
}

int run(const Arguments& arguments, char** argv) {
  reducer::prepare_environment(argv);
  reducer::Phases phases;
  phases.begin("read");
  const formats::Part part = formats::read_part(arguments.input, overrides(arguments));
  const std::string output = arguments.output.empty() ? beside(arguments.input, ".superelement.h5") : arguments.output;
  phases.begin("start solvers");
  const reducer::SolverSession session;
  reducer::Reduction reduction = reducer::reduce(part, [&phases](const std::string& phase) { phases.begin(phase); });
  phases.begin("write");
  formats::write_superelement(output, reduction.superelement);
  reducer::write_certificate(output, reduction.superelement, reduction.file, reduction.model);
  phases.end();
  fmt::print("{}", reducer::certificate_text(reduction.superelement, reduction.file, reduction.model));
  fmt::print("{:<19}{}\n{:<19}{}\n{:<19}{}\n", "time", phases.text(), "written", output, "",
             reducer::certificate_path(output));
  return 0;
}

int show(const Arguments& arguments) {
  const formats::LoadedSuperelement loaded = formats::read_superelement(arguments.input);
  const reducer::FileCertificate file = reducer::certify(loaded.superelement, loaded.report);
  fmt::print("{}", reducer::certificate_text(loaded.superelement, file,
                                             reducer::read_certificate(arguments.input, loaded.superelement.content_id)));
  return 0;
}

int mesh(const Arguments& arguments) {
  const formats::Part part = formats::read_part(arguments.input, overrides(arguments));
  const std::string output = arguments.output.empty() ? beside(arguments.input, ".msh") : arguments.output;
  const reducer::Mesh result = reducer::write_gmsh_file(part, output);
  fmt::print("{} nodes, {} elements\nwritten {} (open it with gmsh)\n", result.nodes(), result.beams.size(), output);
  return 0;
}

/// Runs a command and tells the user of an error once.
template <class Command>
int guarded(Command command) {
  try {
    return command();
  } catch (const Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  }
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(description, "reducer");
  app.set_version_flag("--version", "reducer " TISSERAND_VERSION " (Tisserand)");
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  Arguments arguments;
  CLI::App* const run_command = app.add_subcommand("run", "Reduce a part to a superelement file with certificate");
  run_command->add_option("part", arguments.input, "part.yaml")->required();
  run_command->add_option("-o,--output", arguments.output, "superelement file (default: beside the part)");
  run_command->add_option("--set", arguments.set, "path=value: override a value of the part, e.g. modes=4")->expected(1);
  CLI::App* const show_command = app.add_subcommand("show", "Print the certificate of a superelement file");
  show_command->add_option("file", arguments.input, "name.superelement.h5")->required();
  CLI::App* const mesh_command = app.add_subcommand("mesh", "Mesh a part and write a gmsh file to look at");
  mesh_command->add_option("part", arguments.input, "part.yaml")->required();
  mesh_command->add_option("-o,--output", arguments.output, "gmsh file (default: beside the part)");
  mesh_command->add_option("--set", arguments.set, "path=value: override a value of the part")->expected(1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (run_command->parsed()) return guarded([&] { return run(arguments, argv); });
  if (show_command->parsed()) return guarded([&] { return show(arguments); });
  return guarded([&] { return mesh(arguments); });
}
