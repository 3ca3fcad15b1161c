// SPDX-License-Identifier: GPL-3.0-or-later
// Which source implements which header, and where numbers become int.
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture {
namespace {

/// Sources that are parts of what a header of another name declares, by their paths from its folder: contracts that
/// each room fulfils for itself, and headers whose work takes more than one file.
struct SharedHeader {
  std::string_view header, sources;
};
constexpr SharedHeader shared_headers[] = {
    {"common/processor/requirements.hpp", "check"},
    {"formats/companion/companion.hpp", "check turns"},
    {"formats/hdf5/file.hpp", "write"},
    {"formats/modal_body/modal_body.hpp", "check"},
    {"formats/page/surface.hpp", "thinning"},
    {"formats/part/check.hpp", "check_loads check_places check_shells"},
    {"formats/part/reader.hpp", "attachments places"},
    {"formats/recovery/recovery.hpp", "check file write"},
    {"formats/results/results.hpp", "csv reader row writer"},
    {"formats/scene/check_parts.hpp", "check_forces settings_check"},
    {"formats/scene/reader.hpp", "analyses bodies channels forces joints road_grids shapes tyres"},
    {"formats/specification/specification.hpp", "schema"},
    {"formats/study/study.hpp", "point"},
    {"formats/superelement/superelement.hpp", "check rigid"},
    {"mechanism/bdf/bdf.hpp", "bdf_absent bdf_cvode"},
    {"mechanism/bodies/beam/element.hpp", "tangent"},
    {"mechanism/bodies/superelement/constants/body.hpp", "damping"},
    {"mechanism/bodies/superelement/tangent/second_order_tangent.hpp", "frame_stiffness planar_tangent"},
    {"mechanism/bodies/superelement/tangent/tangent.hpp", "exact"},
    {"mechanism/build/build_model.hpp", "body_files"},
    {"mechanism/build/joints.hpp", "forces"},
    {"mechanism/build/planar.hpp", "plane"},
    {"mechanism/doubts/doubt.hpp",
     "axial_spin inertia_choice law_range linear_range multiplier_swing step_resolution torsion tyre_range"},
    {"mechanism/equations/evaluate.hpp", "ties"},
    {"mechanism/equations/terms.hpp", "channels joints motion part_loads"},
    {"mechanism/run/run.hpp", "integrate run_analyses"},
    {"mechanism/solver/back_ends.hpp", "dense klu sparse_qr umfpack"},
    {"reducer/commands.hpp", "launch"},
    {"reducer/decks/abaqus/sections.hpp", "beam_sections plies"},
    {"reducer/decks/abaqus/ties.hpp", "equations"},
    {"reducer/decks/deck.hpp", "abaqus/reader nastran/reader"},
    {"reducer/decks/nastran/model.hpp",
     "beam_properties beams boundary finish grids shell_properties shells solids sort springs ties"},
    {"reducer/elements/checks.hpp", "stiff_springs"},
    {"reducer/elements/element_loads.hpp", "beam/load solid/face_load"},
    {"reducer/elements/element_matrices.hpp",
     "beam/matrices nodal_mass shell/shape shell/shell solid/check solid/solid"},
    {"reducer/elements/element_stress.hpp", "solid/stress"},
    {"reducer/elements/mesh_error.hpp", "beam/mesh_error shell/mesh_error solid/mesh_error"},
    {"reducer/elements/second_order.hpp", "beam/second_order shell/second_order solid/second_order"},
    {"reducer/elements/shell/stiffness.hpp", "quad triangle"},
    {"reducer/elements/turning_mass.hpp", "beam/moving_mass shell/moving_mass"},
    {"reducer/exchange/request.hpp", "export import"},
    {"reducer/fields/fields.hpp", "tables"},
    {"reducer/fields/surface.hpp", "outline"},
    {"reducer/recover/envelope.hpp", "envelope_files"},
    {"reducer/recover/history_tables.hpp", "choice"},
    {"reducer/recover/inertia_loads.hpp", "applied_loads"},
    {"reducer/report/certificate.hpp", "certificate_file"},
    {"reducer/sources/mesh_builder.hpp",
     "attachments file_source group_elements group_weights hanging loads own_geometry unjoined"},
    {"reducer/sources/patches.hpp", "conformity"},
};

/// Casts to int besides count_of(): reals that are rounded, numbers from files, indices of libraries, enumerators that
/// index a table, positions of iterators. Lower it when some have gone; it does not rise.
constexpr std::size_t most_casts = 238;

/// A source of a library: no program, and not the one that replaces a function of the C library.
bool is_part_of_library(const SourceFile& file) {
  static const std::regex name(R"(^(common|formats|mechanism|reducer)/.*\.cpp$)");
  return std::regex_match(file.path, name) && !file.path.ends_with("/main.cpp") &&
         file.path != "reducer/blas_memory.cpp";
}

/// Paths of the listed sources, each with its header.
std::map<std::string, std::string> listed_sources() {
  std::map<std::string, std::string> header_of;
  for (const SharedHeader& shared : shared_headers) {
    const std::string header(shared.header);
    std::istringstream names{std::string(shared.sources)};
    for (std::string name; names >> name;) header_of[header.substr(0, header.rfind('/') + 1) + name + ".cpp"] = header;
  }
  return header_of;
}

}  // namespace

std::vector<Violation> check_source_names(const SourceTree& tree) {
  std::map<std::string, std::string> listed = listed_sources();
  const auto exists = [&](const std::string& path) { return std::filesystem::exists(tree.root / path); };
  std::vector<Violation> found;
  for (const SourceFile& file : tree.files) {
    if (!is_part_of_library(file)) continue;
    const bool has_own = exists(file.path.substr(0, file.path.rfind('.')) + ".hpp");
    if (has_own == listed.contains(file.path))
      found.push_back({file.path, 0,
                       has_own ? "has a header of its name: strike it off the list of those that share one"
                               : "has no header of its name, and is not on the list of those that share one"});
    listed.erase(file.path);
  }
  for (const auto& [source, header] : listed)
    if (exists(header)) found.push_back({source, 0, "is listed as a part of " + header + ", but is not there"});
  return found;
}

std::vector<Violation> check_casts(const SourceTree& tree) {
  static const std::regex loop(R"(\bfor \([^;]*;[^;<]*<=? (static_cast<int>|count_of)\([^;+*-]*\);)");
  static const std::regex size(R"(static_cast<int>\([^;,<? ]*size\(\)\))");
  static const std::regex cast(R"(static_cast<int>)");
  std::vector<Violation> found;
  std::size_t casts = 0;
  for (const SourceFile& file : tree.files) {
    if (!file.is_source() || file.path.starts_with("tests/") || file.path == "common/math/count.hpp") continue;
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      const std::string& line = file.code[i];
      casts += static_cast<std::size_t>(
          std::distance(std::sregex_iterator(line.begin(), line.end(), cast), std::sregex_iterator()));
      if (std::regex_search(line, loop)) found.push_back({file.path, i + 1, "compare an index with std::ssize()"});
      if (std::regex_search(line, size)) found.push_back({file.path, i + 1, "write count_of() for a size as an int"});
    }
  }
  if (casts > most_casts)
    found.push_back({"", 0, std::to_string(casts) + " casts to int, " + std::to_string(most_casts) + " are allowed"});
  return found;
}

}  // namespace tisserand::architecture
