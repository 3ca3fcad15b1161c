// SPDX-License-Identifier: GPL-3.0-or-later
// Load files: FORCE and MOMENT cards, *CLOAD lines.
#include "reducer/recover/load_files.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using formats::Recovery;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double negligible = 1e-14;  // round-off relative to the largest force or moment

std::string comment_sign(LoadFormat format) { return format == LoadFormat::nastran ? "$ " : "** "; }

/// Comment lines.
std::string comments(LoadFormat format, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += comment_sign(format) + printable_line(line, 200) + '\n';
  return text;
}

std::string three(const Vector3d& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x(), v.y(), v.z()); }

std::string wrench_text(const char* what, const Vector6& w, const Units& units) {
  return fmt::format("{:<34}{}{}, moment {}{}", what, three(w.head<3>()), after_number(unit_label(units, 1, 1, -2)),
                     three(w.tail<3>()), after_number(unit_label(units, 2, 1, -2)));
}

std::string errors_text(const LoadBalance& balance) {
  return fmt::format("{:.1e} (force) and {:.1e} (moment)", balance.force_error, balance.moment_error);
}

std::vector<std::string> instant_lines(const LoadInstant& at, const Recovery& r, const BodyMotion& still) {
  std::vector<std::string> lines{
      fmt::format("time {:.12g}{}", at.time, after_number(unit_label(still.scene_units, 0, 0, 1))),
      wrench_text("boundary nodes: force", at.balance.boundary, r.units),
      wrench_text("weight, inertia of the frame: force", at.balance.frame, r.units),
      wrench_text("inertia of the deformation: force", at.balance.deformation, r.units),
      wrench_text("residual of all: force", at.balance.sum, r.units),
      "residual relative to all loads      " + errors_text(at.balance)};
  if (at.balance.compared)
    lines.push_back(fmt::format(
        "forces at boundary nodes differ from those of the run by {0:.3g}{2}; the largest force is {1:.6g}{2}",
        at.balance.differs, at.balance.largest, after_number(unit_label(r.units, 1, 1, -2))));
  return lines;
}

std::vector<std::string> head_lines(const LoadHead& head, LoadFormat format) {
  const Recovery& r = head.recovery;
  const std::string length = unit_label(r.units, 1, 0, 0), force = unit_label(r.units, 1, 1, -2);
  std::vector<std::string> lines{
      fmt::format("loads of part '{}', body '{}', by {}", r.name, head.still.body, r.producer),
      fmt::format("recovery file {}, results {}", head.request.recovery, head.request.results),
      length.empty() ? "units are those of the part" : fmt::format("units: length {}, force {}", length, force),
      "axes, node numbers and origin of moments are those of the part's mesh file",
      "The loads of each instant are in equilibrium. Hold six coordinates that prevent rigid motion, at any nodes, or "
      "use",
      format == LoadFormat::nastran
          ? "inertia relief (PARAM,INREL,-2). Reactions and relief are as small as the residual."
          : "(CalculiX) three nodes. Reactions are as small as the residual.",
      "Displacements then differ from those of `reducer recover` by a rigid motion. Stresses are equal."};
  if (head.still.mirror.prod() < 0.0 || head.still.mirror.minCoeff() < 0.0)
    lines.push_back(fmt::format("the body is the mirror image ({}) of the part: these loads act on the original part",
                                three(head.still.mirror)));
  if (!head.numbers.unknown.empty()) {
    lines.push_back(
        fmt::format("{} nodes have no number in the mesh file. They get these numbers (number, name, position):",
                    head.numbers.unknown.size()));
    for (const int n : head.numbers.unknown)
      lines.push_back(
          fmt::format("  {}  {}  at {}", head.numbers.number[n], r.node_label[n], three(r.position.col(n))));
  }
  return lines;
}

/// A number with 16 characters.
std::string field16(double value) { return fmt::format("{:>16}", fmt::format("{:.9E}", value)); }

/// FORCE or MOMENT card in large fields.
std::string nastran_card(const char* name, int set, int node, const Vector3d& v) {
  return fmt::format("{:<8}{:>16}{:>16}{:>16}{:>16}*\n{:<8}{}{}{}\n", std::string(name) + '*', set, node, 0, "1.0", "*",
                     field16(v.x()), field16(v.y()), field16(v.z()));
}

/// Calls card(name, node, vector) for all forces and moments above round-off.
template <class Card>
void for_forces(const NodeForces& forces, const Card& card) {
  const double force = forces.topRows<3>().cwiseAbs().maxCoeff(), moment = forces.bottomRows<3>().cwiseAbs().maxCoeff();
  for (Index n = 0; n < forces.cols(); ++n) {
    const Vector3d F = forces.col(n).head<3>(), M = forces.col(n).tail<3>();
    if (F.cwiseAbs().maxCoeff() > negligible * force) card(true, n, F);
    if (M.cwiseAbs().maxCoeff() > negligible * moment) card(false, n, M);
  }
}

/// Three load sets and their sum: 10 k + 1 boundary, + 2 frame, + 3 deformation, LOAD 10 k.
std::string nastran_text(const LoadInstant& at, const LoadHead& head, int k) {
  const int set = 10 * k;
  std::string text, sum = fmt::format("LOAD    {:>8}{:>8}", set, "1.0");
  const auto add = [&](const NodeForces& forces, int own, const char* what, const auto& number) {
    std::string cards;
    for_forces(forces, [&](bool is_force, Index n, const Vector3d& v) {
      cards += nastran_card(is_force ? "FORCE" : "MOMENT", own, number(n), v);
    });
    if (cards.empty()) return;
    text += fmt::format("$ set {}: {}\n", own, what) + cards;
    sum += fmt::format("{:>8}{:>8}", "1.0", own);
  };
  const auto of_node = [&](Index n) { return head.numbers.number[n]; };
  const auto of_boundary = [&](Index b) { return of_node(head.recovery.boundary_node[b]); };
  add(at.loads.boundary, set + 1, "forces at boundary nodes", of_boundary);
  add(at.loads.frame, set + 2, "weight and inertia of the moving frame", of_node);
  add(at.loads.deformation, set + 3, "inertia of the deformation", of_node);
  return text + sum + '\n';
}

/// One step. Forces on the same coordinate are summed, because programs differ in their treatment of two lines.
std::string calculix_text(const LoadInstant& at, const LoadHead& head) {
  NodeForces all = at.loads.frame + at.loads.deformation;
  for (Index b = 0; b < at.loads.boundary.cols(); ++b)
    all.col(head.recovery.boundary_node[b]) += at.loads.boundary.col(b);
  std::string text = "*STEP\n*STATIC\n*CLOAD, OP=NEW\n";
  for_forces(all, [&](bool is_force, Index n, const Vector3d& v) {
    for (int c = 0; c < 3; ++c)
      if (v[c] != 0.0) text += fmt::format("{}, {}, {:.12e}\n", head.numbers.number[n], c + (is_force ? 1 : 4), v[c]);
  });
  return text + "*NODE FILE\nU, RF\n*EL FILE\nS\n*END STEP\n";
}

std::string case_control(Index instants) {
  std::string text = "$ case control: SPC or PARAM,INREL,-2, and for each instant\n";
  for (Index k = 1; k <= instants; ++k) text += fmt::format("$   SUBCASE {}\n$     LOAD = {}\n", k, 10 * k);
  return text;
}

}  // namespace

NodeNumbers node_numbers(const Recovery& r) {
  NodeNumbers numbers{r.node_number, {}};
  numbers.number.resize(static_cast<std::size_t>(r.nodes()), 0);
  int last = numbers.number.empty() ? 0 : *std::max_element(numbers.number.begin(), numbers.number.end());
  for (int n = 0; n < r.nodes(); ++n)
    if (int& number = numbers.number[n]; number == 0) {
      number = ++last;
      numbers.unknown.push_back(n);
    }
  return numbers;
}

LoadFile::LoadFile(LoadFormat format, const std::string& path, const LoadHead& head, Index instants)
    : format_(format), path_(path), head_(head), file_(path) {
  file_.write(comments(format, head_lines(head, format)));
  if (format == LoadFormat::nastran) file_.write(case_control(instants));
}

void LoadFile::add(const LoadInstant& at) {
  ++count_;
  file_.write(comments(format_, instant_lines(at, head_.recovery, head_.still)));
  file_.write(format_ == LoadFormat::nastran ? nastran_text(at, head_, count_) : calculix_text(at, head_));
}

std::string LoadFile::publish() {
  file_.publish();
  return path_;
}

std::string balance_text(const Recovery& r, const LoadInstant& at, const BodyMotion& still) {
  std::string text = fmt::format(
      "{:<29}residual force {}{}, moment {}{}; relative to all loads: {}\n",
      fmt::format("loads at {:.6g}{}", at.time, after_number(unit_label(still.scene_units, 0, 0, 1))),
      three(at.balance.sum.head<3>()), after_number(unit_label(r.units, 1, 1, -2)), three(at.balance.sum.tail<3>()),
      after_number(unit_label(r.units, 2, 1, -2)), errors_text(at.balance));
  if (at.balance.compared)
    text += fmt::format("{0:<29}differ from those of the run by {1:.3g}{3}; the largest force is {2:.6g}{3}\n",
                        "  forces at boundary nodes", at.balance.differs, at.balance.largest,
                        after_number(unit_label(r.units, 1, 1, -2)));
  return text;
}

}  // namespace tisserand::reducer
