// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of modal bodies in the units of the scene.
#include "mechanism/build/modal_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/build/bodies.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

int count_modes(const formats::ModalBody& file, const formats::ModalBodySpec& spec, const UnitConversion& units) {
  const int all = static_cast<int>(file.modes());
  if (spec.modes && *spec.modes > all)
    throw Error(fmt::format("body '{}': {} modes are requested, but the file has {}", spec.name, *spec.modes, all),
                spec.where, "request fewer modes, or write a file with more modes");
  if (count_of(spec.damping.ratios) > all)
    throw Error(fmt::format("body '{}': damping: {} ratios for {} modes", spec.name, spec.damping.ratios.size(), all),
                spec.where, "give at most one ratio per mode");
  if (spec.modes) return *spec.modes;
  if (!spec.cutoff) return all;
  const double limit = 2.0 * std::numbers::pi * *spec.cutoff * units.time;
  int count = 0;
  while (count < all && std::sqrt(file.omega2[count]) < limit) ++count;
  return count;
}

void set_integrals(const formats::ModalIntegrals& sums, const UnitConversion& units, ModalBody& body) {
  const Index m = body.modes;
  const double root = std::sqrt(units.mass), l = units.length;
  body.mass = units.mass * sums.mass;
  body.c0 = units.mass * l * sums.c0;
  body.C1 = root * sums.C1.leftCols(m);
  body.P0 = units.mass * l * l * sums.P0;
  body.P1 = root * l * sums.P1.head(9 * m);
  body.P2 = sums.P2.topLeftCorner(9 * m, m);
  body.J_mu = units.mass * l * l * sums.J_mu;
  body.N_mu = root * l * sums.N_mu.leftCols(m);
}

void set_stiffness(const formats::ModalBody& file, const formats::Damping& damping, const UnitConversion& units,
                   ModalBody& body) {
  body.stiffness = file.omega2.head(body.modes) / (units.time * units.time);
  body.damping.resize(body.modes);
  for (Index j = 0; j < body.modes; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const double ratio = file.zeta[j] + (at < damping.ratios.size() ? damping.ratios[at] : damping.ratio);
    body.damping[j] = damping.mass + damping.stiffness * body.stiffness[j] + 2.0 * ratio * std::sqrt(body.stiffness[j]);
  }
}

/// Whether the rotation of node k is known: it has rows, or the reference conditions hold all three of its rotations.
bool node_turns(const formats::ModalBody& file, std::size_t k) {
  if (file.modes() == 0 || !file.X[k].bottomRows<3>().isZero(0.0)) return true;
  int held = 0;
  for (std::size_t i = 0; i < file.reference_node.size(); ++i)
    if (file.reference_node[i] == static_cast<int>(k) && file.reference_component[i] >= 3) ++held;
  return held == 3;
}

constexpr double reported_excess = 0.02;  ///< smallest excess of the first frequency that is reported
constexpr double share_of_a_row = 0.1;    ///< smallest entry of a held component, relative to the largest of its row

/// Adds six rows of a joint's side on a body, in components of the body: axes of the frame, units of the file.
void add_rows(const ReferenceModel& model, const std::string& node, const Eigen::Matrix<double, Eigen::Dynamic, 6>& B,
              const Eigen::Matrix3d& R, MatrixXd& held) {
  const Index first = held.rows();
  held.conservativeResize(first + B.rows(), static_cast<Index>(model.nodes.size()));
  held.bottomRows(B.rows()).setZero();
  for (std::size_t k = 0; k < model.nodes.size(); ++k) {
    if (model.nodes[k] != node) continue;
    const int c = model.component[k];
    const auto column = static_cast<Index>(k);
    if (c < 3)
      held.col(column).tail(B.rows()) = model.units.length * (B.leftCols<3>() * R.col(c));
    else
      held.col(column).tail(B.rows()) = B.col(c);
  }
}

/// Ground, and nodes that fixed joints hold on it.
std::set<int> grounded(const Model& model) {
  std::set<int> nodes{-1};
  for (const Joint& joint : model.joints) {
    if (joint.kind != JointKind::fixed || (joint.a.node >= 0) == (joint.b.node >= 0)) continue;
    const int node = std::max(joint.a.node, joint.b.node);
    if (model.nodes[node].modal < 0 && model.nodes[node].translation >= 0 && model.nodes[node].rotation >= 0)
      nodes.insert(node);
  }
  return nodes;
}

/// Rows of the body's components that joints to the nodes `others` (empty: to all other bodies) hold. Without rows if a
/// joint acts where the file has no component.
MatrixXd held_rows(const ReferenceModel& model, const Construction& c, const std::set<int>& others) {
  MatrixXd held(0, static_cast<Index>(model.nodes.size()));
  const auto motion = [&c](int node) { return node < 0 ? NodeMotion{} : c.markers.start[node]; };
  const auto is_own = [&](int node) {
    return node >= 0 && c.model.nodes[node].modal >= 0 &&
           c.model.modal_bodies[c.model.modal_nodes[c.model.nodes[node].modal].body].name == model.name;
  };
  for (const Joint& joint : c.model.joints)
    for (const bool first : {true, false}) {
      const int own = first ? joint.a.node : joint.b.node, other = first ? joint.b.node : joint.a.node;
      if (!is_own(own) || is_own(other) || (!others.empty() && !others.contains(other))) continue;
      const std::string& node = c.model.nodes[own].name;
      if (std::ranges::find(model.nodes, node) == model.nodes.end()) return MatrixXd(0, held.cols());
      JointTerms terms;
      joint_constraints(joint, motion(joint.a.node), motion(joint.b.node), terms);
      const Eigen::Matrix<double, Eigen::Dynamic, 6> B = terms.B.middleCols<6>(first ? 0 : 6).topRows(joint.size());
      add_rows(model, node, B, c.markers.start[model.frame].R, held);
    }
  return held;
}

/// Text "'r' (rotations y, z)" of components that joints hold and the reference conditions do not.
std::string beyond_reference(const ReferenceModel& model, const MatrixXd& held) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < model.nodes.size();) {
    std::size_t end = k;
    std::string moves, turns;
    for (; end < model.nodes.size() && model.nodes[end] == model.nodes[k]; ++end) {
      bool counts = false;
      for (Index r = 0; r < held.rows(); ++r)
        counts = counts || (!model.held[end] && std::abs(held(r, static_cast<Index>(end))) >
                                                    share_of_a_row * held.row(r).cwiseAbs().maxCoeff());
      if (!counts) continue;
      std::string& text = model.component[end] < 3 ? moves : turns;
      text += (text.empty() ? "" : ", ") + std::string(1, "xyz"[model.component[end] % 3]);
    }
    const std::string own = model.nodes[k].substr(model.name.size() + 1);
    if (!moves.empty() && !turns.empty()) moves += ", ";
    if (!turns.empty()) moves += (turns.size() > 1 ? "rotations " : "rotation ") + turns;
    if (!moves.empty()) texts.push_back(fmt::format("'{}' ({})", own, moves));
    k = end;
  }
  return join(texts, ", ");
}

/// Both frequencies are Rayleigh-Ritz bounds in nested spaces, so their difference is no artefact.
std::string too_stiff(const ReferenceModel& model, const MatrixXd& held, const HeldFrequencies& found,
                      const Units& units) {
  const double to_hertz = 1.0 / (2.0 * std::numbers::pi * model.units.time);
  const std::string what = beyond_reference(model, held), unit = unit_label(units, 0, 0, -1) == "s^-1" ? " Hz" : "";
  const std::string by_modes = std::isinf(found.by_modes)
                                   ? fmt::format("cannot deform with its {} modes", model.omega2.size())
                                   : fmt::format("has its first frequency at {:.4g}{} with its {} modes",
                                                 found.by_modes * to_hertz, unit, model.omega2.size());
  return fmt::format(
      "modal body '{}' is too stiff. The scene holds it on the ground at {}, but the `reference` of its modes leaves "
      "this free. Held in this way, the body alone {}. With its static flexibility there, its first frequency is "
      "{:.4g}{}. Use more modes, a `reference` that holds the same as the scene, or the superelement of the part",
      model.name, what.empty() ? "its nodes" : what, by_modes, found.with_residual * to_hertz, unit);
}

}  // namespace

BuiltModalBody build_modal_body(const formats::ModalBody& file, const formats::ModalBodySpec& spec,
                                const UnitConversion& units) {
  BuiltModalBody built;
  ModalBody& body = built.body;
  body.name = spec.name;
  body.modes = count_modes(file, spec, units);
  set_integrals(file.integrals, units, body);
  set_stiffness(file, spec.damping, units, body);
  if (!spec.terms.damping) body.damping.setZero();
  const double root = std::sqrt(units.mass);
  for (std::size_t k = 0; k < file.node_name.size(); ++k) {
    ModalNode node;
    node.name = file.node_name[k];
    node.turns = node_turns(file, k);
    node.x = units.length * file.node_position.row(k).transpose();
    node.Xd = file.X[k].topRows<3>().leftCols(body.modes) / root;
    node.Xt = file.X[k].bottomRows<3>().leftCols(body.modes) / (root * units.length);
    built.nodes.push_back(std::move(node));
  }
  built.frame_position = units.length * file.frame_position;
  built.frame_rotation = quaternion(file.frame_orientation).normalized().toRotationMatrix();
  return built;
}

void note_held_modes(Construction& c) {
  const std::set<int> ground = grounded(c.model);
  for (const ReferenceModel& model : c.reference_models) {
    const MatrixXd held = held_rows(model, c, ground);
    if (held.rows() == 0 || model.omega2.size() == 0) continue;
    const HeldFrequencies found = held_frequencies(model, held);
    if (!(found.with_residual > 0.0) || !(found.by_modes > (1.0 + reported_excess) * found.with_residual)) continue;
    // Checks again with all joints held: the modes may suit a body between moving ones.
    const HeldFrequencies joined = held_frequencies(model, held_rows(model, c, {}));
    if (joined.by_modes > 0.0 && joined.by_modes < (1.0 + reported_excess) * joined.with_residual) continue;
    c.notes.push_back(too_stiff(model, held, found, c.model.units));
  }
}

}  // namespace tisserand::mechanism
