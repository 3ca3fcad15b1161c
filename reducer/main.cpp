// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of stage 1: reducer run, solve, show, mesh, groups, import, export. It is linked into both the fast
// front program and the solver.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "common/console.hpp"
#include "common/error.hpp"
#include "common/memory/short_memory.hpp"
#include "common/program/version.hpp"
#include "reducer/commands.hpp"
#include "reducer/startup.hpp"

namespace {

constexpr const char* description =
    R"(reducer: from a part (beams, shells, solids; drawn, or from CAD, meshes and decks) to a superelement file.

    part.yaml -> mesh -> S, M -> modes -> name.superelement.h5

Examples:
  reducer run beam.part.yaml                     writes beam.superelement.h5 beside the part, prints its certificate
  reducer run beam.part.yaml -o out/arm.superelement.h5
  reducer run beam.part.yaml --set modes=4       any value of the part can be set from here
  reducer solve beam.part.yaml --modes 10        statics and modes of the part itself, with its load_cases and supports
  reducer solve beam.part.yaml --buckling 5      load factors of buckling
  reducer show beam.superelement.h5              the certificate: mass, frequencies, checks
  reducer mesh beam.part.yaml                    writes beam.msh, to look at with gmsh
  reducer view bracket.part.yaml                 bracket.part.html: the mesh, in any browser; of a recovery file also its modes
  reducer groups bracket.step -o faces.png       faces, edges, groups with numbers, sizes and forms, and a picture
  reducer section beam.part.yaml                 constants of its sections
  reducer recover beam.recovery.h5 run.results.h5   displacement and stress of the part in a run, for ParaView

A part in ten lines:
  part: beam
  materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
  sections: {tube: {shape: hollow_circle, radius: 0.03, thickness: 0.002}}
  points: {base: [0, 0, 0], tip: [2, 0, 0]}
  beams: {spar: {from: base, to: tip, section: tube, material: steel, elements: 40}}
  boundary: {base: all, tip: all}
  modes: 8

A CAD file as a shell or solid (also .geo, .msh, .iges, .brep, Nastran .bdf, Abaqus .inp):
  mesh: {file: bracket.step, size: 4, order: 2}
  solids: {body: {on: all, material: steel}}
  groups: {bore: {faces: [12, 13]}}
  spiders: {pin: {kind: rigid, on: bore}}
  boundary: [pin]

Units are those that the part names, by default m, kg, s; frequencies in 1/time (Hz).
Exit codes: 0 done, 1 error, 2 wrong usage.)";

constexpr const char* about_run = R"help(Reduces a part to a superelement file with certificate.

  reducer run beam.part.yaml
  reducer run beam.part.yaml -o out/arm.superelement.h5 --set modes=4 --set points.tip='[2, 0, 0]'
  reducer run beam.part.yaml --set cutoff=500       internal modes up to 500 1/time
  reducer run rod.part.yaml --set 'modal_body={reference: base, modes: 6}'    also rod.modal.h5, for `type: modal`
  mpirun -n 4 reducer run big.part.yaml             four processes share assembly, factorisation and eigenvalues

Writes name.superelement.h5 and name.certificate.json, whole or not at all.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_solve =
    R"help(Linear statics, modes and buckling of the unreduced part, with the supports and load cases of its file.

  reducer solve beam.part.yaml                      every load case
  reducer solve beam.part.yaml --modes 10           also the ten lowest modes of the supported part
  reducer solve beam.part.yaml --buckling 5         also the five lowest loads of buckling, as multiples of each load case
  reducer solve beam.part.yaml -o out/beam --set load_cases.tip.forces.tip.2=-100 --point 0.5,0,0

  supports: {wall: all, mid_plane: {on: cut, symmetry: x}}
  load_cases: {tip: {forces: {tip: [0, 0, -10]}}, weight: {gravity: [0, 0, -9.81]}, wind: {pressures: {skin: 200}}}

Tells the largest displacements and stresses, reactions, equilibrium, frequencies and effective masses, and load factors
of buckling. Writes name.solution.csv (displacements of named points), name.solution.CASE.vtu for each load case and
name.solution-modes.vtu, for ParaView; for buckling name.solution-buckling.csv, name.solution-buckling.CASE.vtu, and
name.solution-buckling.html with the shapes, for any browser. formats/PART.md has all loads and supports.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_show = R"help(Prints the certificate of a superelement file: mass, frequencies, checks.

  reducer show beam.superelement.h5
  reducer show beam.superelement.h5 -o beam.certificate.html     as a page with pictures (by gnuplot)

Also errors of the mesh and of dropped modes, effective masses, and for small parts the modal assurance.)help";

constexpr const char* about_mesh = R"help(Meshes a part and writes a gmsh file to look at.

  reducer mesh beam.part.yaml -o beam.msh && gmsh beam.msh

Whatever the source (drawn, CAD, mesh, deck). Physical groups: properties, springs, spiders, boundary nodes, masses.)help";

constexpr const char* about_view =
    R"help(Makes one page that shows a part in three dimensions. Any browser opens it, without a network.

  reducer view bracket.part.yaml                  bracket.part.html: groups, spiders, boundary nodes, numbers of faces, edges of
                                                  elements (key D); faulty elements in red
  reducer view bracket.step                       also a mesh, geometry or deck alone
  reducer view bracket.recovery.h5                bracket.recovery.html: the mesh, moving in each boundary and internal mode

Parts whose elements are refused by `reducer run` are shown all the same.)help";

constexpr const char* about_groups =
    R"help(Lists faces, edges, volumes, groups and sets with numbers, sizes, boxes and forms.

  reducer groups bracket.step
  reducer groups bracket.part.yaml            also plates, ... and groups that the part file defines
  reducer groups bracket.step -o faces.png    also a picture of the faces with their numbers, from two sides (or .svg)
  reducer groups bracket.step -o faces.html   also a page in which they turn, for any browser

These are the names and numbers for `on:` and `groups:` in part.yaml: face 12, 'left_hole', ...

Faces, and groups of them, are planes with their normal; cylinders, cones, spheres and tori with radius (cone: half angle;
torus: of the middle circle, then of the tube), axis and a point (of the axis; cone: apex; sphere and torus: centre);
or else curved. Normals point outward where the table says so, else they are those of the elements. Curved faces are
convex as a shaft or concave as a bore. By the geometry itself, of meshes by the corners of their elements.)help";

constexpr const char* about_section =
    R"help(Prints all constants of the sections of a part: areas, moments, torsion, shear centre.

  reducer section frame.part.yaml)help";

constexpr const char* about_recover = R"help(Displacement and stress of a part from the results of a run.

  reducer recover arm.recovery.h5 run.results.h5 --body arm -o out
  reducer recover arm.recovery.h5 run.results.h5 --times 0.1,0.2 --point tip --point 0.5,0,0
  reducer recover arm.recovery.h5 run.results.h5 --envelope --element 12 --element skin/7 --group flange
  reducer recover arm.recovery.h5 run.results.h5 --times 0.1,0.2 --loads nastran,calculix

The recovery file is written by `reducer run` if part.yaml says `recovery: yes`. Writes a series of VTU files with index
arm.pvd (open it with ParaView), the envelope over time of every element (VTU and CSV: largest von Mises stress, largest and
smallest principal stress, each with place and time), and histories of chosen nodes, elements and groups as CSV. Prints the
largest values. With --envelope there is no series; the memory does not depend on the length of the run. --loads writes forces
at all nodes for Nastran or CalculiX, whose static answer on the part's own mesh has the same stress (formats/RECOVERY.md).
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_import =
    R"help(Reduced matrices of another program become a superelement file with certificate.

  reducer import crank.pch --units mm,t,s                            Nastran DMIG KAAX, MAAX with GRID, SPOINT
  reducer import crank.pch --positions crank.bdf --matrices KGG,MGG --names 101=base,102=pin --units mm,t,s
  reducer import sub.mtx --positions nodes.inp --units mm,t,s        Abaqus *SUBSTRUCTURE MATRIX OUTPUT
  reducer import job_STIF1.mtx --mass job_MASS1.mtx --positions nodes.csv --modal 9001-9008 --units m,kg,s
  reducer import job.sti --positions job.inp --units mm,t,s          CalculiX, with job.mas and job.dof beside it
  reducer import arm.S.mtx --mass arm.M.mtx --rows arm.rows.csv --units m,kg,s      Matrix Market
  reducer import arm_S.fmx --rows arm.rows.csv --units m,kg,s        FEDEM, with arm_M.fmx beside it

The result is in canonical form, free of strain in rigid motions. reducer/exchange/EXCHANGE.md has the formats.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_export = R"help(Writes a superelement file in the form of another program.

  reducer export arm.superelement.h5 --to dmig            arm.pch: GRID, SPOINT, ASET1, DMIG KAAX and MAAX
  reducer export arm.superelement.h5 --to matrixmarket    arm.S.mtx, arm.M.mtx, arm.rows.csv: nothing is lost
  reducer export arm.superelement.h5 --to fmx             arm_S.fmx, arm_M.fmx, arm_G.fmx, arm.rows.csv: FEDEM
  reducer export arm.superelement.h5 --to mbdyn -o a.fem  data file of MBDyn's modal joint

It says what the format cannot hold. reducer/exchange/EXCHANGE.md has the formats.)help";

/// Adds a command. The list of commands shows the first line of `about`; the command's own help shows all.
CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& about, const std::string& asked) {
  return app.add_subcommand(name, asked == name ? about + "\n" : about.substr(0, about.find('\n')));
}

CLI::App* add_import(CLI::App& app, const std::string& asked, tisserand::reducer::exchange::ImportRequest& request) {
  CLI::App* const command = add_command(app, "import", about_import, asked);
  command->add_option("file", request.input, "matrices, or the stiffness matrix")->required();
  command->add_option("--units", request.units, "length,mass,time of the file, e.g. mm,t,s; or consistent")->required();
  command->add_option("-o,--output", request.output, "superelement file (default: beside the input)");
  command->add_option("--from", request.from, "dmig, abaqus, calculix, matrixmarket, fmx (default: by content)");
  command->add_option("--mass", request.mass, "file of the mass matrix");
  command->add_option("--rows", request.rows, "table of rows: row,node,component,x,y,z");
  command->add_option("--positions", request.positions, "deck with GRID or *NODE, or lines number,x,y,z");
  command->add_option("--matrices", request.matrices, "names of DMIG matrices (default: KAAX,MAAX)");
  command->add_option("--names", request.names, "names of nodes: 101=base,102=tip (default: n101, n102)");
  command->add_option("--modal", request.modal, "nodes that carry modes: 9001-9008,9100");
  return command;
}

CLI::App* add_export(CLI::App& app, const std::string& asked, tisserand::reducer::exchange::ExportRequest& request) {
  CLI::App* const command = add_command(app, "export", about_export, asked);
  command->add_option("file", request.input, "name.superelement.h5")->required();
  command->add_option("--to", request.to, "dmig, matrixmarket, fmx, mbdyn")->required();
  command->add_option("-o,--output", request.output, "file, or first of the files (default: beside the input)");
  return command;
}

CLI::App* add_recover(CLI::App& app, const std::string& asked, tisserand::reducer::RecoverRequest& request) {
  using tisserand::reducer::LoadFormat;
  using tisserand::reducer::RecoverFrame;
  CLI::App* const command = add_command(app, "recover", about_recover, asked);
  command->add_option("recovery", request.recovery, "name.recovery.h5")->required();
  command->add_option("results", request.results, "name.results.h5")->required();
  command->add_option("--body", request.body, "superelement of the results (default: the only one)");
  command->add_option("-o,--output", request.output,
                      "folder of the series (default: body.recovered beside the results)");
  command->add_option("--times", request.times, "the stored instants nearest to these (default: all)")->delimiter(',');
  command->add_option("--every", request.every, "only every n-th instant")->check(CLI::PositiveNumber);
  command->add_option("--point", request.points, "history of a node: boundary node, label, or x,y,z of the part frame")
      ->allow_extra_args(false);
  command->add_option("--element", request.elements, "history of an element: its number, or group/number")
      ->allow_extra_args(false);
  command->add_option("--group", request.groups, "history of the largest stresses of a group")->allow_extra_args(false);
  command->add_flag("--envelope", request.envelope_only, "no series: the envelope and histories only");
  command
      ->add_option("--loads", request.loads,
                   "nastran, calculix: load cases of the chosen instants for the part's own mesh, in balance")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(std::vector<std::pair<std::string, LoadFormat>>{
          {"nastran", LoadFormat::nastran}, {"calculix", LoadFormat::calculix}}));
  command->add_option("--frame", request.frame, "world, or part: at rest in its own frame")
      ->transform(CLI::CheckedTransformer(std::vector<std::pair<std::string, RecoverFrame>>{
          {"world", RecoverFrame::world}, {"part", RecoverFrame::part}}));
  return command;
}

CLI::App* add_solve(CLI::App& app, const std::string& asked, tisserand::reducer::Arguments& arguments) {
  CLI::App* const command = add_command(app, "solve", about_solve, asked);
  command->add_option("part", arguments.input, "part.yaml")->required();
  command->add_option("--modes", arguments.solve_request.modes, "number of modes, lowest first (default: none)")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--buckling", arguments.solve_request.buckling,
                   "number of load factors of buckling of each load case, lowest first (default: none)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("-o,--output", arguments.output,
                      "first part of the names of the files (default: name.solution beside the part)");
  command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  command
      ->add_option("--point", arguments.solve_request.points,
                   "one more node in the table: label, or x,y,z of the part frame")
      ->allow_extra_args(false);
  return command;
}

/// Options of commands that read mesh files.
void add_permission(CLI::App* command, tisserand::formats::MeshFile::Permission& permission) {
  command->add_flag("--trust-geometry", permission.trusted, "the geometry may read files of other folders");
  command
      ->add_option("--geometry-memory", permission.memory,
                   "GB that reading and meshing it may take (default: 4, more for large files)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--geometry-time", permission.time,
                   "seconds of processor time that it may take (default: 600, more for large files)")
      ->check(CLI::PositiveNumber);
}

/// Prints the usage error of a command line.
int tell_usage(const CLI::App& app, const CLI::ParseError& error, const std::string& asked) {
  const std::vector<std::string> commands{"run",    "solve",   "show",    "mesh",   "view",
                                          "groups", "section", "recover", "import", "export"};
  const bool known = std::find(commands.begin(), commands.end(), asked) != commands.end();
  const bool is_word = !asked.empty() && asked[0] != '-';
  std::vector<std::string> options;
  for (const CLI::Option* one : (known ? *app.get_subcommand(asked) : app).get_options())
    for (const std::string& name : one->get_lnames()) options.push_back("--" + name);
  tisserand::complain("reducer", fmt::format("{}\n`reducer {}--help` explains.",
                                             is_word && !known ? tisserand::unknown_command(asked, commands)
                                                               : tisserand::with_nearest_options(error.what(), options),
                                             known ? asked + " " : ""));
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  tisserand::fill_standard_streams();
  tisserand::take_write_failures_as_errors();
  tisserand::report_short_memory("reducer");
  const std::string asked = argc > 1 ? argv[1] : "";
  CLI::App app(description, "reducer");
  app.set_version_flag("--version", tisserand::version_text());
  app.require_subcommand(1);
  using tisserand::reducer::Command;
  tisserand::reducer::Arguments arguments;
  CLI::App* const run_command = add_command(app, "run", about_run, asked);
  run_command->add_option("part", arguments.input, "part.yaml")->required();
  run_command->add_option("-o,--output", arguments.output, "superelement file (default: beside the part)");
  run_command->add_option("--set", arguments.set, "path=value: override a value of the part, e.g. modes=4")
      ->allow_extra_args(false);
  CLI::App* const solve_command = add_solve(app, asked, arguments);
  CLI::App* const show_command = add_command(app, "show", about_show, asked);
  show_command->add_option("file", arguments.input, "name.superelement.h5")->required();
  show_command->add_option("-o,--output", arguments.output, "the certificate as a page with pictures, .html");
  CLI::App* const mesh_command = add_command(app, "mesh", about_mesh, asked);
  mesh_command->add_option("part", arguments.input, "part.yaml")->required();
  mesh_command->add_option("-o,--output", arguments.output, "gmsh file (default: beside the part)");
  mesh_command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  CLI::App* const view_command = add_command(app, "view", about_view, asked);
  view_command->add_option("file", arguments.input, "part.yaml, a mesh, geometry or deck, or name.recovery.h5")
      ->required();
  view_command->add_option("-o,--output", arguments.output, "page, .html (default: beside the file)");
  view_command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  CLI::App* const groups_command = add_command(app, "groups", about_groups, asked);
  groups_command->add_option("file", arguments.input, "part.yaml, or a mesh, geometry or deck")->required();
  groups_command->add_option("-o,--output", arguments.output,
                             "faces in colours with their numbers: .html, .png or .svg (default: none)");
  groups_command->add_option("--set", arguments.set, "path=value: override a value of the part")
      ->allow_extra_args(false);
  CLI::App* const section_command = add_command(app, "section", about_section, asked);
  section_command->add_option("part", arguments.input, "part.yaml")->required();
  section_command->add_option("--set", arguments.set, "path=value: override a value of the part")
      ->allow_extra_args(false);
  for (CLI::App* const command : {run_command, solve_command, mesh_command, view_command, groups_command})
    add_permission(command, arguments.permission);
  CLI::App* const recover_command = add_recover(app, asked, arguments.recover_request);
  CLI::App* const import_command = add_import(app, asked, arguments.import_request);
  CLI::App* const export_command = add_export(app, asked, arguments.export_request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (tisserand::reducer::is_follower()) return 0;
    return error.get_exit_code() == 0 ? app.exit(error) : tell_usage(app, error, asked);
  }
  arguments.command = run_command->parsed()    ? Command::run
                      : show_command->parsed() ? Command::show
                      : mesh_command->parsed() ? Command::mesh
                                               : Command::groups;
  if (solve_command->parsed()) arguments.command = Command::solve;
  if (view_command->parsed()) arguments.command = Command::view;
  if (section_command->parsed()) arguments.command = Command::section;
  if (recover_command->parsed()) arguments.command = Command::recover;
  if (import_command->parsed()) arguments.command = Command::import_matrices;
  if (export_command->parsed()) arguments.command = Command::export_matrices;
  try {
    return tisserand::reducer::perform(arguments, argv);
  } catch (...) {
    if (!tisserand::reducer::is_follower()) tisserand::complain_of_exception("reducer");
  }
  return 1;
}
