// SPDX-License-Identifier: GPL-3.0-or-later
// Request from the settings of a part file, and a mesh or an error from the end of the process.
#include "reducer/mesher/import.hpp"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/mesher/child.hpp"

namespace tisserand::reducer {
namespace {

constexpr double gigabyte = 1e9;

bool is_cad(MeshFileKind kind) { return is_geometry(kind) && kind != MeshFileKind::geo; }

/// Whether a CAD file is meshed without small elements: a long time then has another cause than a fine mesh. `reducer
/// groups` draws faces with thirty elements per turn.
bool is_coarse(const GeometryRequest& request) {
  return is_cad(request.kind) && !(request.size > 0.0) && request.sizes.empty() && request.curvature <= 30;
}

/// Unit into which OpenCASCADE converts STEP and IGES; files without named units stay in millimetres.
std::string target_unit(const Units& units) {
  static const std::map<std::string, std::string> known{{"m", "M"},   {"mm", "MM"},   {"cm", "CM"},
                                                        {"km", "KM"}, {"in", "INCH"}, {"ft", "FT"}};
  const auto found = known.find(units.length.label);
  return found == known.end() ? "MM" : found->second;
}

GeometryRequest geometry_request(const ImportRequest& request) {
  const formats::MeshFile& settings = request.settings;
  GeometryRequest result;
  result.file = settings.file;
  result.kind = mesh_file_kind(settings.file, settings.where);
  result.target_unit = target_unit(request.units);
  result.dimension = request.dimension;
  result.size = settings.size;
  result.smallest = settings.smallest;
  result.curvature = settings.curvature;
  result.order = settings.order;
  result.quadrilaterals = settings.cells && *settings.cells == formats::Cells::quadrilaterals;
  result.scale = settings.scale;
  result.sizes = request.sizes;
  result.describes_faces = request.describes_faces;
  // gmsh runs name.opt next to a file of any kind, and files with endings such as .Step, as commands.
  std::error_code error;
  const std::string ending = std::filesystem::path(settings.file).extension().string();
  const bool is_mixed = std::ranges::any_of(ending, [](unsigned char c) { return std::isupper(c) != 0; }) &&
                        std::ranges::any_of(ending, [](unsigned char c) { return std::islower(c) != 0; });
  result.is_program = result.kind == MeshFileKind::geo || is_mixed ||
                      std::filesystem::exists(settings.file + ".opt", error) || bool(error);
  result.is_trusted = settings.permission.trusted;
  const auto size = static_cast<double>(std::filesystem::file_size(settings.file, error));
  const formats::MeshFile::Permission& given = settings.permission;
  // Ten times the memory of gmsh for large .msh and STEP files, or more; fine meshes of small geometries may need more.
  result.bytes = given.memory > 0.0 ? given.memory * gigabyte : 4.0 * gigabyte + 40.0 * size;
  // CAD files of some MB are read in seconds, and also meshed in seconds without small elements; damaged ones may loop.
  // A .geo file sets its own sizes and may mesh while it is read.
  const double brief = 5.0 + size / 1e5, ample = 600.0 + size / 2e5;
  result.reading_seconds = given.time > 0.0 ? given.time : is_cad(result.kind) ? brief : ample;
  result.seconds = given.time > 0.0 ? given.time : is_coarse(result) ? 2.0 * brief : ample;
  result.wall_seconds = 4.0 * result.seconds;  // other programs may use most of the processor
  if (!(given.time > 0.0)) result.wall_seconds = std::max(result.wall_seconds, 60.0);
  result.idle_seconds = 20.0;
  return result;
}

double kilobytes(const std::string& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  return error ? 0.0 : static_cast<double>(size) / 1e3;
}

/// Proposal for a larger limit, with two digits.
std::string twice(double value) { return fmt::format("{:.2g}", std::max(2.0 * value, 0.1)); }

[[noreturn]] void explain(const MesherReport& report, const GeometryRequest& request) {
  const std::string& file = request.file;
  const std::string words = report.last_words.empty() ? "" : fmt::format(" (last message: {})", report.last_words);
  const std::string at = doing(report.phase);
  const auto remedy = [&](const std::string& option) {
    return (is_coarse(request) ? "the file is probably damaged: write it again, or repair it in the CAD program; if it "
                                 "is not damaged, add "
                               : "choose a larger mesh: size; if you trust the file, allow more with ") +
           option;
  };
  const std::string time = remedy("--geometry-time " + twice(request.seconds));
  switch (report.ending) {
    case MesherEnding::memory:
      throw Error(fmt::format("gmsh was stopped while {}: it needed more than {:.4g} GB of memory", at,
                              request.bytes / gigabyte),
                  file, remedy("--geometry-memory " + twice(request.bytes / gigabyte)));
    case MesherEnding::processor_time:
      throw Error(
          fmt::format("gmsh was stopped while {}: it needed more than {:.4g} s of processor time", at, request.seconds),
          file, time);
    case MesherEnding::reading_time:
      throw Error(fmt::format("gmsh was stopped while reading the file: it needed more than {:.4g} s of processor time "
                              "for {:.4g} kB",
                              request.reading_seconds, kilobytes(file)),
                  file, time);
    case MesherEnding::idle:
      throw Error(fmt::format("gmsh was stopped while {}: it waited for {:.4g} s and computed nothing", at,
                              request.idle_seconds),
                  file, "a geometry may only draw: remove commands that wait, such as the inclusion of a pipe");
    case MesherEnding::wall_time:
      throw Error(
          fmt::format("gmsh was stopped while {}: it had not finished after {:.4g} s", at, request.wall_seconds), file,
          time);
    case MesherEnding::forbidden:
      throw Error("gmsh was stopped: the file tries to start a program, to wait, or to create, rename or remove files",
                  file, "a geometry may only draw: remove such commands (SystemCall, CreateDir, Sleep, ...)");
    case MesherEnding::crashed:
      throw Error(fmt::format("gmsh crashed while {}: {}{}", at, ::strsignal(report.signal), words), file,
                  report.phase == MesherPhase::starting ? "install the programs again"
                  : report.signal == SIGKILL
                      ? "the machine may have run out of memory: choose a larger mesh: size"
                      : "the file is probably damaged: write it again, or repair it in the CAD program");
    case MesherEnding::left:
    case MesherEnding::answered:
      throw Error(fmt::format("gmsh ended while {} and gave no mesh{}", at, words), file,
                  report.phase == MesherPhase::starting
                      ? "install the programs again"
                      : "remove Exit from the geometry; if it has none, the file is probably damaged: write it again");
  }
  throw Error("gmsh ended", file, "");
}

}  // namespace

CellMesh import_with_gmsh(const ImportRequest& request) {
  const GeometryRequest geometry = geometry_request(request);
  const MesherReport report = run_mesher(geometry);
  if (report.ending != MesherEnding::answered) explain(report, geometry);
  return unpack_answer(report.answer, geometry.file);
}

}  // namespace tisserand::reducer
