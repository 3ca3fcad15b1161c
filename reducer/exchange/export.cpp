// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer export`: files of another program from a superelement file.
#include <algorithm>
#include <list>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "common/console.hpp"
#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/dmig.hpp"
#include "reducer/exchange/fmx.hpp"
#include "reducer/exchange/matrix_market.hpp"
#include "reducer/exchange/mbdyn.hpp"
#include "reducer/exchange/request.hpp"
#include "reducer/exchange/rows_table.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

struct OutputFile {
  std::string path;
  std::string bytes;
};

struct Outcome {
  std::vector<OutputFile> files;
  std::string remark;  ///< what is kept and what is lost
};

/// Superelement with rows sorted by node and component, then internal coordinates by number: the order of FEDEM.
formats::Superelement ordered(const formats::Superelement& element) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(element.size()));
  std::iota(rows.begin(), rows.end(), 0);
  const auto key = [&element](Eigen::Index row) {
    const int node = element.dof_node[row];
    return std::make_tuple(node < 0, node, element.dof_component[row]);
  };
  std::sort(rows.begin(), rows.end(), [&](Eigen::Index a, Eigen::Index b) { return key(a) < key(b); });
  formats::Superelement result = element;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.dof_node[i] = element.dof_node[rows[i]];
    result.dof_component[i] = element.dof_component[rows[i]];
  }
  result.stiffness = element.stiffness(rows, rows);
  result.mass = element.mass(rows, rows);
  return result;
}

Outcome to_matrix_market(const formats::Superelement& element, const std::string& base) {
  const std::string comment = fmt::format("{}, content {}", element.name, element.content_id.substr(0, 16));
  return {{{base + ".S.mtx", matrix_market_text(element.stiffness, "stiffness of " + comment)},
           {base + ".M.mtx", matrix_market_text(element.mass, "mass of " + comment)},
           {base + ".rows.csv", rows_text(element)}},
          "numbers have 17 digits and are exact; the files do not hold the names of the units and of the part"};
}

Outcome to_fmx(const formats::Superelement& given, const std::string& base) {
  const formats::Superelement element = ordered(given);
  const Eigen::MatrixXd gravity = element.mass * formats::rigid_motions(element, Eigen::Vector3d::Zero()).leftCols<3>();
  return {{{base + "_S.fmx", fmx_bytes(FmxKind::stiffness, 0, element.stiffness)},
           {base + "_M.fmx", fmx_bytes(FmxKind::mass, 0, element.mass)},
           {base + "_G.fmx", fmx_bytes(FmxKind::gravity, 0, gravity)},
           {base + ".rows.csv", rows_text(element)}},
          "binary numbers are exact; rows are those of the triads in the order of the table, then component modes"};
}

Outcome convert(const ExportRequest& request, const formats::Superelement& element) {
  const std::string base =
      without_ending(request.output.empty() ? request.input : request.output,
                     {".superelement.h5", ".h5", ".S.mtx", "_S.fmx", ".mtx", ".fmx", ".pch", ".fem"});
  const bool asked = !request.output.empty();
  if (request.to == "dmig")
    return {{{asked ? request.output : base + ".pch", dmig_text(element)}},
            "numbers have 10 to 13 digits, because a field has 16 characters; nodes are numbered from 1, modes from "
            "1000001"};
  if (request.to == "mbdyn")
    return {{{asked ? request.output : base + ".fem", mbdyn_text(element, request.input)}},
            "free elastic modes in mean axes, with the stiffness and inertia of small motions. Centrifugal loads on "
            "the modes are missing: MBDyn computes them from lumped masses, which a superelement does not have"};
  if (request.to == "matrixmarket") return to_matrix_market(element, base);
  if (request.to == "fmx") return to_fmx(element, base);
  throw Error(fmt::format("'{}' is not a format", shown(request.to)), "--to",
              "choose one of dmig, matrixmarket, fmx, mbdyn");
}

}  // namespace

void export_matrices(const ExportRequest& request) {
  const formats::LoadedSuperelement loaded = formats::read_superelement(request.input);
  const Outcome outcome = convert(request, loaded.superelement);
  for (const OutputFile& file : outcome.files)
    require_output(file.path, {".pch", ".bdf", ".mtx", ".fmx", ".fem", ".csv"}, {request.input});
  std::list<TextFile> open;
  for (const OutputFile& file : outcome.files) open.emplace_back(file.path).write(file.bytes);
  for (TextFile& file : open) file.publish();
  std::string text;
  for (const OutputFile& file : outcome.files)
    text += fmt::format("{:<19}{}\n", text.empty() ? "written" : "", file.path);
  say(text + fmt::format("{:<19}{}\n", "note", outcome.remark));
}

}  // namespace tisserand::reducer::exchange
