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
    R"(reducer: reduces a part of beams, shells and solids to a superelement file.
The part is described in a text file. Its mesh can also come from CAD, a mesh file or a deck.

    part.yaml -> mesh -> S, M -> modes -> name.superelement.h5

Examples:
  reducer run beam.part.yaml                     writes beam.superelement.h5 next to the part, prints its certificate
  reducer run beam.part.yaml -o out/arm.superelement.h5
  reducer run beam.part.yaml --set modes=4       any value of the part can be changed for one run
  reducer solve beam.part.yaml --modes 10        statics and modes of the unreduced part with its supports
  reducer solve beam.part.yaml --buckling 5      load factors of buckling
  reducer show beam.superelement.h5              the certificate: mass, frequencies, checks
  reducer mesh beam.part.yaml                    writes beam.msh; open it with gmsh
  reducer view bracket.part.yaml                 writes bracket.part.html, which shows the mesh in any browser
  reducer groups bracket.step -o faces.png       lists faces, edges and groups with numbers and forms; draws faces
  reducer section beam.part.yaml                 area, moments and other constants of its sections
  reducer recover beam.recovery.h5 run.results.h5   displacement and stress of the part in a run, for ParaView

A part in ten lines:
  part: beam
  materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
  sections: {tube: {shape: hollow_circle, radius: 0.03, thickness: 0.002}}
  points: {base: [0, 0, 0], tip: [2, 0, 0]}
  beams: {spar: {from: base, to: tip, section: tube, material: steel, elements: 40}}
  boundary: {base: all, tip: all}
  modes: 8

A CAD file that is meshed as shell or solid (also .geo, .msh, .iges, .brep, Nastran .bdf, Abaqus .inp):
  mesh: {file: bracket.step, size: 4, order: 2}
  solids: {body: {on: all, material: steel}}
  groups: {bore: {faces: [12, 13]}}
  spiders: {pin: {kind: rigid, on: bore}}
  boundary: [pin]

Units are those of `units:` in the part file, by default m, kg, s. Frequencies are in 1/time, which is Hz for s.
Exit codes: 0 done, 1 error, 2 wrong usage.)";

constexpr const char* about_run = R"help(Reduces a part to a superelement file and writes its certificate.

  reducer run beam.part.yaml
  reducer run beam.part.yaml -o out/arm.superelement.h5 --set modes=4 --set points.tip='[2, 0, 0]'
  reducer run beam.part.yaml --set cutoff=500       all internal modes up to 500 1/time
  reducer run rod.part.yaml --set 'modal_body={reference: base, modes: 6}'    writes also rod.modal.h5: `type: modal`
  mpirun -n 4 reducer run big.part.yaml             four processes share assembly, factorisation and eigenvalues

Writes name.superelement.h5 and name.superelement.certificate.json. A run that fails writes neither.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_solve =
    R"help(Linear statics, modes and buckling of the unreduced part, with the supports and load cases of its file.

  reducer solve beam.part.yaml                      every load case
  reducer solve beam.part.yaml --modes 10           also the ten lowest modes of the supported part
  reducer solve beam.part.yaml --buckling 5         also the five lowest buckling loads, as multiples of each load case
  reducer solve beam.part.yaml -o out/beam --set load_cases.tip.forces.tip.2=-100 --point 0.5,0,0

  supports: {wall: all, mid_plane: {on: cut, symmetry: x}}
  load_cases: {tip: {forces: {tip: [0, 0, -10]}}, weight: {gravity: [0, 0, -9.81]}, wind: {pressures: {skin: 200}}}

Prints the largest displacements and stresses, reactions, equilibrium, frequencies, effective masses and load factors of
buckling. Writes these files:
  name.solution.csv                    displacements of named points
  name.solution.CASE.vtu               displacements and stresses of each load case, for ParaView
  name.solution-modes.vtu              modes, for ParaView
  name.solution-buckling.csv           load factors of buckling
  name.solution-buckling.CASE.vtu      buckling shapes of each load case, for ParaView
  name.solution-buckling.html          buckling shapes, for any browser
formats/PART.md describes all loads and supports.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_show = R"help(Prints the certificate of a superelement file: mass, frequencies, checks.

  reducer show beam.superelement.h5
  reducer show beam.superelement.h5 -o beam.certificate.html     a page with pictures (needs gnuplot)

The certificate also holds the errors by the mesh and by dropped modes, and effective masses. For small parts it holds
the modal assurance criterion (MAC).)help";

constexpr const char* about_mesh = R"help(Meshes a part and writes the mesh as a gmsh file, for a check by eye.

  reducer mesh beam.part.yaml -o beam.msh && gmsh beam.msh

This works for every source: drawn parts, CAD, meshes and decks. The physical groups are properties, springs, spiders,
boundary nodes and masses.)help";

constexpr const char* about_view =
    R"help(Makes one page that shows a part in three dimensions. Any browser opens it, without a network.

  reducer view bracket.part.yaml                  writes bracket.part.html: groups, spiders, boundary nodes, numbers of
                                                  faces, edges of elements (key D); faulty elements in red
  reducer view bracket.step                       the same for a mesh, geometry or deck without a part file
  reducer view bracket.recovery.h5                writes bracket.recovery.html: boundary and internal modes in motion

Parts are also shown if `reducer run` refuses their elements.)help";

constexpr const char* about_groups =
    R"help(Lists faces, edges, volumes, groups and sets with their numbers, sizes, bounding boxes and forms.

  reducer groups bracket.step
  reducer groups bracket.part.yaml            lists also surfaces and groups that the part file defines
  reducer groups bracket.step -o faces.png    also draws the faces with their numbers in two views (or .svg)
  reducer groups bracket.step -o faces.html   also writes a page for any browser, in which the view can be turned

Use these names and numbers for `on:` and `groups:` in part.yaml: face 12, 'left_hole', ...

Forms of faces and of groups of faces:
  plane       normal
  cylinder    radius, axis, a point of the axis
  cone        half angle, axis, apex
  sphere      radius, centre
  torus       radius of the middle circle, radius of the tube, axis, centre
  curved      any other face
Normals point outward where the table says so. Otherwise they are the normals of the elements. Curved faces are convex
like a shaft or concave like a bore. Forms come from the geometry. For meshes they come from corners of elements.)help";

constexpr const char* about_section =
    R"help(Prints all constants of the sections of a part: areas, second moments of area, torsion, shear centre.

  reducer section frame.part.yaml)help";

constexpr const char* about_recover = R"help(Computes displacement and stress of a part from the results of a run.

  reducer recover arm.recovery.h5 run.results.h5 --body arm -o out
  reducer recover arm.recovery.h5 run.results.h5 --times 0.1,0.2 --point tip --point 0.5,0,0
  reducer recover arm.recovery.h5 run.results.h5 --envelope --element 12 --element skin/7 --group flange
  reducer recover arm.recovery.h5 run.results.h5 --times 0.1,0.2 --loads nastran,calculix

`reducer run` writes the recovery file if part.yaml contains `recovery: yes`. This command prints the largest values and
writes:
  - a series of VTU files with the index arm.pvd (open it with ParaView), unless --envelope is given;
  - the envelope over time of every element as VTU and CSV: the largest von Mises stress and the largest and smallest
    principal stress, each with place and time;
  - histories of chosen nodes, elements and groups as CSV;
  - with --loads, forces at all nodes for Nastran or CalculiX. A static analysis of the part's own mesh under these
    forces gives the same stress (formats/RECOVERY.md).
With --envelope the memory does not depend on the length of the run.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_import =
    R"help(Converts reduced matrices of another program to a superelement file and writes its certificate.

  reducer import crank.pch --units mm,t,s                            Nastran DMIG KAAX, MAAX with GRID, SPOINT
  reducer import crank.pch --positions crank.bdf --matrices KGG,MGG --names 101=base,102=pin --units mm,t,s
  reducer import sub.mtx --positions nodes.inp --units mm,t,s        Abaqus *SUBSTRUCTURE MATRIX OUTPUT
  reducer import job_STIF1.mtx --mass job_MASS1.mtx --positions nodes.csv --modal 9001-9008 --units m,kg,s
  reducer import job.sti --positions job.inp --units mm,t,s          CalculiX, with job.mas and job.dof next to it
  reducer import arm.S.mtx --mass arm.M.mtx --rows arm.rows.csv --units m,kg,s      Matrix Market
  reducer import arm_S.fmx --rows arm.rows.csv --units m,kg,s        FEDEM, with arm_M.fmx next to it

The result is in canonical form. Its rigid-body motions cause no strain. The formats are in
reducer/exchange/EXCHANGE.md.
Exit codes: 0 done, 1 error, 2 wrong usage.)help";

constexpr const char* about_export = R"help(Writes a superelement file in the form of another program.

  reducer export arm.superelement.h5 --to dmig            arm.pch: GRID, SPOINT, ASET1, DMIG KAAX and MAAX
  reducer export arm.superelement.h5 --to matrixmarket    arm.S.mtx, arm.M.mtx, arm.rows.csv: nothing is lost
  reducer export arm.superelement.h5 --to fmx             arm_S.fmx, arm_M.fmx, arm_G.fmx, arm.rows.csv: FEDEM
  reducer export arm.superelement.h5 --to mbdyn -o a.fem  data file of MBDyn's modal joint

The command reports what the format cannot hold. reducer/exchange/EXCHANGE.md describes the formats.)help";

/// Adds a command. The list of commands shows the first line of `about`; the command's own help shows all.
CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& about, const std::string& asked) {
  return app.add_subcommand(name, asked == name ? about + "\n" : about.substr(0, about.find('\n')));
}

CLI::App* add_import(CLI::App& app, const std::string& asked, tisserand::reducer::exchange::ImportRequest& request) {
  CLI::App* const command = add_command(app, "import", about_import, asked);
  command->add_option("file", request.input, "matrices, or the stiffness matrix")->required();
  command->add_option("--units", request.units, "length,mass,time of the file, e.g. mm,t,s; or consistent")->required();
  command->add_option("-o,--output", request.output, "superelement file (default: next to the input)");
  command->add_option("--from", request.from, "dmig, abaqus, calculix, matrixmarket, fmx (default: by content)");
  command->add_option("--mass", request.mass, "mass matrix, if it is in its own file");
  command->add_option("--rows", request.rows, "table of rows: row,node,component,x,y,z");
  command->add_option("--positions", request.positions, "deck with GRID or *NODE, or lines number,x,y,z");
  command->add_option("--matrices", request.matrices, "names of DMIG matrices (default: KAAX,MAAX)");
  command->add_option("--names", request.names, "names of nodes: 101=base,102=tip (default: n101, n102)");
  command->add_option("--modal", request.modal, "nodes whose coordinates are modes: 9001-9008,9100");
  return command;
}

CLI::App* add_export(CLI::App& app, const std::string& asked, tisserand::reducer::exchange::ExportRequest& request) {
  CLI::App* const command = add_command(app, "export", about_export, asked);
  command->add_option("file", request.input, "name.superelement.h5")->required();
  command->add_option("--to", request.to, "dmig, matrixmarket, fmx, mbdyn")->required();
  command->add_option("-o,--output", request.output, "output file, or the first of them (default: next to the input)");
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
                      "folder of the series (default: body.recovered next to the results)");
  command->add_option("--times", request.times, "times: use the stored instants nearest to them (default: all)")
      ->delimiter(',');
  command->add_option("--every", request.every, "only every n-th instant")->check(CLI::PositiveNumber);
  command->add_option("--point", request.points, "history of a node: boundary node, label, or x,y,z in the part frame")
      ->allow_extra_args(false);
  command->add_option("--element", request.elements, "history of an element: its number, or group/number")
      ->allow_extra_args(false);
  command->add_option("--group", request.groups, "history of the largest stresses of a group")->allow_extra_args(false);
  command->add_flag("--envelope", request.envelope_only, "write only the envelope and histories, no series");
  command
      ->add_option("--loads", request.loads,
                   "nastran, calculix: write each chosen instant as a load case in equilibrium for the part's own mesh")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(std::vector<std::pair<std::string, LoadFormat>>{
          {"nastran", LoadFormat::nastran}, {"calculix", LoadFormat::calculix}}));
  command
      ->add_option("--frame", request.frame,
                   "world: as it moves; part: displacement in the part's own frame (default: world)")
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
                      "beginning of the names of the output files (default: name.solution next to the part)");
  command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  command
      ->add_option("--point", arguments.solve_request.points,
                   "additional node of the table: label, or x,y,z in the part frame")
      ->allow_extra_args(false);
  return command;
}

/// Options of commands that read mesh files.
void add_permission(CLI::App* command, tisserand::formats::MeshFile::Permission& permission) {
  command->add_flag("--trust-geometry", permission.trusted, "allow the geometry to read files in other folders");
  command
      ->add_option("--geometry-memory", permission.memory,
                   "limit of memory in GB for reading and meshing the geometry (default: 4, more for large files)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option(
          "--geometry-time", permission.time,
          "limit of processor time in s for reading and meshing the geometry (default: 600, more for large files)")
      ->check(CLI::PositiveNumber);
}

/// Prints the usage error of a command line.
int report_usage(const CLI::App& app, const CLI::ParseError& error, const std::string& asked) {
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
  run_command->add_option("-o,--output", arguments.output, "superelement file (default: next to the part)");
  run_command->add_option("--set", arguments.set, "path=value: override a value of the part, e.g. modes=4")
      ->allow_extra_args(false);
  CLI::App* const solve_command = add_solve(app, asked, arguments);
  CLI::App* const show_command = add_command(app, "show", about_show, asked);
  show_command->add_option("file", arguments.input, "name.superelement.h5")->required();
  show_command->add_option("-o,--output", arguments.output, "page with the certificate and pictures, .html");
  CLI::App* const mesh_command = add_command(app, "mesh", about_mesh, asked);
  mesh_command->add_option("part", arguments.input, "part.yaml")->required();
  mesh_command->add_option("-o,--output", arguments.output, "gmsh file (default: next to the part)");
  mesh_command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  CLI::App* const view_command = add_command(app, "view", about_view, asked);
  view_command->add_option("file", arguments.input, "part.yaml, a mesh, geometry or deck, or name.recovery.h5")
      ->required();
  view_command->add_option("-o,--output", arguments.output, "page, .html (default: next to the file)");
  view_command->add_option("--set", arguments.set, "path=value: override a value of the part")->allow_extra_args(false);
  CLI::App* const groups_command = add_command(app, "groups", about_groups, asked);
  groups_command->add_option("file", arguments.input, "part.yaml, or a mesh, geometry or deck")->required();
  groups_command->add_option("-o,--output", arguments.output,
                             "picture or page of the faces with their numbers: .html, .png or .svg (default: none)");
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
    return error.get_exit_code() == 0 ? app.exit(error) : report_usage(app, error, asked);
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
