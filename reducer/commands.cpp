// SPDX-License-Identifier: GPL-3.0-or-later
// Commands of stage 1: read, work, write, report.
#include "reducer/commands.hpp"

#include <unistd.h>

#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "common/console.hpp"
#include "common/error.hpp"
#include "common/interrupts.hpp"
#include "common/output_path.hpp"
#include "common/staged_files.hpp"
#include "common/text.hpp"
#include "formats/companion/companion.hpp"
#include "formats/companion/owner.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "formats/recovery/recovery.hpp"
#include "formats/sections/report.hpp"
#include "formats/superelement/superelement.hpp"
#include "formats/yaml/override.hpp"
#include "reducer/algebra/petsc.hpp"
#include "reducer/algebra/ranks.hpp"
#include "reducer/elements/checks.hpp"
#include "reducer/fields/fields.hpp"
#include "reducer/follow.hpp"
#include "reducer/mesh/gmsh_file.hpp"
#include "reducer/mesh/mesh_file.hpp"
#include "reducer/recover/recover.hpp"
#include "reducer/reduce.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/report/certificate_page.hpp"
#include "reducer/report/phases.hpp"
#include "reducer/solve/files.hpp"
#include "reducer/solve/report.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "reducer/startup.hpp"
#include "reducer/survey/picture.hpp"
#include "reducer/survey/survey.hpp"
#include "reducer/view/part_page.hpp"

namespace tisserand::reducer {
namespace {

std::vector<formats::Override> overrides(const Arguments& arguments) {
  std::vector<formats::Override> result;
  for (const std::string& text : arguments.set) result.push_back(formats::parse_override(text));
  return result;
}

/// Throws the error for a CAD file, mesh or deck given where a part file is expected.
[[noreturn]] void ask_for_part(const std::string& file, MeshFileKind kind) {
  const std::string name = std::filesystem::path(file).filename().string();
  const bool deck = kind == MeshFileKind::nastran || kind == MeshFileKind::abaqus;
  throw Error(fmt::format("this is a {}, not a part file", deck                ? "deck"
                                                           : is_geometry(kind) ? "geometry"
                                                                               : "mesh"),
              file,
              fmt::format("write a part file {} in its folder, with `mesh: {{file: {}}}`, {}`boundary` and `modes` "
                          "(formats/PART.md); `reducer groups` and `reducer view` read this file directly",
                          std::filesystem::path(name).replace_extension(".part.yaml").string(), name,
                          deck ? "" : "`materials`, `solids` or `shells`, "));
}

formats::Part part_of(const Arguments& arguments) {
  if (const auto kind = known_mesh_file(arguments.input)) ask_for_part(arguments.input, *kind);
  formats::Part part = formats::read_part(arguments.input, overrides(arguments));
  part.mesh.permission = arguments.permission;
  return part;
}

/// Files that an output must not replace: the part file and its mesh file.
std::vector<std::string> inputs_of(const formats::Part& part, const Arguments& arguments) {
  std::vector<std::string> inputs{arguments.input};
  if (!part.mesh.file.empty()) inputs.push_back(part.mesh.file);
  return inputs;
}

/// Path of an input or output with the ending of its kind replaced by `ending`.
std::string beside(const std::string& input, const std::string& ending) {
  return without_ending(input,
                        {".part.yaml", ".part.yml", ".yaml", ".yml", ".recovery.h5", ".superelement.h5", ".h5"}) +
         ending;
}

/// Writes tables and fields to a staged file. It gets its final name together with the superelement.
std::unique_ptr<formats::RecoveryWriter> write_recovery(const RecoverySource& source, const std::string& path,
                                                        const PhaseListener& listener) {
  const formats::Recovery tables = recovery_tables(source);
  auto writer = std::make_unique<formats::RecoveryWriter>(path, tables);
  recovery_fields(
      source, tables, listener.share,
      {[&](formats::RecoveryField field, const Eigen::MatrixXd& rows) { writer->append(field, rows); },
       [&](formats::RecoveryField field, const Eigen::MatrixXd& rows) { writer->append_loads(field, rows); },
       [&](formats::RecoveryField field, const Eigen::MatrixXd& rows) { writer->append_second_order(field, rows); },
       [&](formats::NodalForce force, const Eigen::MatrixXd& rows) { writer->append_forces(force, rows); }});
  return writer;
}

/// Lines "time", "processor time", "peak memory", "substitutions". Several processes: times of the first, no
/// substitutions.
std::string times_text(const Phases& phases) {
  std::string text = fmt::format("{:<19}{}\n{:<19}{}\n{:<19}{}\n", "time", phases.text(), "processor time",
                                 phases.processor_text(), "peak memory", phases.memory_text());
  if (rank_count() > 1)
    return text + fmt::format("{:<19}{}; times and memory are those of the first process\n", "processes", rank_count());
  if (phases.columns() > 0) text += fmt::format("{:<19}{}\n", "substitutions", phases.solutions_text());
  return text;
}

/// Text "companion.h5 (1.2 MB: second order of 24 coordinates, 9 rows of trapped stress, load cases gust, weight)".
std::string companion_text(const formats::Companion& companion, const std::string& path) {
  std::vector<std::string> holds, cases;
  if (companion.has_second_order()) holds.push_back(fmt::format("second order of {} coordinates", companion.S1.cols()));
  if (!companion.Lambda.empty()) holds.push_back(fmt::format("{} rows of trapped stress", companion.Lambda.size()));
  for (const formats::LoadCase& load : companion.load_cases) cases.push_back(load.name);
  if (!cases.empty()) holds.push_back("load cases " + listed(cases));
  return fmt::format("{} ({:.3g} MB: {})", path, 1e-6 * static_cast<double>(std::filesystem::file_size(path)),
                     join(holds, ", "));
}

/// Removes the companion of an earlier run if this run writes none: mechanisms would take it for that of the new
/// superelement. Files of other programs stay and are reported.
std::string clear_companion(const std::string& path, const std::string& content_id) {
  if (!std::filesystem::exists(path)) return "";
  const std::optional<formats::CompanionOwner> owner = formats::companion_owner(path);
  const bool fits = owner && owner->superelement == content_id;
  if (!owner || !owner->producer.starts_with("Tisserand reducer"))
    return fmt::format("{:<19}{} (not written by this program), {}\n", "in the same folder", path,
                       fits    ? "which `mechanism` reads: it belongs to this superelement"
                       : owner ? "which `mechanism` refuses: it belongs to another superelement; remove it"
                               : "which `mechanism` refuses: it is not a companion file; remove it");
  std::error_code fault;
  std::filesystem::remove(path, fault);
  if (fault)
    throw Error("the companion file of an earlier run cannot be removed: " + fault.message(), path,
                "remove it, because `mechanism` would read it with the new superelement, or refuse both");
  return fmt::format("{:<19}{} of an earlier run, because this run writes no companion file\n", "removed", path);
}

PhaseListener listener_of(Phases& phases) {
  PhaseListener listener([&phases](const std::string& phase) { phases.begin(phase); });
  listener.share = [&phases](double done) { phases.share(done); };
  listener.solve = [&phases](int columns) { phases.solve(columns); };
  listener.tell = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  return listener;
}

/// `session` begins after the input is read and outlives all that this function opens (in solve() too).
int run(const Arguments& arguments, std::optional<SolverSession>& session) {
  Phases phases;
  phases.begin("read");
  const formats::Part part = part_of(arguments);
  const std::string output = arguments.output.empty() ? beside(arguments.input, ".superelement.h5") : arguments.output;
  const std::vector<std::string> inputs = inputs_of(part, arguments);
  require_output(output, {".superelement.h5", ".h5"}, inputs);
  if (part.recovery) require_output(formats::recovery_path(output), {".recovery.h5"}, inputs);
  const std::string companion = formats::companion_path(output);
  if (part.second_order != formats::SecondOrder::no || !part.load_cases.empty())
    require_output(companion, {".companion.h5"}, inputs);
  const std::string modal_body = beside(output, ".modal.h5");
  if (part.modal_body) require_output(modal_body, {".modal.h5"}, inputs);
  if (part.modal_body && part.recovery) require_output(formats::recovery_path(modal_body), {".recovery.h5"}, inputs);
  phases.begin("start solvers");
  session.emplace();
  std::map<std::string, std::unique_ptr<formats::RecoveryWriter>> recoveries;
  const PhaseListener listener = listener_of(phases);
  Reduction reduction = reduce(part, listener, [&](const RecoverySource& source) {
    const std::string path = formats::recovery_path(source.is_modal ? modal_body : output);
    recoveries[path] = write_recovery(source, path, listener);
  });
  phases.begin("write");
  // All files are complete before the first gets its name. The superelement is last, since the others quote it.
  StagedFiles files;
  const std::string superelement = formats::superelement_image(output, reduction.superelement);
  if (reduction.companion)
    files.add(companion, formats::companion_image(companion, *reduction.companion, reduction.superelement));
  for (const auto& [path, recovery] : recoveries) files.adopt(recovery->stage(), path);
  files.add(certificate_path(output), certificate_json(reduction.superelement, reduction.file, reduction.model));
  if (reduction.modal_body) files.add(modal_body, formats::modal_body_image(modal_body, *reduction.modal_body));
  files.add(output, superelement);
  const std::string cleared = reduction.companion ? "" : clear_companion(companion, reduction.superelement.content_id);
  files.publish();
  phases.end();
  say(certificate_text(reduction.superelement, reduction.file, reduction.model));
  if (!part.supports.empty())
    say(fmt::format("{:<19}supports: only `reducer solve` uses them; the superelement is that of the free part\n",
                    "not used"));
  say(fmt::format("{:<19}{}\n{:<19}{}\n", "written", output, "", certificate_path(output)));
  for (const auto& [path, recovery] : recoveries) say(fmt::format("{:<19}{}\n", "", path));
  if (reduction.companion) say(fmt::format("{:<19}{}\n", "", companion_text(*reduction.companion, companion)));
  if (reduction.modal_body) say(fmt::format("{:<19}{}\n", "", modal_body));
  say(cleared);
  say(times_text(phases));
  return 0;
}

int solve(const Arguments& arguments, std::optional<SolverSession>& session) {
  Phases phases;
  phases.begin("read");
  const formats::Part part = part_of(arguments);
  std::string stem = arguments.output.empty() ? beside(arguments.input, ".solution") : arguments.output;
  if (stem.ends_with(".csv")) stem.resize(stem.size() - std::string_view(".csv").size());
  const std::vector<std::string> files = solution_files(stem, part, arguments.solve_request);
  for (const std::string& file : files) require_output(file, {".csv", ".vtu", ".html"}, inputs_of(part, arguments));
  phases.begin("start solvers");
  session.emplace();
  const Solution solution = solve(part, arguments.solve_request, listener_of(phases));
  phases.begin("write");
  write_solution(solution, part, arguments.solve_request, stem);
  phases.end();
  say(solution_text(solution, part) + "\n");
  for (const std::string& file : files) say(fmt::format("{:<19}{}\n", &file == &files.front() ? "written" : "", file));
  say(times_text(phases));
  return 0;
}

int show(const Arguments& arguments) {
  const formats::LoadedSuperelement loaded = formats::read_superelement(arguments.input);
  const FileCertificate file = certify(loaded.superelement, loaded.report);
  const auto model = read_certificate(arguments.input, loaded.superelement.content_id);
  if (arguments.output.empty()) {
    say(certificate_text(loaded.superelement, file, model));
    return 0;
  }
  require_output(arguments.output, {".certificate.html", ".html"}, {arguments.input});
  write_text_file(arguments.output, certificate_page(loaded.superelement, file, model));
  say_of(arguments.output, fmt::format("page: {}\n", arguments.output));
  return 0;
}

/// Numbers of nodes and elements, such as "400 nodes, 12 beams, 340 shells".
std::string count_text(const Mesh& mesh) {
  std::vector<std::string> words{fmt::format("{} nodes", mesh.nodes())};
  const auto add = [&words](std::size_t count, const char* noun) {
    if (count > 0)
      words.push_back(fmt::format("{} {}{}", count, noun,
                                  count == 1                              ? ""
                                  : std::string_view(noun).ends_with('s') ? "es"
                                                                          : "s"));
  };
  add(mesh.beams.size(), "beam");
  add(mesh.shells.size(), "shell");
  add(mesh.solids.size(), "solid");
  add(mesh.springs.size(), "spring");
  add(mesh.masses.size(), "point mass");
  add(mesh.spiders.size(), "spider");
  return join(words, ", ");
}

/// Part of a part.yaml, or of a mesh, geometry or deck alone.
formats::Part part_or_file(const Arguments& arguments) {
  if (arguments.input.ends_with(".yaml") || arguments.input.ends_with(".yml")) return part_of(arguments);
  formats::Part part = part_of_file(arguments.input);
  part.mesh.permission = arguments.permission;
  return part;
}

int mesh(const Arguments& arguments) {
  const formats::Part part = part_of(arguments);
  const std::string output = arguments.output.empty() ? beside(arguments.input, ".msh") : arguments.output;
  require_output(output, {".msh"}, inputs_of(part, arguments));
  const Mesh result = build_mesh(part);
  write_gmsh_file(result, output);
  for (const std::string& warning : result.warnings) say(fmt::format("warning: {}\n", warning));
  say(fmt::format("{}\nwritten {} (open it with gmsh)\n", count_text(result), output));
  return 0;
}

/// HTML page that shows a part file or a recovery file.
std::string page(const Arguments& arguments) {
  ViewedPart part;
  part.title = std::filesystem::path(arguments.input).filename().string();
  part.file = arguments.input;
  if (arguments.input.ends_with(".h5")) {
    const formats::RecoveryReader recovery(arguments.input);
    part.tables = recovery.recovery();
    part.units = part.tables.units;
    part.recovery = &recovery;
    part.frequency = frequencies_beside(recovery);
    return part_page(part);
  }
  const formats::Part read = part_or_file(arguments);
  constexpr std::size_t most_faces = 1000;
  const Mesh mesh = build_mesh(read, most_faces, part.faces);
  part.tables = mesh_tables(mesh);
  part.units = read.units;
  part.faulty = faulty_elements(mesh);
  part.spiders = mesh.spiders;
  part.notes = mesh.warnings;
  return part_page(part);
}

/// Pages of a part and of its recovery file differ in name: bracket.part.html, bracket.recovery.html.
int view(const Arguments& arguments) {
  const std::string own = without_ending(arguments.input, {".yaml", ".yml", ".h5"}) + ".html";
  const std::string output = arguments.output.empty() ? own : arguments.output;
  require_output(output, {".html"}, {arguments.input});
  const std::string text = page(arguments);
  write_text_file(output, text);
  say_of(output, fmt::format("page: {} ({:.2f} MB)\n", output, 1e-6 * static_cast<double>(text.size())));
  return 0;
}

int groups(const Arguments& arguments) {
  const formats::Part part = part_or_file(arguments);
  if (arguments.output.empty()) {
    say(survey(part).text);
    return 0;
  }
  require_output(arguments.output, {".html", ".png", ".svg"}, inputs_of(part, arguments));
  const Survey surveyed = survey(finely_meshed(part));
  draw_faces(surveyed, arguments.input, arguments.output);
  say_of(arguments.output, fmt::format("{}picture: {}\n", surveyed.text, arguments.output));
  return 0;
}

int section(const Arguments& arguments) {
  const formats::Part part = part_of(arguments);
  if (part.sections.empty())
    throw Error("the part has no sections to print", arguments.input, "define sections under `sections:`");
  say(formats::section_report(part.sections, part.units));
  return 0;
}

/// Work of all processes but the first. Commands without shared work run in the first process only.
int follow(const Arguments& arguments) {
  if (arguments.command != Command::run && arguments.command != Command::solve) return 0;
  std::packaged_task<Mesh()> mesh([&] {
    const formats::Part part = part_of(arguments);
    return arguments.command == Command::solve ? build_mesh_to_solve(part) : build_mesh(part);
  });
  mesh();  // an error here also occurs in the first process, which reports it, or later when the mesh is needed
  const SolverSession session;
  follow_leader(mesh.get_future());
  return 0;
}

}  // namespace

int perform(const Arguments& arguments, char** argv) {
  prepare_environment();
  restart_if_blas_is_slow(argv);
  end_on_interrupt(is_follower() ? "" : "reducer");
  if (is_follower()) return follow(arguments);
  std::optional<SolverSession> session;
  const auto leave = [](int code) {
    if (may_leave_at_once()) _exit(code);
    return code;
  };
  switch (arguments.command) {
    case Command::run:
      return leave(run(arguments, session));
    case Command::solve:
      return leave(solve(arguments, session));
    case Command::show:
      return show(arguments);
    case Command::mesh:
      return mesh(arguments);
    case Command::view:
      return view(arguments);
    case Command::groups:
      return groups(arguments);
    case Command::section:
      return section(arguments);
    case Command::recover:
      say(recover(arguments.recover_request));
      return 0;
    case Command::import_matrices:
      exchange::import_matrices(arguments.import_request);
      return 0;
    case Command::export_matrices:
      exchange::export_matrices(arguments.export_request);
      return 0;
  }
  return 1;
}

}  // namespace tisserand::reducer
