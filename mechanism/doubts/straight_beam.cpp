// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of superelements from their nodes, and rows of joints that act on rotations about them.
#include "mechanism/doubts/straight_beam.hpp"

#include <algorithm>
#include <numeric>

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;

/// Limit for a line, and for the effect on a rotation: a hundredth.
constexpr double small = 1e-2;

/// Axis of every node in node axes; zero if the node is on no straight body.
std::vector<Vector3d> node_axes(const Model& model, const Evaluation& evaluation, Twist& twist) {
  std::vector<Vector3d> axes(model.nodes.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const std::optional<Axis> axis = axis_of(body);
    for (const int j : body.rotation_nodes) {
      const int node = model.superelements[i].nodes[j];
      if (!axis) {
        twist.held[node] = true;
        continue;
      }
      const Vector3d own =
          evaluation.motion[node].R.transpose() * evaluation.superelements[i].motion.R0 * axis->direction;
      if (axes[node] == Vector3d::Zero())
        axes[node] = own;
      else if (own.cross(axes[node]).norm() > small)
        twist.held[node] = true;
    }
  }
  return axes;
}

/// Whether a row [x Θ] of one marker does work on rotations about the axis.
bool works_on(const Eigen::Matrix<double, 1, 6>& row, const Vector3d& axis, double length) {
  return std::abs(row.tail<3>().dot(axis)) > small * (row.tail<3>().norm() + length * row.head<3>().norm());
}

/// Marks the nodes on whose rotation about the axis the row does work.
template <class Item>
void note_row(const Item& item, const Row12& row, const std::vector<Vector3d>& axes, double length, Twist& twist) {
  if (item.a.node >= 0 && works_on(row.head<6>(), axes[item.a.node], length)) twist.held[item.a.node] = true;
  if (item.b.node >= 0 && works_on(row.tail<6>(), axes[item.b.node], length)) twist.held[item.b.node] = true;
}

/// Whether the joint welds two straight bodies in a row.
bool welds(const Joint& joint, const std::vector<Vector3d>& axes, const Evaluation& evaluation) {
  if (joint.kind != JointKind::fixed || joint.a.node < 0 || joint.b.node < 0) return false;
  const Vector3d a = evaluation.motion[joint.a.node].R * axes[joint.a.node],
                 b = evaluation.motion[joint.b.node].R * axes[joint.b.node];
  return a != Vector3d::Zero() && b != Vector3d::Zero() && a.cross(b).norm() < 10.0 * small;
}

/// Marks nodes of rigid bodies with a single joint: they follow it and hold nothing.
std::vector<bool> loose_bodies(const Model& model) {
  std::vector<int> uses(model.nodes.size(), 0);
  const auto count = [&](const auto& items, auto counts) {
    for (const auto& item : items)
      for (const int node : {item.a.node, item.b.node})
        if (node >= 0 && counts(item)) ++uses[node];
  };
  const auto always = [](const auto&) { return true; };
  count(model.joints, always);
  count(model.bushings, always);
  count(model.coordinates, [](const Coordinate& coordinate) { return coordinate.active; });
  std::vector<bool> loose(model.nodes.size(), false);
  for (const RigidBody& body : model.rigid_bodies) loose[body.node] = uses[body.node] < 2;
  return loose;
}

}  // namespace

std::optional<Axis> axis_of(const SuperelementBody& body) {
  Axis axis;
  for (const int a : body.translation_nodes)
    for (const int b : body.translation_nodes)
      if (const double span = (body.node[b].X - body.node[a].X).norm(); a < b && span > axis.span)
        axis = {a, b, span, {}};
  if (axis.span == 0.0) return std::nullopt;
  if (!body.node[axis.first].has_rotation() || !body.node[axis.last].has_rotation()) return std::nullopt;
  axis.direction = (body.node[axis.last].X - body.node[axis.first].X) / axis.span;
  for (const int j : body.translation_nodes) {
    const Vector3d arm = body.node[j].X - body.node[axis.first].X;
    if (arm.cross(axis.direction).norm() > 1e-3 * axis.span) return std::nullopt;
  }
  return axis;
}

double along(const Eigen::MatrixXd& matrix, const SuperelementNode& a, const SuperelementNode& b, const Axis& axis) {
  return axis.direction.dot(matrix.block<3, 3>(a.rotation_row, b.rotation_row) * axis.direction);
}

Twist twist_of(const Model& model, const Evaluation& evaluation) {
  const std::vector<bool> loose = loose_bodies(model);
  Twist twist{std::vector<int>(model.nodes.size()), std::vector<bool>(model.nodes.size(), false)};
  std::iota(twist.place.begin(), twist.place.end(), 0);
  const std::vector<Vector3d> axes = node_axes(model, evaluation, twist);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    if (welds(joint, axes, evaluation)) {
      const int from = twist.place[joint.a.node], to = twist.place[joint.b.node];
      std::ranges::replace(twist.place, from, to);
    } else if (!(joint.a.node >= 0 && loose[joint.a.node]) && !(joint.b.node >= 0 && loose[joint.b.node])) {
      for (int k = 0; k < joint.size(); ++k) note_row(joint, evaluation.joints[i].B.row(k), axes, model.length, twist);
    }
  }
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    if (model.coordinates[i].active)
      note_row(model.coordinates[i], evaluation.coordinates[i].G, axes, model.length, twist);
  for (const Bushing& bushing : model.bushings)
    for (const int node : {bushing.a.node, bushing.b.node})
      if (node >= 0) twist.held[node] = true;
  for (std::size_t node = 0; node < model.nodes.size(); ++node)
    if (twist.held[node]) twist.held[twist.place[node]] = true;
  return twist;
}

}  // namespace tisserand::mechanism
