// SPDX-License-Identifier: GPL-3.0-or-later
// Normal of the plane from joints, and rotation of every vector of the model.
#include <cmath>

#include "mechanism/build/planar.hpp"
#include "mechanism/model/bodies.hpp"
#include "mechanism/model/forces.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Components of unit vectors, and of positions relative to the scene, below this are round-off.
constexpr double round_off = 1e-12;

Vector3d with_largest_positive(const Vector3d& v) {
  Eigen::Index at = 0;
  v.cwiseAbs().maxCoeff(&at);
  return v[at] < 0.0 ? Vector3d(-v) : v;
}

bool has_plane(JointKind kind) {
  return kind == JointKind::revolute || kind == JointKind::planar || kind == JointKind::parallel_axes;
}

/// Rotation about z nearest to R.
Matrix3d turn_about_z(const Matrix3d& R) {
  const double size = std::hypot(R(0, 0) + R(1, 1), R(1, 0) - R(0, 1));
  const double c = (R(0, 0) + R(1, 1)) / size, s = (R(1, 0) - R(0, 1)) / size;
  Matrix3d turn = Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << c, -s, s, c;
  return turn;
}

/// Rotation of vectors to the axes of the model and of its nodes.
class PlaneTurn {
 public:
  PlaneTurn(const Matrix3d& axes, double length, const std::vector<NodeMotion>& start) : axes_(axes), length_(length) {
    for (const NodeMotion& node : start) own_.push_back(axes_with_z(node.R.transpose() * axes.col(2)));
  }

  const std::vector<Matrix3d>& own() const { return own_; }
  const Matrix3d& own(int node) const { return node < 0 ? axes_ : own_[node]; }
  Vector3d vector(const Vector3d& world) const { return axes_.transpose() * world; }
  Matrix3d orientation(const Matrix3d& R, int node) const { return turn_about_z(axes_.transpose() * R * own(node)); }
  void operator()(Vector3d& world) const { world = vector(world); }
  void operator()(Marker& marker) const {
    marker.p = (own(marker.node).transpose() * marker.p).eval();
    marker.R = (own(marker.node).transpose() * marker.R).eval();
    if (std::abs(marker.p.z()) <= round_off * length_) marker.p.z() = 0.0;
  }
  void operator()(NodeMotion& motion, int node) const {
    motion.x = vector(motion.x);
    motion.R = orientation(motion.R, node);
    motion.xd = vector(motion.xd);
    motion.Omega = (own(node).transpose() * motion.Omega).eval();
  }
  void tensor(int node, Matrix3d& A) const { A = (own(node).transpose() * A * own(node)).eval(); }

 private:
  Matrix3d axes_;
  double length_;
  std::vector<Matrix3d> own_;
};

void turn_markers(const PlaneTurn& turn, Construction& c) {
  Model& model = c.model;
  const auto pairs = [&turn](auto& pool) {
    for (auto& item : pool) {
      turn(item.a);
      turn(item.b);
    }
  };
  pairs(model.joints);
  pairs(model.coordinates);
  pairs(model.ties);
  pairs(model.channels);
  for (Place& place : model.places) turn(place.marker);
  for_each_force(model, [&turn](auto traits, auto& force) {
    for (const auto marker : traits.markers) turn(force.*marker);
  });
  for (Road& road : model.roads) {
    turn(road.p);
    road.R = (model.axes.transpose() * road.R).eval();
  }
  for (BodyStart& start : c.starts) turn(start.origin);
}

template <int N>
void turn_beams(const PlaneTurn& turn, Pool<BeamElement<N>>& pool) {
  for (BeamElement<N>& beam : pool)
    for (int k = 0; k < N; ++k) {
      beam.section[k] = (turn.own(beam.nodes[k]).transpose() * beam.section[k]).eval();
      turn.tensor(beam.nodes[k], beam.inertia[k]);
    }
}

void turn_bodies(const PlaneTurn& turn, Construction& c) {
  Model& model = c.model;
  turn_beams(turn, model.beams2);
  turn_beams(turn, model.beams3);
  for (RigidBody& body : model.rigid_bodies) turn.tensor(body.node, body.inertia);
  for (std::size_t i = 0; i < c.frames.size(); ++i) {
    const int node = model.superelements[i].nodes.front();
    c.frames[i] = Eigen::Quaterniond(turn.orientation(c.frames[i].toRotationMatrix(), node));
  }
  for_each_body_pool(model, [&turn](auto& pool) {
    for (auto& body : pool) turn(body.gravity);
  });
}

void turn_forces(const PlaneTurn& turn, Construction& c) {
  for (Load& load : c.model.loads)
    if (load.axes == formats::LoadAxes::world) load.turn = c.model.axes.transpose();
  for (PartLoad& load : c.model.part_loads) {
    if (load.node < 0) continue;
    load.force = (turn.own(load.node).transpose() * load.force).eval();
    load.moment = (turn.own(load.node).transpose() * load.moment).eval();
  }
  for (Channel& channel : c.model.channels) {
    turn(channel.axis);
    turn(channel.origin);
  }
}

/// Normal to gravity and the lines between nodes: the first two that are not parallel define it. z if all are parallel.
Vector3d normal_of_places(const Construction& c) {
  std::vector<Vector3d> lines{c.scene.gravity};
  for (const NodeMotion& node : c.markers.start) lines.emplace_back(node.x - c.markers.start.front().x);
  Vector3d first = Vector3d::Zero();
  for (const Vector3d& line : lines) {
    if (first.isZero(0.0)) first = line;
    const Vector3d normal = first.cross(line);
    if (normal.norm() > 1e-6 * first.norm() * line.norm()) return with_largest_positive(normal.normalized());
  }
  return Vector3d::UnitZ();
}

}  // namespace

Vector3d find_normal(const Construction& c) {
  for (const Joint& joint : c.model.joints)
    if (has_plane(joint.kind))
      return with_largest_positive(marker_rotation(joint.a, c.markers.motion(joint.a.node)).col(2));
  for (const NodeMotion& node : c.markers.start)
    if (!node.Omega.isZero(0.0)) return with_largest_positive((node.R * node.Omega).normalized());
  return normal_of_places(c);
}

Matrix3d axes_with_z(const Vector3d& z) {
  Eigen::Index at = 0;
  const double largest = z.cwiseAbs().maxCoeff(&at);
  const int k = static_cast<int>(at);
  Matrix3d axes;
  if (largest >= 1.0 - round_off && (z - z[k] * Vector3d::Unit(k)).cwiseAbs().maxCoeff() <= round_off) {
    const double sign = z[k] < 0.0 ? -1.0 : 1.0;
    axes << Vector3d::Unit((k + 1) % 3), sign * Vector3d::Unit((k + 2) % 3), sign * Vector3d::Unit(k);
    return axes;
  }
  const Vector3d x = Vector3d::Unit((k + 1) % 3) - z[(k + 1) % 3] * z;
  axes << x.normalized(), z.cross(x.normalized()), z;
  return axes;
}

std::vector<Matrix3d> turn_into_plane(const Vector3d& normal, Construction& c) {
  c.model.axes = axes_with_z(normal);
  const PlaneTurn turn(c.model.axes, c.model.length, c.markers.start);
  turn_markers(turn, c);
  turn_bodies(turn, c);
  turn_forces(turn, c);
  for (BodyStart& start : c.starts) {
    if (start.velocity) turn(*start.velocity);
    if (start.angular_velocity) turn(*start.angular_velocity);
  }
  for (int i = 0; i < std::ssize(c.markers.start); ++i) turn(c.markers.start[i], i);
  return turn.own();
}

}  // namespace tisserand::mechanism
