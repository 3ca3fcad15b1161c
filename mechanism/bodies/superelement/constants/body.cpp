// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of a body from a superelement file: order of rows, units, canonical form, weights.
#include "mechanism/bodies/superelement/constants/body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/error.hpp"
#include "common/stable_sort.hpp"
#include "formats/superelement/canonical.hpp"
#include "formats/superelement/weights.hpp"

namespace tisserand::mechanism {

using formats::canonical_form;
using formats::CanonicalMatrices;
using formats::complete_cluster;
using formats::PartitionedMatrices;

namespace {

std::string node_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

int find_node(const SuperelementBody& body, const std::string& name, const std::string& where) {
  for (int i = 0; i < std::ssize(body.node); ++i)
    if (body.node[i].name == name) return i;
  std::vector<std::string> names;
  for (const SuperelementNode& node : body.node) names.push_back(node.name);
  throw Error(fmt::format("superelement '{}' has no node '{}'", body.name, name), where,
              "its nodes are " + node_list(names));
}

/// Orders the rows of the boundary vector per node [x, Θ] and the file's row of each; internal rows keep their order.
void order_rows(const formats::Superelement& element, const std::string& where, SuperelementBody& body) {
  const std::size_t nodes = element.node_name.size();
  std::vector<std::array<int, 6>> row(nodes, {-1, -1, -1, -1, -1, -1});
  for (int i = 0; i < std::ssize(element.dof_node); ++i) {
    const int node = element.dof_node[i], component = element.dof_component[i];
    if (node < 0) {
      body.file.internal_row.push_back(i);
      continue;
    }
    TISSERAND_ENSURE(node < static_cast<int>(nodes) && component >= 0 && component < 6, "node {} component {}", node,
                     component);
    row[node][component] = i;
  }
  sort_stably(body.file.internal_row,
              [&](int a, int b) { return element.dof_component[a] < element.dof_component[b]; });
  for (std::size_t i = 0; i < nodes; ++i) {
    SuperelementNode node;
    node.name = element.node_name[i];
    for (int part = 0; part < 2; ++part) {
      const auto first = row[i].begin() + 3 * part;
      const auto present = 3 - std::count(first, first + 3, -1);
      if (present != 0 && present != 3)
        throw Error(
            fmt::format("node '{}' has {} of three {}", node.name, present, part == 0 ? "translations" : "rotations"),
            where, "a boundary node keeps all three translations or none, all three rotations or none");
      if (present == 0) continue;
      (part == 0 ? node.translation_row : node.rotation_row) = body.boundary_size;
      (part == 0 ? body.translation_nodes : body.rotation_nodes).push_back(static_cast<int>(i));
      body.file.boundary_row.insert(body.file.boundary_row.end(), first, first + 3);
      body.boundary_size += 3;
    }
    if (!node.has_translation() && !node.has_rotation())
      throw Error(fmt::format("boundary node '{}' has no degrees of freedom", node.name), where,
                  "remove it from the file");
    body.node.push_back(node);
  }
  if (body.translation_nodes.empty())
    throw Error("no boundary node has translations", where, "keep the translations of at least one boundary node");
}

/// Boundary rows first, in units of the scene: S has energy/(unit of row · unit of column), M has mass instead of
/// energy. Internal coordinates keep their numbers.
PartitionedMatrices partition(const formats::Superelement& element, const UnitConversion& units,
                              const SuperelementBody& body) {
  const Eigen::Index nb = body.boundary_size, n = element.size();
  std::vector<int> rows = body.file.boundary_row;
  rows.insert(rows.end(), body.file.internal_row.begin(), body.file.internal_row.end());
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(n);
  for (Eigen::Index i = 0; i < nb; ++i)
    if (element.dof_component[rows[i]] < 3) unit[i] = 1.0 / units.length;
  const double inertia = units.mass * units.length * units.length;
  const double energy = inertia / (units.time * units.time);
  PartitionedMatrices out;
  out.boundary_size = nb;
  out.stiffness = energy * (unit.asDiagonal() * element.stiffness(rows, rows) * unit.asDiagonal());
  out.mass = inertia * (unit.asDiagonal() * element.mass(rows, rows) * unit.asDiagonal());
  return out;
}

Eigen::Index modes_to_keep(const Eigen::VectorXd& eigenvalue, const SuperelementOptions& options) {
  Eigen::Index wanted = eigenvalue.size();
  if (options.modes) {
    if (*options.modes < 0 || *options.modes > eigenvalue.size())
      throw Error(fmt::format("{} modes are requested, but the superelement has {}", *options.modes, eigenvalue.size()),
                  options.where, fmt::format("choose 0 to {}", eigenvalue.size()));
    wanted = *options.modes;
  }
  if (options.cutoff) {
    if (!(*options.cutoff > 0.0))
      throw Error(fmt::format("cutoff is {:g}", *options.cutoff), options.where, "choose a frequency above 0");
    const double limit = std::pow(2.0 * std::numbers::pi * *options.cutoff, 2);
    wanted = std::min<Eigen::Index>(wanted, (eigenvalue.array() <= limit).count());
  }
  return wanted;
}

void cut_modes(const SuperelementOptions& options, CanonicalMatrices& matrices, SuperelementBody& body) {
  const Eigen::Index loose = (matrices.S_II.array() <= 0.0).count();  // mechanisms move with any cut
  const Eigen::Index wanted = std::max(loose, modes_to_keep(matrices.S_II, options));
  const Eigen::Index kept = complete_cluster(matrices.S_II, wanted);
  if (kept != wanted)
    body.notes.push_back(
        fmt::format("{} internal modes are kept instead of {}: mode {} has the same frequency as mode {}.", kept,
                    wanted, wanted + 1, wanted));
  if (matrices.massless > 0)
    body.notes.push_back(
        fmt::format("{} internal coordinates have no mass and were eliminated statically.", matrices.massless));
  body.modes = static_cast<int>(kept);
  body.S_BB = matrices.S_BB;
  body.M_BB = matrices.M_BB;
  body.M_BI = matrices.M_BI.leftCols(kept);
  body.M_IB = body.M_BI.transpose();
  body.S_II = matrices.S_II.head(kept);
  body.file.static_part = matrices.static_part;
  body.file.modal_part = matrices.modal_part.leftCols(kept);
}

/// Weights alpha of the nodes in `members`: given by the user, by the frame node, or from the centre of mass.
Eigen::VectorXd choose_weights(const std::vector<int>& members, const std::vector<formats::NodeWeight>& given,
                               int frame_node, const Eigen::Matrix3Xd& position, const Eigen::Vector3d& center,
                               const char* what, const std::string& where, SuperelementBody& body) {
  const auto count = static_cast<Eigen::Index>(members.size());
  Eigen::VectorXd alpha = Eigen::VectorXd::Zero(count);
  const auto place = [&](int node, const std::string& name) {
    const auto found = std::find(members.begin(), members.end(), node);
    if (found == members.end())
      throw Error(fmt::format("node '{}' has no {}s and cannot carry a weight of {}", name, what, what), where,
                  fmt::format("name a node with {}s", what));
    return static_cast<Eigen::Index>(found - members.begin());
  };
  if (frame_node >= 0) {
    alpha[place(frame_node, body.node[frame_node].name)] = 1.0;
    return alpha;
  }
  if (!given.empty()) {
    for (const formats::NodeWeight& weight : given)
      alpha[place(find_node(body, weight.node, where), weight.node)] += weight.weight;
    const double sum = alpha.sum();
    if (!(std::abs(sum - 1.0) < 1e-6))
      throw Error(fmt::format("weights of {} of '{}' have the sum {:.9g}", what, body.name, sum), where,
                  "choose weights with the sum 1");
    return alpha / sum;
  }
  const Eigen::Matrix3Xd points = position(Eigen::all, members);
  const formats::Weights weights = formats::frame_weights(points, center);
  if (weights.flat)
    body.notes.push_back(
        fmt::format("the nodes of '{}' lie nearly in one plane or on one line, so the {} weights place the frame there "
                    "and not at the centre of mass.",
                    body.name, what));
  return weights.alpha;
}

void set_polar_weights(const SuperelementOptions& options, const Eigen::Matrix3Xd& position, SuperelementBody& body) {
  const auto count = static_cast<Eigen::Index>(body.translation_nodes.size());
  Eigen::VectorXd w = Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count));
  if (!options.rotation_weights.empty())
    w = choose_weights(body.translation_nodes, options.rotation_weights, -1, position, Eigen::Vector3d::Zero(),
                       "translation", options.where, body);
  if ((w.array() < 0.0).any())
    throw Error("a rotation weight is negative", options.where,
                "a body whose nodes have no rotations needs weights of 0 or more");
  const Eigen::Matrix3Xd points = position(Eigen::all, body.translation_nodes);
  const Eigen::Vector3d mean = points * w;
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < count; ++k) {
    SuperelementNode& node = body.node[body.translation_nodes[k]];
    node.polar_weight = w[k];
    node.X_polar = points.col(k) - mean;
    D += w[k] * (node.X_polar.squaredNorm() * Eigen::Matrix3d::Identity() - node.X_polar * node.X_polar.transpose());
  }
  if (!(D.determinant() > 1e-12 * std::pow(D.trace(), 3)))
    throw Error(fmt::format("the nodes of '{}' have no rotations and lie on one line", body.name), options.where,
                "keep the rotations of at least one boundary node, or a node off the line");
}

void choose_frame(const SuperelementOptions& options, SuperelementBody& body) {
  if (body.rotation_nodes.empty()) {
    if (options.frame == formats::FrameKind::node)
      throw Error(fmt::format("frame node '{}' has no rotations", options.frame_node), options.where,
                  "use frame: karcher");
    body.frame = FrameAlgorithm::polar;
    return;
  }
  for (const int i : body.rotation_nodes)
    if (std::abs(body.node[i].alpha_rotation - 1.0) < 1e-15) body.frame_node = i;
  const bool single = body.frame_node >= 0 &&
                      std::all_of(body.rotation_nodes.begin(), body.rotation_nodes.end(),
                                  [&](int i) { return i == body.frame_node || body.node[i].alpha_rotation == 0.0; });
  if (single) {
    body.frame = FrameAlgorithm::single_node;
    return;
  }
  body.frame_node = -1;
  const bool second_order =
      options.inertia == formats::InertiaOption::F || options.stiffening != formats::StiffeningOption::off;
  if (options.frame == formats::FrameKind::paper && (options.inertia == formats::InertiaOption::M || second_order))
    throw Error(fmt::format("{} cannot be combined with the incremental frame ('frame: paper')",
                            options.inertia == formats::InertiaOption::M   ? "inertia M"
                            : options.inertia == formats::InertiaOption::F ? "inertia F"
                                                                           : "stiffening"),
                options.where,
                second_order ? "choose 'frame: karcher' or a node, or second_order: off"
                             : "choose 'frame: karcher' or a node, or inertia A or B");
  if (options.frame == formats::FrameKind::paper)
    body.frame = FrameAlgorithm::incremental;
  else
    body.frame = body.rotation_nodes.size() == 2 ? FrameAlgorithm::pair : FrameAlgorithm::karcher;
}

void set_frame(const formats::Superelement& element, const formats::RigidProperties& rigid,
               const SuperelementOptions& options, SuperelementBody& body) {
  const Eigen::Matrix3Xd position = options.units.length * element.node_position.transpose();
  const Eigen::Vector3d center = options.units.length * rigid.center_of_mass;
  const int attached =
      options.frame == formats::FrameKind::node ? find_node(body, options.frame_node, options.where) : -1;
  const Eigen::VectorXd alpha = choose_weights(body.translation_nodes, options.position_weights, attached, position,
                                               center, "translation", options.where, body);
  for (std::size_t k = 0; k < body.translation_nodes.size(); ++k) {
    const int i = body.translation_nodes[k];
    body.node[i].alpha = alpha[k];
    body.reference_origin += alpha[k] * position.col(i);
  }
  for (std::size_t i = 0; i < body.node.size(); ++i) body.node[i].X = position.col(i) - body.reference_origin;
  if (body.rotation_nodes.empty()) {
    set_polar_weights(options, position, body);
  } else {
    const Eigen::VectorXd alpha_rotation = choose_weights(body.rotation_nodes, options.rotation_weights, attached,
                                                          position, center, "rotation", options.where, body);
    for (std::size_t k = 0; k < body.rotation_nodes.size(); ++k)
      body.node[body.rotation_nodes[k]].alpha_rotation = alpha_rotation[k];
  }
  choose_frame(options, body);
  body.mass = options.units.mass * rigid.mass;
  body.center_of_mass = center - body.reference_origin;
}

void set_gravity_constants(SuperelementBody& body) {
  body.Gamma_B.setZero(3, body.boundary_size);
  body.Gamma_I.setZero(3, body.modes);
  for (const int i : body.translation_nodes) {
    const int row = body.node[i].translation_row;
    body.Gamma_B += body.M_BB.middleRows<3>(row);
    body.Gamma_I += body.M_BI.middleRows<3>(row);
  }
}

void use_companion(const formats::Superelement& element, const CanonicalMatrices& matrices,
                   const SuperelementOptions& options, SuperelementBody& body) {
  TISSERAND_ENSURE(options.companion != nullptr, "no companion of '{}'", body.name);
  formats::Companion companion = *options.companion;
  std::erase_if(companion.load_cases, [&](const formats::LoadCase& load) {
    return !std::binary_search(options.load_cases.begin(), options.load_cases.end(), load.name);
  });
  if (!options.double_curvature) companion.Lambda.clear();
  companion = companion_on_body(std::move(companion), element, matrices, options.units, body);
  if (companion.has_second_order())
    body.second_order = make_second_order(body, companion, options.inertia, options.stiffening);
  body.load_cases = make_load_cases(body, companion);
}

}  // namespace

SuperelementBody build_superelement_body(const formats::Superelement& element, const formats::RigidProperties& rigid,
                                         const SuperelementOptions& options) {
  SuperelementBody body;
  body.name = element.name;
  body.inertia = options.inertia;
  order_rows(element, options.where, body);
  CanonicalMatrices matrices = canonical_form(partition(element, options.units, body), options.where);
  cut_modes(options, matrices, body);
  set_frame(element, rigid, options, body);
  set_gravity_constants(body);
  if (options.inertia == formats::InertiaOption::F || options.stiffening != formats::StiffeningOption::off ||
      !options.load_cases.empty())
    use_companion(element, matrices, options, body);
  set_damping(options.damping, options.where, body);
  return body;
}

}  // namespace tisserand::mechanism
