// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer import`: a superelement file with certificate from files of another program.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "common/console.hpp"
#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"
#include "reducer/decks/nastran/cards.hpp"
#include "reducer/decks/nastran/fields.hpp"
#include "reducer/exchange/abaqus_matrix.hpp"
#include "reducer/exchange/calculix_matrix.hpp"
#include "reducer/exchange/dmig.hpp"
#include "reducer/exchange/fmx.hpp"
#include "reducer/exchange/matrix_market.hpp"
#include "reducer/exchange/places.hpp"
#include "reducer/exchange/request.hpp"
#include "reducer/exchange/text_lines.hpp"
#include "reducer/exchange/to_superelement.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr long longest_node_range = 100000;
const std::vector<std::string> formats_known{"dmig", "abaqus", "calculix", "matrixmarket", "fmx"};

/// `path` with `ending` replaced by `by`, or empty if it has another ending.
std::string replaced(const std::string& path, const std::string& ending, const std::string& by) {
  const bool ends = path.size() > ending.size() && path.ends_with(ending);
  return ends ? path.substr(0, path.size() - ending.size()) + by : "";
}

std::string format_of(const ImportRequest& request) {
  if (!request.from.empty()) {
    if (std::find(formats_known.begin(), formats_known.end(), request.from) == formats_known.end())
      throw Error(fmt::format("'{}' is not a format", shown(request.from)), "--from",
                  fmt::format("choose one of {}", join(formats_known, ", ")));
    return request.from;
  }
  if (request.input.ends_with(".sti")) return "calculix";
  const TextLines lines(request.input);
  const std::string start = start_of(lines.text(), 14);
  if (start == "%%MATRIXMARKET") return "matrixmarket";
  if (start.starts_with("#FEDEM")) return "fmx";
  if (has_line(lines.text(), "DMIG")) return "dmig";
  if (start.starts_with("*") || (!start.empty() && start[0] >= '0' && start[0] <= '9')) return "abaqus";
  throw Error("does not look like a file of reduced matrices", request.input,
              fmt::format("name its format with --from {}", join(formats_known, " | ")));
}

Units units_of(const std::string& text) {
  if (text == "consistent") return Units::consistent();
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != 3)
    throw Error(fmt::format("'{}' does not name units", shown(text)), "--units",
                "give length,mass,time such as m,kg,s or mm,t,s, or consistent");
  return {length_unit(std::string(words[0])), mass_unit(std::string(words[1])), time_unit(std::string(words[2]))};
}

std::map<long, std::string> names_of(const std::string& text) {
  std::map<long, std::string> names;
  for (const std::string_view word : words_of(text)) {
    const std::size_t equals = word.find('=');
    const std::optional<long> node = parse_integer(word.substr(0, equals));
    if (equals == std::string_view::npos || !node || !names.emplace(*node, word.substr(equals + 1)).second)
      throw Error(fmt::format("'{}' is not a new pair of node number and name", shown(word)), "--names",
                  "give number=name once for each node, such as 101=base,102=tip");
  }
  return names;
}

std::set<long> modal_of(const std::string& text) {
  std::set<long> nodes;
  for (const std::string_view word : words_of(text)) {
    const std::size_t dash = word.find('-', 1);
    const std::optional<long> first = parse_integer(word.substr(0, dash));
    const std::optional<long> last = dash == std::string_view::npos ? first : parse_integer(word.substr(dash + 1));
    if (!first || !last || *last < *first || *last - *first >= longest_node_range)
      throw Error(fmt::format("'{}' is not a node number or a range of node numbers", shown(word)), "--modal",
                  "give numbers and ranges such as 1001-1008,2000");
    for (long node = *first; node <= *last; ++node) nodes.insert(node);
  }
  return nodes;
}

DmigSource dmig_source(const ImportRequest& request) {
  DmigSource source;
  source.path = request.input;
  source.positions = request.positions;
  if (request.matrices.empty()) return source;
  const std::vector<std::string_view> words = words_of(request.matrices);
  if (words.size() != 2)
    throw Error(fmt::format("'{}' does not hold two names", shown(request.matrices)), "--matrices",
                "give the names of stiffness and mass such as KAAX,MAAX");
  source.stiffness = words[0];
  source.mass = words[1];
  return source;
}

/// File that belongs to the stiffness matrix: the requested one, or `guess` from its name.
std::string companion(const ImportRequest& request, const std::string& asked, const std::string& guess,
                      const std::string& option) {
  if (!asked.empty()) return asked;
  if (!guess.empty() && std::filesystem::exists(guess)) return guess;
  const std::string what = option == "--rows" ? "the table of its rows" : "the mass matrix";
  throw Error(guess.empty() ? fmt::format("{} is missing", what)
                            : fmt::format("{} is missing: there is no file '{}'", what, guess),
              request.input, fmt::format("name the file with {} FILE", option));
}

ReducedMatrices read_matrices(const ImportRequest& request) {
  const std::string format = format_of(request), &input = request.input;
  const std::set<long> modal = modal_of(request.modal);
  if (format == "dmig") {
    ReducedMatrices matrices = read_dmig(dmig_source(request));
    matrices.modal = modal;
    return matrices;
  }
  const auto with_table = [&](const std::string& stiffness, const std::string& mass) {
    return TabledFiles{input, companion(request, request.mass, replaced(input, stiffness, mass), "--mass"),
                       companion(request, request.rows, replaced(input, stiffness, ".rows.csv"), "--rows")};
  };
  if (format == "matrixmarket") return read_matrix_market(with_table(".S.mtx", ".M.mtx"));
  if (format == "fmx") return read_fmx(with_table("_S.fmx", "_M.fmx"));
  ReducedMatrices matrices =
      format == "calculix" ? read_calculix_matrices(input, modal) : read_abaqus_matrices({input, request.mass}, modal);
  if (!request.positions.empty()) matrices.places = read_places(request.positions);
  return matrices;
}

std::string import_text(const ImportCertificate& c) {
  std::string text = fmt::format("{:<19}{} ({})\n", "imported from", c.source, c.format);
  text += fmt::format("{:<19}asymmetry S {:.1e}, M {:.1e}; rigid motions S R {:.1e}{}; coupling S_BI {:.1e}{}\n",
                      "input deviations", c.stiffness_asymmetry, c.mass_asymmetry, c.rigid_residual,
                      c.filtered ? ", projected out" : "", c.stiffness_coupling,
                      c.canonical ? ", in canonical form" : ", brought to canonical form");
  if (c.massless_dropped > 0)
    text += fmt::format("{:<19}{} internal directions without mass were condensed statically\n", "note",
                        c.massless_dropped);
  return text;
}

}  // namespace

void import_matrices(const ImportRequest& request) {
  const std::string base = without_ending(
      request.input, {".S.mtx", "_S.fmx", ".mtx", ".sti", ".pch", ".bdf", ".dat", ".nas", ".inp", ".txt"});
  const std::string output = request.output.empty() ? base + ".superelement.h5" : request.output;
  require_output(output, {".superelement.h5", ".h5"}, {request.input, request.mass, request.rows, request.positions});
  ImportOptions options;
  options.units = units_of(request.units);
  options.node_names = names_of(request.names);
  options.name = without_ending(output.substr(output.rfind('/') + 1), {".superelement.h5", ".h5"});
  Imported imported = to_superelement(read_matrices(request), options);
  const FileCertificate file = certify(imported.element, imported.report);
  formats::write_superelement(output, imported.element);
  write_certificate(output, imported.element, file, imported.certificate);
  say(certificate_text(imported.element, file, std::nullopt) + import_text(imported.certificate));
  say(fmt::format("{:<19}{}\n{:<19}{}\n", "written", output, "", certificate_path(output)));
}

}  // namespace tisserand::reducer::exchange
