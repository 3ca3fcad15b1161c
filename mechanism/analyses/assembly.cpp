// SPDX-License-Identifier: GPL-3.0-or-later
// Levenberg-Marquardt over the rigid motions of bodies.
#include "mechanism/analyses/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "common/math/rotation.hpp"
#include "common/stable_sort.hpp"
#include "mechanism/equations/constraint_rows.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/terms.hpp"
#include "mechanism/model/connected_bodies.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// Largest rotation [rad], or displacement over length, of one step.
constexpr double largest_step = 0.5;
constexpr int most_iterations = 200;  ///< per fresh start
constexpr int most_fresh_starts = 4;

/// The bodies of a state, each with all its nodes, which move as rigid bodies.
struct RigidBodies {
  const Model& model;
  State& state;
  std::vector<int> of_node;
  std::vector<Vector3d> center;  ///< points about which bodies turn

  RigidBodies(const Model& moved, State& moving) : model(moved), state(moving) {
    const Parts parts = find_parts(model);
    of_node = parts.of_node;
    center.resize(static_cast<std::size_t>(parts.count()));
    find_centers();
  }

  void find_centers() {
    std::ranges::fill(center, Vector3d::Zero());
    std::vector<int> count(center.size(), 0);
    for (std::size_t i = 0; i < of_node.size(); ++i) {
      if (model.nodes[i].modal >= 0) continue;  // follows the frame of its body
      center[of_node[i]] += state.x().col(static_cast<Eigen::Index>(i));
      ++count[of_node[i]];
    }
    for (std::size_t k = 0; k < center.size(); ++k) center[k] /= count[k];
  }

  Eigen::Index motions() const { return 6 * static_cast<Eigen::Index>(center.size()); }

  /// Moves each body by [t/L; θ], its row in d, with finite rotations.
  void move(const VectorXd& d) {
    const auto turn_of = [&d](int body) {
      const Vector3d turn = d.segment<3>(6 * body + 3);
      return Eigen::Quaterniond(exp_so3<double>(turn));
    };
    const auto turn = [](const Eigen::Quaterniond& q, auto Q) { Q = wxyz((q * quaternion(Q)).normalized()); };
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const int body = of_node[i];
      const Eigen::Quaterniond q = turn_of(body);
      const auto column = static_cast<Eigen::Index>(i);
      const Vector3d arm = state.x().col(column) - center[body];
      state.x().col(column) = center[body] + model.length * d.segment<3>(6 * body) + q * arm;
      if (model.nodes[i].rotation >= 0) turn(q, state.Q().col(column));
    }
    for (std::size_t i = 0; i < model.superelements.size(); ++i)
      turn(turn_of(of_node[model.superelements[i].nodes.front()]), state.frames().col(static_cast<Eigen::Index>(i)));
    for (std::size_t k = 0; k < center.size(); ++k)
      center[k] += model.length * d.segment<3>(6 * static_cast<Eigen::Index>(k));
  }
};

double row_scale(const Model& model, int row) { return model.length_row[row] ? 1.0 / model.length : 1.0; }

/// A coordinate with a prescribed value or rate; these rows follow those of the constraints.
struct AskedRow {
  const CoordinateStart* entry;
  double target;
};
using AskedRows = std::vector<AskedRow>;

AskedRows asked_rows(const std::vector<CoordinateStart>& initial, std::optional<double> CoordinateStart::*target) {
  AskedRows rows;
  for (const CoordinateStart& entry : initial)
    if (entry.*target) rows.push_back({&entry, *(entry.*target)});
  return rows;
}

double row_scale(const Model& model, const AskedRow& row) {
  return is_length(model.coordinates[row.entry->coordinate].relation) ? 1.0 / model.length : 1.0;
}

/// Jacobian ∂(scaled Φ)/∂[t/L; θ] at the last evaluate().
Sparse jacobian(const AskedRows& asked, const RigidBodies& bodies, const Evaluation& evaluation) {
  const Model& model = bodies.model;
  std::vector<Eigen::Triplet<double>> entries;
  const int constraints = model.sizes.constraints;
  const auto add_side = [&](int row, int node, const Eigen::Matrix<double, 1, 6>& B) {
    if (node < 0) return;
    const double scale = row < constraints ? row_scale(model, row) : row_scale(model, asked[row - constraints]);
    const NodeMotion& motion = motion_of(evaluation, node);
    const int body = bodies.of_node[node];
    const Eigen::RowVector3d along = B.head<3>(), about = B.tail<3>();
    const Vector3d arm = motion.x - bodies.center[body];
    Eigen::RowVector3d turn = -along * skew<double>(arm);
    if (has_rotation(model, node)) turn += about * motion.R.transpose();
    for (int k = 0; k < 3; ++k) {
      entries.emplace_back(row, 6 * body + k, scale * model.length * along[k]);
      entries.emplace_back(row, 6 * body + 3 + k, scale * turn[k]);
    }
  };
  const auto add = [&](int row, const auto&, const auto& pair, const Row12& B) {
    add_side(row, pair.a.node, B.head<6>());
    add_side(row, pair.b.node, B.tail<6>());
  };
  for_each_row(model, evaluation, add);
  for (int i = 0; i < std::ssize(asked); ++i) {
    const int at = asked[i].entry->coordinate;
    add(constraints + i, nullptr, model.coordinates[at], evaluation.coordinates[at].G);
  }
  Sparse J(constraints + static_cast<Eigen::Index>(asked.size()), bodies.motions());
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

/// Damped Gauss-Newton step −(JᵀJ + μ)⁻¹ Jᵀ f.
VectorXd damped_step(const Sparse& J, const VectorXd& f, double mu) {
  Sparse A = J.transpose() * J;
  Sparse one(A.rows(), A.cols());
  one.setIdentity();
  A += mu * one;
  const Eigen::SimplicialLDLT<Sparse> factors(A);
  return -factors.solve(VectorXd(J.transpose() * f));
}

/// Evaluates the constraints and the prescribed coordinates.
void evaluate_rows(const Model& model, const AskedRows& asked, const State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  if (asked.empty()) return;
  update_modal_nodes(model, evaluation);
  evaluate_coordinates(model, state, evaluation);
}

/// Scaled vector of the constraint `rows` and the gaps of the prescribed coordinates.
VectorXd scaled_rows(const Model& model, const AskedRows& asked, const VectorXd& rows,
                     double CoordinateTerms::*quantity, const Evaluation& evaluation) {
  VectorXd f(rows.size() + static_cast<Eigen::Index>(asked.size()));
  for (int row = 0; row < rows.size(); ++row) f[row] = row_scale(model, row) * rows[row];
  for (std::size_t i = 0; i < asked.size(); ++i)
    f[rows.size() + static_cast<Eigen::Index>(i)] =
        row_scale(model, asked[i]) * (evaluation.coordinates[asked[i].entry->coordinate].*quantity - asked[i].target);
  return f;
}

/// Scaled Φ at the state, followed by the gaps of the prescribed coordinates.
VectorXd gaps(const Model& model, const AskedRows& asked, State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  unwrap_hinges(model, evaluation, state);
  if (!asked.empty()) evaluate_rows(model, asked, state, evaluation);
  return scaled_rows(model, asked, evaluation.constraint, &CoordinateTerms::value, evaluation);
}

double largest(const VectorXd& f) { return f.size() > 0 ? f.cwiseAbs().maxCoeff() : 0.0; }

/// Makes damped steps until the gaps are closed to round-off, or no step reduces them.
void close_gaps(const AskedRows& asked, const std::function<bool()>& interrupted, RigidBodies& bodies,
                Evaluation& evaluation, AssemblyReport& report) {
  const Model& model = bodies.model;
  State& state = bodies.state;
  VectorXd f = gaps(model, asked, state, evaluation);
  double mu = 1e-3;
  while (largest(f) > 1e-15 && report.iterations < most_iterations) {
    report.interrupted = interrupted && interrupted();
    if (report.interrupted) return;
    ++report.iterations;
    const Sparse J = jacobian(asked, bodies, evaluation);
    VectorXd d = damped_step(J, f, mu);
    if (!d.allFinite()) return;
    const double size = d.cwiseAbs().maxCoeff();
    if (size > largest_step) d *= largest_step / size;
    const State before = state;
    const std::vector<Vector3d> center = bodies.center;
    bodies.move(d);
    const VectorXd next = gaps(model, asked, state, evaluation);
    if (next.norm() < f.norm()) {
      const bool slow = next.norm() > (1.0 - 1e-6) * f.norm() && mu < 1e-9;
      f = next;
      mu = std::max(0.1 * mu, 1e-14);
      if (slow) return;
      continue;
    }
    state = before;
    bodies.center = center;
    evaluate_rows(model, asked, state, evaluation);
    mu *= 10.0;
    if (mu > 1e6 || largest(f) < 1e-13) return;
  }
}

/// Turns over a body whose axis is opposite to that of its joint; true if there was one.
bool turn_over(RigidBodies& bodies, Evaluation& evaluation) {
  evaluate(bodies.model, bodies.state, evaluation);
  for (const Joint& joint : bodies.model.joints) {
    const NodeMotion &a = motion_of(evaluation, joint.a.node), &b = motion_of(evaluation, joint.b.node);
    const Matrix3d R_WA = marker_rotation(joint.a, a), R_WB = marker_rotation(joint.b, b);
    const Matrix3d R_AB = R_WA.transpose() * R_WB;
    const int axis = aligned_axis(joint);
    Vector3d turn = Vector3d::Zero();
    if (axis >= 0 && R_AB(axis, axis) <= 0.0) turn = std::numbers::pi * R_WA.col((axis + 1) % 3);
    if (keeps_orientation(joint) && R_AB.diagonal().minCoeff() <= 0.0) turn = -(R_WA * log_so3<double>(R_AB));
    if (turn.isZero(0.0)) continue;
    const bool moves_b = joint.b.node >= 0;
    const Marker& marker = moves_b ? joint.b : joint.a;
    const int body = bodies.of_node[marker.node];
    VectorXd d = VectorXd::Zero(bodies.motions());
    const Vector3d theta = moves_b ? turn : Vector3d(-turn);
    const Vector3d arm = marker_position(marker, moves_b ? b : a) - bodies.center[body];
    d.segment<3>(6 * body + 3) = theta;
    d.segment<3>(6 * body) = (arm - exp_so3<double>(theta) * arm) / bodies.model.length;
    bodies.move(d);
    return true;
  }
  return false;
}

/// Turns all bodies by small random angles, which are the same in every run.
void disturb(int attempt, RigidBodies& bodies) {
  std::mt19937 random(static_cast<unsigned>(attempt + 1));
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  VectorXd d = VectorXd::Zero(bodies.motions());
  for (Eigen::Index k = 0; k < d.size(); ++k)
    if (k % 6 >= (bodies.model.planar ? 5 : 3)) d[k] = uniform(random);
  bodies.move(d);
}

/// Whether a joint keeps a distance of markers that coincide: the direction of their separation is then round-off.
bool is_folded(const Model& model, const State& state, Evaluation& evaluation) {
  constexpr double same_place = 1e-9;  // of the characteristic length
  evaluate(model, state, evaluation);
  return std::ranges::any_of(model.joints, [&](const Joint& joint) {
    return keeps_distance(joint) && (marker_position(joint.b, markers_of(joint, evaluation).node_b) -
                                     marker_position(joint.a, markers_of(joint, evaluation).node_a))
                                            .norm() < same_place * model.length;
  });
}

/// Rigid motion [ẋ_c/L; ω] of each body that fits the velocities of its nodes.
VectorXd rigid_velocities(const RigidBodies& bodies) {
  const Model& model = bodies.model;
  const State& state = bodies.state;
  VectorXd w = VectorXd::Zero(bodies.motions());
  std::vector<bool> turning(bodies.center.size(), false), moving(bodies.center.size(), false);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const auto body = static_cast<std::size_t>(bodies.of_node[i]);
    if (model.nodes[i].rotation < 0 || turning[body]) continue;
    const Vector3d Omega = rotation_at(model, state.v(), model.nodes[i].rotation);
    w.segment<3>(6 * static_cast<Eigen::Index>(body) + 3) = quaternion(state.Q().col(i)) * Omega;
    turning[body] = true;
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const auto body = static_cast<std::size_t>(bodies.of_node[i]);
    if (model.nodes[i].translation < 0 || moving[body]) continue;
    const auto at = 6 * static_cast<Eigen::Index>(body);
    const Vector3d arm = state.x().col(i) - bodies.center[body], omega = w.segment<3>(at + 3);
    const Vector3d velocity = translation_at(model, state.v(), model.nodes[i].translation);
    w.segment<3>(at) = (velocity - omega.cross(arm)) / model.length;
    moving[body] = true;
  }
  return w;
}

void set_rigid_velocities(const VectorXd& w, RigidBodies& bodies) {
  const Model& model = bodies.model;
  State& state = bodies.state;
  state.v().setZero();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Eigen::Index at = 6 * bodies.of_node[i];
    const auto column = static_cast<Eigen::Index>(i);
    const Vector3d omega = w.segment<3>(at + 3);
    const Vector3d arm = state.x().col(column) - bodies.center[bodies.of_node[i]];
    if (model.nodes[i].translation >= 0)
      set_translation(model, model.length * w.segment<3>(at) + omega.cross(arm), model.nodes[i].translation, state.v());
    if (model.nodes[i].rotation >= 0)
      set_rotation(model, quaternion(state.Q().col(column)).conjugate() * omega, model.nodes[i].rotation, state.v());
  }
}

/// Makes the smallest change of w with B v = −Φ_t, in repeated damped steps, each of which leaves μ/(σ² + μ) of the
/// error. Returns the largest gap relative to the largest velocity.
double close_velocities(const AskedRows& asked, VectorXd w, RigidBodies& bodies, Evaluation& evaluation) {
  double gap = 0.0;
  for (int pass = 0; pass < 20; ++pass) {
    set_rigid_velocities(w, bodies);
    evaluate_rows(bodies.model, asked, bodies.state, evaluation);
    const VectorXd rate =
        scaled_rows(bodies.model, asked, evaluation.constraint_rate, &CoordinateTerms::rate, evaluation);
    const double size = std::max(largest(w), largest(rate));
    gap = size > 0.0 ? largest(rate) / size : 0.0;
    if (gap < 1e-14) break;
    w += damped_step(jacobian(asked, bodies, evaluation), rate, 1e-9);
  }
  return gap;
}

std::vector<JointGap> open_joints(const Model& model, const AskedRows& asked, const Evaluation& evaluation,
                                  double tolerance) {
  std::vector<JointGap> open;
  const auto look = [&](const std::string& name, int first, int size) {
    JointGap gap{name, 0.0, 0.0};
    for (int row = first; row < first + size; ++row) {
      double& value = model.length_row[row] ? gap.length : gap.angle;
      value = std::max(value, std::abs(evaluation.constraint[row]));
    }
    if (std::max(gap.length / model.length, gap.angle) > tolerance) open.push_back(gap);
  };
  for (const Joint& joint : model.joints) look(joint.name, joint.row, joint.size());
  for (const Coupling& coupling : model.couplings) look(coupling.name, coupling.row, 1);
  for (const AskedRow& row : asked) {
    const double gap = std::abs(evaluation.coordinates[row.entry->coordinate].value - row.target);
    const bool length = is_length(model.coordinates[row.entry->coordinate].relation);
    if (gap * row_scale(model, row) > tolerance)
      open.push_back({"initial " + row.entry->name, length ? gap : 0.0, length ? 0.0 : gap});
  }
  sort_stably(open, std::greater<>(),
              [&](const JointGap& gap) { return std::max(gap.length / model.length, gap.angle); });
  return open;
}

std::string vector_text(const Eigen::Ref<const VectorXd>& v) {
  std::string text;
  for (Eigen::Index k = 0; k < v.size(); ++k) text += fmt::format("{}{:.12g}", k == 0 ? "" : ", ", v[k]);
  return "[" + text + "]";
}

}  // namespace

AssemblyReport assemble(const Model& model, const AssemblyOptions& options, State& state, Evaluation& evaluation) {
  const AskedRows values = asked_rows(options.initial, &CoordinateStart::value);
  const AskedRows rates = asked_rows(options.initial, &CoordinateStart::rate);
  AssemblyReport report;
  RigidBodies bodies(model, state);
  const VectorXd given = rigid_velocities(bodies);
  state.v().setZero();
  state.vdot().setZero();
  state.lambda().setZero();
  if (is_folded(model, state, evaluation)) disturb(most_fresh_starts, bodies);
  State best = state;
  double best_gap = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < most_fresh_starts && !report.interrupted; ++attempt) {
    AssemblyReport round;
    for (std::size_t turned = 0; turned <= model.joints.size(); ++turned) {
      close_gaps(values, options.interrupted, bodies, evaluation, round);
      if (round.interrupted || !turn_over(bodies, evaluation)) break;
    }
    report.iterations += round.iterations;
    report.interrupted = round.interrupted;
    const double gap = largest(gaps(model, values, state, evaluation));
    if (gap < best_gap) {
      best_gap = gap;
      best = state;
    }
    if (best_gap <= options.tolerance) break;
    disturb(attempt, bodies);
  }
  state = best;
  bodies.find_centers();
  report.velocity_gap = close_velocities(rates, given, bodies, evaluation);
  evaluate_rows(model, values, state, evaluation);
  report.gap = best_gap;
  report.closed = best_gap <= options.tolerance;
  report.open = open_joints(model, values, evaluation, options.tolerance);
  return report;
}

std::vector<std::string> body_poses(const formats::Scene& scene, const Model& model, const State& at_start,
                                    const State& state) {
  std::vector<std::string> lines;
  for (const formats::BodySpec& body : scene.bodies) {
    const auto& [name, start] = std::visit(
        [](const auto& spec) {
          return std::pair<const std::string&, const formats::InitialMotion&>(spec.name, spec.start);
        },
        body);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const Node& node = model.nodes[i];
      if ((node.name != name && !node.name.starts_with(name + "/")) || node.rotation < 0) continue;
      const auto column = static_cast<Eigen::Index>(i);
      const Eigen::Quaterniond q = quaternion(state.Q().col(column));
      const Eigen::Quaterniond axes(to_world(model, Eigen::Matrix3d(Eigen::Matrix3d::Identity())));
      const Eigen::Quaterniond turn = axes * q * quaternion(at_start.Q().col(column)).conjugate() * axes.conjugate();
      const Eigen::Quaterniond orientation = (turn * start.pose.orientation).normalized();
      const Vector3d position = to_world(model, Vector3d(state.x().col(column))),
                     arm = turn *
                           (to_world(model, Vector3d(at_start.x().col(column))) - (start.pose.position - model.origin)),
                     omega = to_world(model, q * rotation_at(model, state.v(), node.rotation));
      std::string line = fmt::format("{}: {{pose: {{position: {}, orientation: {}}}", name,
                                     vector_text(model.origin + position - arm), vector_text(wxyz(orientation)));
      const Vector3d velocity =
          node.translation < 0 ? Vector3d(Vector3d::Zero())
                               : to_world(model, translation_at(model, state.v(), node.translation)) - omega.cross(arm);
      if (!velocity.isZero(0.0)) line += fmt::format(", velocity: {}", vector_text(velocity));
      if (!omega.isZero(0.0)) line += fmt::format(", angular_velocity: {}", vector_text(omega));
      lines.push_back(line + "}");
      break;
    }
  }
  return lines;
}

}  // namespace tisserand::mechanism
