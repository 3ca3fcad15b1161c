// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of the report on a solution.
#include "reducer/solve/report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/text.hpp"
#include "reducer/recover/instant_values.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/report/verdict.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr const char* line_form = "  {:<19}{}\n";

/// Unit labels for use after numbers.
struct Labels {
  explicit Labels(const Units& units)
      : length(after_number(unit_label(units, 1, 0, 0))),
        force(after_number(unit_label(units, 1, 1, -2))),
        moment(after_number(unit_label(units, 2, 1, -2))),
        stress(after_number(unit_label(units, -1, 1, -2))),
        energy(after_number(energy_label(units))) {}
  std::string length, force, moment, stress, energy;
};

/// Vector as text; components that are round-off relative to `size` are 0.
std::string vector_text(const Vector3d& v, double size) {
  const Vector3d w = v.unaryExpr([size](double x) { return std::abs(x) <= 1e-12 * size ? 0.0 : x; });
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", w.x(), w.y(), w.z());
}

Vector3d middle_of(const Solution& s, const MeshSupport& support) {
  Vector3d sum = Vector3d::Zero();
  for (const int node : support.nodes) sum += s.mesh.position.col(node);
  return sum / static_cast<double>(support.nodes.size());
}

std::string node_text(const Solution& s, Index node) {
  const Vector3d x = s.mesh.position.col(node);
  return fmt::format("{} {}", printable_line(s.mesh.node_label[node], 60), vector_text(x, s.system.length));
}

std::string components_text(Components components) {
  constexpr std::array<const char*, 6> words{"x", "y", "z", "rx", "ry", "rz"};
  std::vector<std::string> held;
  for (int c = 0; c < 6; ++c)
    if ((components >> c & 1) != 0) held.emplace_back(words[c]);
  return join(held, " ");
}

std::string head_text(const Solution& s, const formats::Part& part) {
  std::string text = fmt::format("part '{}'  {} nodes, {} elements, {} coordinates, mass {:.9g}{} ({})\n", part.name,
                                 s.mesh.nodes(), s.mesh.elements(), s.system.size(), s.rigid.mass,
                                 after_number(unit_label(part.units, 0, 1, 0)), part.file);
  for (const MeshSupport& support : s.mesh.supports)
    text += fmt::format(line_form, "support",
                        fmt::format("{}: {} node{}, {}", support.name, support.nodes.size(),
                                    support.nodes.size() == 1 ? "" : "s", components_text(support.components)));
  text += s.is_free ? fmt::format(line_form, "support", "none: the part is free")
                    : fmt::format(line_form, "held", fmt::format("{} coordinates", s.partition.n_B()));
  for (const std::string& warning : s.warnings) text += fmt::format(line_form, "warning", warning);
  return text;
}

std::string peaks_text(const Solution& s, Index c, const Labels& labels) {
  constexpr double round_off = 1e-9;
  const Eigen::MatrixXd motion = node_motions(s.system, s.statics.q.col(c));
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> nodes(motion.data(), 6, s.mesh.nodes());
  const Index moved = first_longest(nodes.topRows<3>(), round_off),
              turned = first_longest(nodes.bottomRows<3>(), round_off);
  const double most = nodes.col(moved).head<3>().norm(), turn = nodes.col(turned).tail<3>().norm();
  std::string text = fmt::format(line_form, "displacement",
                                 fmt::format("largest {:.6g}{}, {}, at {}", most, labels.length,
                                             vector_text(nodes.col(moved).head<3>(), most), node_text(s, moved)));
  if (turn > 0.0)
    text += fmt::format(line_form, "rotation",
                        fmt::format("largest {:.6g} rad, {}, at {}", turn,
                                    vector_text(nodes.col(turned).tail<3>(), turn), node_text(s, turned)));
  const formats::Recovery& r = s.tables;
  const InstantPeaks peaks = instant_peaks(r, instant_values(r, solid_points(r), s.fields, c));
  const auto element = [&](const char* what, const LargestAt& peak) {
    if (peak.at < 0) return;
    text += fmt::format(line_form, what,
                        fmt::format("largest {:.6g}{} at {} {}", peak.value, labels.stress, element_text(r, peak.at),
                                    vector_text(element_middle(r, peak.at), s.system.length)));
  };
  element("normal, beams", peaks.beam);
  element("von Mises, shells", peaks.shell);
  if (peaks.solid.at >= 0)
    text += fmt::format(
        line_form, "von Mises, solids",
        fmt::format("largest {:.6g}{} at {}", peaks.solid.value, labels.stress, node_text(s, peaks.solid.at)));
  return text;
}

std::string case_text(const Solution& s, Index c, const Labels& labels) {
  const Vector6 applied = s.loads.applied.col(c);
  const double size = s.loads.size[c], moments = size * (s.system.length + s.system.middle.norm());
  const auto wrench = [&](const Vector6& w) {
    return fmt::format("force {}{}, moment {}{}", vector_text(w.head<3>(), size), labels.force,
                       vector_text(w.tail<3>(), moments), labels.moment);
  };
  std::string text = fmt::format("\nload case '{}'\n", s.mesh.load_cases[c].name);
  text += fmt::format(line_form, "applied", wrench(applied) + " about the origin");
  text += peaks_text(s, c, labels);
  text += fmt::format(line_form, "strain energy", fmt::format("{:.9g}{}", s.statics.energy[c], labels.energy));
  for (int k = 0; k < std::ssize(s.mesh.supports); ++k) {
    const MeshSupport& support = s.mesh.supports[k];
    const Vector3d point = middle_of(s, support);
    text += fmt::format(line_form, "reaction",
                        fmt::format("{}: {} about {}", support.name, wrench(reaction_of(s, k, c, point)),
                                    vector_text(point, s.system.length)));
  }
  text += fmt::format(line_form, "equilibrium",
                      fmt::format("load and reactions are in equilibrium to {:.1e} of the load", imbalance(s, c)));
  return text + fmt::format(line_form, "residual", fmt::format("{:.1e}, after refinement", s.statics.residual[c]));
}

std::string modes_text(const Solution& s, const Units& units) {
  const SupportedModes& modes = *s.modes;
  std::string text =
      fmt::format("\nmodes, {}\n",
                  !s.is_free ? "supported" : fmt::format("free: {} rigid motions at frequency 0, then", modes.rigid));
  const std::string unit = frequency_unit(units);
  text += fmt::format("  {:>4} {:>16}{}\n", "mode", "frequency [" + unit + "]",
                      s.is_free ? "" : "   effective mass and inertia [% of the whole part]: x, y, z, rx, ry, rz");
  Vector6 whole;
  whole << s.rigid.mass, s.rigid.mass, s.rigid.mass, s.rigid.inertia.diagonal();
  Vector6 sum = Vector6::Zero();
  const auto percent = [&whole](const Vector6& part) {
    std::string cells;
    for (int k = 0; k < 6; ++k) cells += fmt::format(" {:>7.2f}", whole[k] > 0.0 ? 100.0 * part[k] / whole[k] : 0.0);
    return cells;
  };
  for (Index k = 0; k < modes.lambda.size(); ++k) {
    sum += modes.effective.col(k);
    text += fmt::format("  {:>4} {:>16.8g}{}\n", k + 1, frequency(modes.lambda[k]),
                        s.is_free ? "" : "  " + percent(modes.effective.col(k)));
  }
  if (!s.is_free) text += fmt::format("  {:>4} {:>16}  {}\n", "sum", "", percent(sum));
  text += fmt::format("eigenvalues by {}, largest residual {:.1e}\n", modes.solver.text, modes.solver.residual);
  for (const std::string& note : modes.solver.notes) text += note + "\n";
  return text;
}

/// Node and axes of the largest motion or rotation in a buckling shape.
std::string shape_text(const Solution& s, const Eigen::MatrixXd& motion, Index k) {
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> nodes(motion.col(k).data(), 6, s.mesh.nodes());
  constexpr double round_off = 1e-6;
  const Index moved = first_longest(nodes.topRows<3>(), round_off),
              turned = first_longest(nodes.bottomRows<3>(), round_off);
  const auto flat = [](const Vector3d& v) {
    return vector_text(v.unaryExpr([](double x) { return std::abs(x) < round_off ? 0.0 : x; }), 1.0);
  };
  if (nodes.col(moved).head<3>().norm() > 0.5)
    return fmt::format("moves {} at {}", flat(nodes.col(moved).head<3>()), node_text(s, moved));
  return fmt::format("turns {} at {}", flat(nodes.col(turned).tail<3>()), node_text(s, turned));
}

/// Number of existing load factors, by inertia.
std::string count_text(const CaseBuckling& b) {
  const auto found = count_of(b.factor);
  if (found == 0) return fmt::format("no load factor up to {:.3g}: this load does not buckle the part", b.limit);
  if (found < b.asked)
    return fmt::format("only {} of the {} requested load factors exist up to {:.3g}", found, b.asked, b.limit);
  if (b.more_equal > 0)
    return fmt::format(
        "no load factor below the last one is missing (count by inertia); {} more are equal to the last one",
        b.more_equal);
  return "no load factor below the last one is missing (count by inertia)";
}

std::string buckling_text(const Solution& s, Index c) {
  const CaseBuckling& b = s.buckling[c];
  const Eigen::MatrixXd motion = node_motions(s.system, b.q);
  std::string text = fmt::format("\nbuckling, load case '{}'\n", s.mesh.load_cases[c].name);
  if (b.factor.size() > 0)
    text += fmt::format("  {:>4} {:>16}   largest motion of the shape, scaled to 1\n", "mode", "load factor");
  for (Index k = 0; k < b.factor.size(); ++k)
    text += fmt::format("  {:>4} {:>16.8g}   {}\n", k + 1, b.factor[k], shape_text(s, motion, k));
  text += fmt::format(line_form, "count", count_text(b));
  if (b.reversed)
    text += fmt::format(line_form, "reversed load", fmt::format("buckles at a load factor of {:.8g}", -*b.reversed));
  if (b.factor.size() > 0)
    text += fmt::format(line_form, "residual",
                        fmt::format("{:.1e} of the shape, both in the norm of the stiffness matrix", b.residual));
  return text;
}

}  // namespace

Vector6 reaction_of(const Solution& s, int support, Index load_case, const Vector3d& point) {
  Vector6 sum = Vector6::Zero();
  const Eigen::MatrixXd R = rigid_motions_about(s.system, point);
  for (Index b = 0; b < s.partition.n_B(); ++b)
    if (support < 0 || s.partition.boundary_node[b] == support)
      sum += s.statics.reaction(b, load_case) * R.row(s.partition.boundary[b]).transpose();
  return sum;
}

double imbalance(const Solution& s, Index load_case) {
  const double size = s.loads.size[load_case];
  if (!(size > 0.0)) return 0.0;
  const Vector3d origin = Vector3d::Zero();
  const Vector6 rest = s.loads.applied.col(load_case) + reaction_of(s, -1, load_case, origin);
  return std::max(rest.head<3>().norm(), rest.tail<3>().norm() / (s.system.length + s.system.middle.norm())) / size;
}

std::string solution_text(const Solution& s, const formats::Part& part) {
  const Labels labels(part.units);
  std::string text = head_text(s, part);
  for (Index c = 0; c < s.statics.q.cols(); ++c) text += case_text(s, c, labels);
  if (s.modes) text += modes_text(s, part.units);
  for (Index c = 0; c < static_cast<Index>(s.buckling.size()); ++c) text += buckling_text(s, c);
  return text;
}

}  // namespace tisserand::reducer
