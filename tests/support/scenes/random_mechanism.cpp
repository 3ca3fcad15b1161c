// SPDX-License-Identifier: GPL-3.0-or-later
// Trees first, then loops; poses by the free displacements of the joints, velocities by projection on what they hold.
#include "tests/support/scenes/random_mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "formats/scene/scene.hpp"
#include "mechanism/run/output.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using Row6 = Eigen::Matrix<double, 1, 6>;

const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();

/// Numbers that are the same with every standard library: std::mt19937 is specified, distributions are not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  Vector3d vector(double size) {
    const double a = between(-size, size), b = between(-size, size);
    return {a, b, between(-size, size)};
  }
  Matrix3d rotation() {
    const Vector3d axis = vector(1.0) + 1e-3 * x;
    return AngleAxisd(between(-3.0, 3.0), axis.normalized()).toRotationMatrix();
  }
  Frame frame(double size) {
    const Vector3d p = vector(size);
    return {p, rotation()};
  }

 private:
  std::mt19937 engine_;
};

Matrix3d about(const Vector3d& axis, double angle) { return AngleAxisd(angle, axis).toRotationMatrix(); }

/// A displacement of B from A that the joint leaves free; of generic joints that hold y and rx.
Frame free_displacement(RandomJoint& joint, Random& random) {
  const double angle = random.between(-1.2, 1.2), other = random.between(-1.0, 1.0);
  const Vector3d t = random.vector(0.6);
  const Matrix3d any = random.rotation();
  joint.value = angle;
  switch (joint.kind) {
    case JointKind::fixed:
      return {};
    case JointKind::revolute:
      return {Vector3d::Zero(), about(z, angle)};
    case JointKind::spherical:
      return {Vector3d::Zero(), any};
    case JointKind::universal:
      return {Vector3d::Zero(), about(x, angle) * about(y, other)};
    case JointKind::constant_velocity:
      return {Vector3d::Zero(), about(Vector3d(std::cos(other), std::sin(other), 0.0), angle)};
    case JointKind::cylindrical:
      return {t.z() * z, about(z, angle)};
    case JointKind::screw:
      return {joint.pitch / (2.0 * std::numbers::pi) * angle * z, about(z, angle)};
    case JointKind::prismatic:
      joint.value = t.z();
      return {t.z() * z, Matrix3d::Identity()};
    case JointKind::planar:
      return {{t.x(), t.y(), 0.0}, about(z, angle)};
    case JointKind::point_on_line:
      return {t.z() * z, any};
    case JointKind::point_on_plane:
      return {{t.x(), t.y(), 0.0}, any};
    case JointKind::distance:
      return {t + 0.5 * x, any};
    case JointKind::constant_orientation:
      return {t, Matrix3d::Identity()};
    case JointKind::parallel_axes:
      return {t, about(z, angle)};
    case JointKind::generic:
      return {{t.x(), 0.0, t.z()}, about(y, other) * about(z, angle)};
  }
  return {};
}

/// Rows that are zero of the velocity [v; ω] of B relative to A, in axes of A, at the displacement `d`: written from
/// what SCENE.md says that a joint holds.
std::vector<Row6> held_rows(const RandomJoint& joint, const Frame& d) {
  std::vector<Row6> rows;
  const auto add = [&rows](const Vector3d& v, const Vector3d& omega) {
    rows.emplace_back();
    rows.back() << v.transpose(), omega.transpose();
  };
  const auto moves = [&](std::initializer_list<Vector3d> directions) {
    for (const Vector3d& e : directions) add(e, Vector3d::Zero());
  };
  const auto turns = [&](std::initializer_list<Vector3d> directions) {
    for (const Vector3d& e : directions) add(Vector3d::Zero(), e);
  };
  const auto normal = [&](int i, int j) {  // of axis i of A and axis j of B
    const Vector3d b = d.R.col(j);
    add(Vector3d::Zero(), b.cross(Vector3d::Unit(i)));
  };
  switch (joint.kind) {
    case JointKind::fixed:
      moves({x, y, z}), turns({x, y, z});
      break;
    case JointKind::revolute:
      moves({x, y, z}), turns({x, y});
      break;
    case JointKind::spherical:
      moves({x, y, z});
      break;
    case JointKind::universal:
      moves({x, y, z}), normal(0, 1);
      break;
    case JointKind::constant_velocity:
      moves({x, y, z}), turns({(z + d.R.col(2)).normalized()});
      break;
    case JointKind::cylindrical:
      moves({x, y}), turns({x, y});
      break;
    case JointKind::screw:
      moves({x, y}), turns({x, y}), add(z, -joint.pitch / (2.0 * std::numbers::pi) * z);
      break;
    case JointKind::prismatic:
      moves({x, y}), turns({x, y, z});
      break;
    case JointKind::planar:
      moves({z}), turns({x, y});
      break;
    case JointKind::point_on_line:
      moves({x, y});
      break;
    case JointKind::point_on_plane:
      moves({z});
      break;
    case JointKind::distance:
      moves({d.p.normalized()});
      break;
    case JointKind::constant_orientation:
      turns({x, y, z});
      break;
    case JointKind::parallel_axes:
      turns({x, y});
      break;
    case JointKind::generic:
      moves({y}), normal(1, 2);
      break;
  }
  return rows;
}

Frame pose_of(const RandomMechanism& m, int body) { return body < 0 ? Frame{} : m.bodies[body].pose; }

/// The row on the velocities [v ω] of all bodies that gives `held` times the relative velocity of the joint.
VectorXd row_of_bodies(const RandomMechanism& m, const RandomJoint& joint, const Row6& held) {
  VectorXd row = VectorXd::Zero(6 * static_cast<Eigen::Index>(m.bodies.size()));
  const Frame a = pose_of(m, joint.a) * joint.in_a, b = pose_of(m, joint.b) * joint.in_b;
  const Vector3d v = a.R * held.head<3>().transpose(), omega = a.R * held.tail<3>().transpose();
  // v of point b as a point of body B, minus that as a point of body A.
  const auto add = [&](int body, double sign) {
    if (body < 0) return;
    row.segment<3>(6 * body) += sign * v;
    row.segment<3>(6 * body + 3) += sign * ((b.p - m.bodies[body].pose.p).cross(v) + omega);
  };
  add(joint.b, 1.0);
  add(joint.a, -1.0);
  return row;
}

Row6 coordinate_row(const RandomJoint& joint) {
  Row6 row = Row6::Zero();
  row[joint.along ? 2 : 5] = 1.0;
  return row;
}

bool has_coordinate(JointKind kind) {
  return kind == JointKind::revolute || kind == JointKind::cylindrical || kind == JointKind::screw ||
         kind == JointKind::prismatic;
}

std::string coordinate_name(const RandomJoint& joint) {
  const bool single = joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic;
  return single ? joint.name : joint.name + (joint.along ? "/z" : "/angle");
}

/// All that is held, and gears; not drives, which take the rate that they find.
MatrixXd constraint_matrix(const RandomMechanism& m) {
  std::vector<VectorXd> rows;
  for (const RandomJoint& joint : m.joints) {
    const Frame d = (pose_of(m, joint.a) * joint.in_a).inverse() * (pose_of(m, joint.b) * joint.in_b);
    for (const Row6& held : held_rows(joint, d)) rows.push_back(row_of_bodies(m, joint, held));
  }
  for (const RandomGear& gear : m.gears) {
    const RandomJoint &first = m.joints[gear.first], &second = m.joints[gear.second];
    rows.emplace_back(row_of_bodies(m, second, coordinate_row(second)) -
                      gear.ratio * row_of_bodies(m, first, coordinate_row(first)));
  }
  MatrixXd J(static_cast<Eigen::Index>(rows.size()), 6 * static_cast<Eigen::Index>(m.bodies.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) J.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
  return J;
}

bool well_conditioned(const MatrixXd& J, Eigen::Index most_rows) {
  if (J.rows() == 0) return true;
  if (J.rows() > most_rows) return false;
  const VectorXd values = Eigen::JacobiSVD<MatrixXd>(J.rowwise().normalized()).singularValues();
  return values[J.rows() - 1] > 1e-2 * values[0];
}

RandomBody random_body(int i, Random& random) {
  RandomBody body;
  body.name = fmt::format("body_{}", i);
  body.mass = random.between(0.5, 3.0);
  body.center = random.vector(0.3);
  const Matrix3d axes = random.rotation();
  const double a = random.between(0.05, 0.2), b = random.between(0.05, 0.2), c = random.between(0.05, 0.2);
  body.inertia = axes * Vector3d(b + c, c + a, a + b).asDiagonal() * axes.transpose();
  return body;
}

RandomJoint random_joint(int number, const std::vector<JointKind>& kinds, Random& random) {
  RandomJoint joint;
  joint.name = fmt::format("joint_{}", number);
  joint.kind = kinds[random.below(static_cast<int>(kinds.size()))];
  joint.pitch = random.between(0.2, 1.0);
  joint.along = joint.kind == JointKind::prismatic;
  if (joint.kind == JointKind::generic) joint.hold = {false, true, false, true, false, false};
  return joint;
}

void add_springs(RandomMechanism& m, Random& random) {
  const int bodies = static_cast<int>(m.bodies.size());
  for (int i = 0; i < 1 + random.below(2); ++i) {
    RandomSpring spring;
    spring.name = fmt::format("spring_{}", i);
    spring.b = random.below(bodies);
    spring.a = random.below(bodies + 1) - 1;
    if (spring.a == spring.b) spring.a = -1;
    spring.at_a = random.vector(1.0) + 3.0 * x;
    spring.at_b = random.vector(0.5);
    spring.stiffness = random.between(5.0, 50.0);
    spring.damping = random.between(0.5, 5.0);
    spring.free = random.between(0.5, 2.0);
    m.springs.push_back(spring);
  }
}

/// A gear between two joints of the tree and a drive of a third, as far as there are any.
void add_gears_and_drives(RandomMechanism& m, Random& random) {
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(m.joints.size()); ++i)
    if (!m.joints[i].closes_loop && has_coordinate(m.joints[i].kind)) free.push_back(i);
  if (free.size() >= 2 && random.below(2) == 0) {
    m.gears.push_back({"gear", free[0], free[1], random.between(-3.0, 3.0)});
    free.erase(free.begin(), free.begin() + 2);
  }
  if (!free.empty() && random.below(2) == 0) m.drives.push_back({"drive", free[0], random.between(-3.0, 3.0)});
}

void set_velocities(RandomMechanism& m, Random& random) {
  const MatrixXd J = constraint_matrix(m);
  VectorXd v(J.cols());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = random.between(-1.0, 1.0);
  // Twice: the second projection takes out the round-off of the first.
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition(J);
  for (int i = 0; i < 2 && J.rows() > 0; ++i) v -= decomposition.solve(J * v);
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    m.bodies[i].velocity = v.segment<3>(6 * static_cast<Eigen::Index>(i));
    m.bodies[i].omega = v.segment<3>(6 * static_cast<Eigen::Index>(i) + 3);
  }
  for (RandomJoint& joint : m.joints) joint.rate = row_of_bodies(m, joint, coordinate_row(joint)).dot(v);
}

RandomMechanism draw(Random& random, const std::vector<JointKind>& kinds, const std::vector<JointKind>& closing) {
  RandomMechanism m;
  m.gravity = random.vector(9.0);
  const int bodies = 2 + random.below(5);
  for (int i = 0; i < bodies; ++i) {
    RandomBody body = random_body(i, random);
    RandomJoint joint = random_joint(i, kinds, random);
    joint.a = random.below(i + 1) - 1;
    joint.b = i;
    joint.in_a = random.frame(0.7);
    joint.in_b = random.frame(0.7);
    body.pose = pose_of(m, joint.a) * joint.in_a * free_displacement(joint, random) * joint.in_b.inverse();
    m.bodies.push_back(body);
    m.joints.push_back(joint);
  }
  for (int i = 0; !closing.empty() && i < random.below(3); ++i) {
    RandomJoint joint = random_joint(bodies + i, closing, random);
    joint.b = random.below(bodies);
    joint.a = random.below(bodies + 1) - 1;
    if (joint.a == joint.b) joint.a = -1;
    joint.closes_loop = true;
    joint.in_a = random.frame(0.7);
    joint.in_b = pose_of(m, joint.b).inverse() * (pose_of(m, joint.a) * joint.in_a * free_displacement(joint, random));
    m.joints.push_back(joint);
  }
  add_springs(m, random);
  add_gears_and_drives(m, random);
  return m;
}

/// With drives as rows: they too must be independent.
bool is_sound(const RandomMechanism& m) {
  MatrixXd J = constraint_matrix(m);
  J.conservativeResize(J.rows() + static_cast<Eigen::Index>(m.drives.size()), J.cols());
  for (std::size_t i = 0; i < m.drives.size(); ++i) {
    const RandomJoint& joint = m.joints[m.drives[i].joint];
    J.row(J.rows() - 1 - static_cast<Eigen::Index>(i)) = row_of_bodies(m, joint, coordinate_row(joint)).transpose();
  }
  return well_conditioned(J, J.cols() - 1);
}

formats::MarkerSpec marker(const RandomMechanism& m, int body, const Frame& frame) {
  formats::MarkerSpec spec;
  spec.node = body < 0 ? "ground" : m.bodies[body].name;
  spec.position = frame.p;
  spec.orientation = Eigen::Quaterniond(frame.R);
  return spec;
}

template <class Vectors>
double largest_norm(const Vectors& vectors) {
  double largest = 0.0;
  for (const auto& v : vectors) largest = std::max(largest, v.norm());
  return largest;
}

/// max |a - b| / max |a| of two lists of vectors.
double relative(const std::vector<VectorXd>& a, const std::vector<VectorXd>& b) {
  if (a.size() != b.size()) throw std::logic_error("lists of different mechanisms");
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) difference = std::max(difference, (a[i] - b[i]).norm());
  return a.empty() ? 0.0 : difference / std::max(1e-300, largest_norm(a));
}

}  // namespace

RandomMechanism random_mechanism(unsigned seed, const std::vector<JointKind>& kinds,
                                 const std::vector<JointKind>& closing) {
  Random random(seed);
  for (int attempt = 0; attempt < 1000; ++attempt) {
    RandomMechanism m = draw(random, kinds, closing);
    if (!is_sound(m)) continue;
    set_velocities(m, random);
    return m;
  }
  throw std::runtime_error(fmt::format("seed {} gives no mechanism of independent constraints", seed));
}

std::string word_of(const RandomJoint& joint) { return formats::joint_word(joint.kind); }

formats::Scene scene_of(const RandomMechanism& m) {
  formats::Scene scene = empty_scene(1.0, 1.0);  // motions are differentiated a quarter of the step apart
  scene.units = m.units;
  scene.gravity = m.gravity;
  for (const RandomBody& body : m.bodies) {
    formats::RigidBodySpec spec = rigid_body(body.name, body.mass, body.center, Vector3d::Ones());
    spec.inertia = body.inertia;
    spec.start.pose = {body.pose.p, Eigen::Quaterniond(body.pose.R)};
    spec.start.velocity = body.velocity;
    spec.start.angular_velocity = body.omega;
    scene.bodies.push_back(spec);
  }
  for (const RandomJoint& joint : m.joints) {
    formats::JointSpec spec;
    spec.name = joint.name;
    spec.kind = joint.kind;
    spec.a = marker(m, joint.a, joint.in_a);
    spec.b = marker(m, joint.b, joint.in_b);
    spec.pitch = joint.pitch;
    spec.hold = joint.hold;
    scene.joints.push_back(spec);
  }
  for (const RandomSpring& spring : m.springs) {
    formats::SpringSpec spec;
    spec.name = spring.name;
    spec.a = marker(m, spring.a, {spring.at_a, Matrix3d::Identity()});
    spec.b = marker(m, spring.b, {spring.at_b, Matrix3d::Identity()});
    spec.stiffness = spring.stiffness;
    spec.damping = spring.damping;
    spec.free = spring.free;
    scene.springs.push_back(spec);
  }
  for (const RandomGear& gear : m.gears) {
    formats::GearSpec spec;
    spec.name = gear.name;
    spec.first.name = coordinate_name(m.joints[gear.first]);
    spec.second.name = coordinate_name(m.joints[gear.second]);
    spec.ratio = gear.ratio;
    scene.gears.push_back(spec);
  }
  for (const RandomDrive& drive : m.drives) {
    const RandomJoint& joint = m.joints[drive.joint];
    formats::MotionSpec spec;
    spec.name = drive.name;
    spec.coordinate.name = coordinate_name(joint);
    spec.value = formats::TimeExpression{
        fmt::format("({:.17g}) + ({:.17g})*t + ({:.17g})*t*t", joint.value, joint.rate, 0.5 * drive.acceleration),
        {},
        ""};
    scene.motions.push_back(spec);
  }
  return scene;
}

StartOfMotion start_of_motion(const RandomMechanism& m) {
  Simulation run(scene_of(m), {});
  run.start();
  const formats::ResultsLayout layout = mechanism::results_layout(run.model(), run.scene);
  formats::ResultsRow row;
  row.resize(layout);
  mechanism::fill_row(run.model(), run.state(), run.workspace.now, row);
  StartOfMotion start;
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    start.bodies.push_back({row.node_acceleration.col(k), row.node_angular_acceleration.col(k)});
  }
  for (std::size_t i = 0; i < m.joints.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Matrix3d R = pose_of(m, m.joints[i].a).R * m.joints[i].in_a.R;
    start.joints.push_back({R * row.joint_force.col(k), R * row.joint_moment.col(k)});
  }
  for (std::size_t i = 0; i < m.springs.size(); ++i) start.springs.push_back(row.spring_force[i]);
  for (std::size_t i = 0; i < m.gears.size(); ++i)
    start.gears.push_back({row.coupling_first_force[i], row.coupling_second_force[i]});
  for (std::size_t i = 0; i < m.drives.size(); ++i) start.drives.push_back(row.motion_force[i]);
  return start;
}

Differences compare(const StartOfMotion& a, const StartOfMotion& b) {
  const auto lists = [](const StartOfMotion& start) {
    std::array<std::vector<VectorXd>, 3> all;
    for (const Motion& body : start.bodies) {
      all[0].emplace_back(body.acceleration);
      all[0].emplace_back(body.angular_acceleration);
    }
    for (const Wrench& wrench : start.joints) {
      all[1].emplace_back(wrench.force);
      all[1].emplace_back(wrench.moment);
    }
    const auto add = [&](double value) { all[2].emplace_back(VectorXd::Constant(1, value)); };
    for (const double value : start.springs) add(value);
    for (const auto& gear : start.gears) add(gear[0]), add(gear[1]);
    for (const double value : start.drives) add(value);
    return all;
  };
  const auto first = lists(a), second = lists(b);
  return {relative(first[0], second[0]), relative(first[1], second[1]), relative(first[2], second[2])};
}

}  // namespace tisserand::test_support
