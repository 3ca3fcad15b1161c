// SPDX-License-Identifier: GPL-3.0-or-later
// Correspondence of bodies by name, and of places of one model with nodes of the other.
#include "mechanism/switching/transfer.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include <Eigen/Cholesky>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/switching/modal_compliance.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

NodeMotion motion_of_marker(const Marker& marker, const NodeMotion& node) {
  return {marker_position(marker, node),
          marker_rotation(marker, node),
          marker_velocity(marker, node),
          marker.R.transpose() * node.Omega,
          node.xdd + node.R * (node.Omegad.cross(marker.p) + node.Omega.cross(node.Omega.cross(marker.p))),
          marker.R.transpose() * node.Omegad};
}

/// Motion of the centre of mass with the momenta of the body: (Φᵀ M̄ Φ) V = Φᵀ M̄ ẏ in axes of the floating frame, V =
/// [ẋ₀; Ω₀].
NodeMotion rigid_motion(const SuperelementBody& body, const SuperelementScratch& scratch) {
  const LocalMotion<double>& motion = scratch.motion;
  const Eigen::MatrixXd rigid = rigid_columns(body);
  const Eigen::Index nb = body.boundary_size, m = body.modes;
  Eigen::MatrixXd M(nb + m, nb + m);
  M << body.M_BB, body.M_BI, body.M_IB, Eigen::MatrixXd::Identity(m, m);
  Eigen::VectorXd rate(nb + m);
  rate << motion.rate_B, motion.rate_I;
  const Eigen::Matrix<double, 6, 1> V = (rigid.transpose() * M * rigid).ldlt().solve(rigid.transpose() * (M * rate));
  const Vector3d center = deformed_center_of_mass<double>(body, motion);
  NodeMotion result;
  result.R = motion.R0;
  result.x = motion.x0 + motion.R0 * center;
  result.Omega = V.tail<3>();
  result.xd = motion.R0 * (V.head<3>() + result.Omega.cross(body.center_of_mass));
  return result;
}

/// Linear momentum, and angular momentum about the centre of mass, of an evaluated modal body by the mass matrix [GA00]
/// (8), (16); world axes.
struct CentralMomenta {
  Vector3d center, linear, angular;
};

/// Momenta from the `velocity` of the frame in its axes: p = m v + Ω × c + ċ; about the frame c × v + J Ω + N ẇ.
CentralMomenta central_momenta(const ModalBody& body, const ModalScratch& s, const Vector3d& x,
                               const Vector3d& velocity) {
  const Vector3d center = s.c / body.mass, p = body.mass * velocity + s.om.cross(s.c) + s.cd;
  const Vector3d h = s.c.cross(velocity) + s.J * s.om + s.N * s.wd - center.cross(p);
  return {x + s.A * center, s.A * p, s.A * h};
}

/// Angular velocity, in axes of the frame, at which a body has this angular momentum about its centre of mass.
Vector3d spin_of(const ModalBody& body, const ModalScratch& s, const Vector3d& angular) {
  const Matrix3d lever = skew<double>(s.c), J = s.J + lever * lever / body.mass;
  const Vector3d h = s.A.transpose() * angular - s.N * s.wd + s.c.cross(s.cd) / body.mass;
  return body.planar ? Vector3d(0.0, 0.0, h.z() / J(2, 2)) : Vector3d(J.completeOrthogonalDecomposition().solve(h));
}

/// Mean rotation of the mass by the modes from `first` on.
Vector3d mean_turn(const ModalBody& body, Eigen::Index first, const Eigen::VectorXd& w) {
  if (body.planar) return Vector3d::Zero();
  Eigen::VectorXd gone = w;
  gone.head(first).setZero();
  return rigid_part(body).part.bottomRows<3>() * gone;
}

}  // namespace

StateTransfer::StateTransfer(const Model& from, const Model& to) : from_(from), to_(to) {
  const auto index_of = [](const auto& pool, const std::string& name, auto member) {
    const auto found = std::ranges::find(pool, name, member);
    return found == pool.end() ? -1 : static_cast<int>(std::distance(pool.begin(), found));
  };
  for (int i = 0; i < std::ssize(to.nodes); ++i) sources_.push_back(source_of(i));
  for (const SuperelementUse& use : to.superelements) {
    superelements_.push_back(index_of(from.superelements, use.name, &SuperelementUse::name));
    const int rigid = index_of(from.rigid_bodies, use.name, &RigidBody::name);
    frames_.push_back(rigid < 0 ? -1 : from.rigid_bodies[rigid].node);
  }
  for (const ModalBody& body : to.modal_bodies)
    modal_bodies_.push_back(index_of(from.modal_bodies, body.name, &ModalBody::name));
  turns_.assign(to.sizes.hinges, -1);
  for (const Coordinate& coordinate : to.coordinates) {
    const int own = index_of(from.coordinates, coordinate.name, &Coordinate::name);
    if (coordinate.turn >= 0 && own >= 0) turns_[coordinate.turn] = from.coordinates[own].turn;
  }
}

/// Source of a node: the node of that name, a superelement that becomes rigid, or a place on a rigid body.
StateTransfer::Source StateTransfer::source_of(int node) const {
  const std::string& name = to_.nodes[node].name;
  for (int i = 0; i < std::ssize(from_.nodes); ++i)
    if (from_.nodes[i].name == name) return {i, std::nullopt, -1};
  for (int i = 0; i < std::ssize(from_.superelements); ++i)
    if (from_.superelements[i].name == name) return {-1, std::nullopt, i};
  for (const Place& place : from_.places)
    if (place.name == name) return {-1, place.marker, -1};
  throw Error(fmt::format("node '{}' does not exist with this effect switched", name), "",
              "choose other effects with --effect");
}

void StateTransfer::set_node(int index, const State& state, const Evaluation& now, State& result) const {
  const Node& node = to_.nodes[index];
  const Source& source = sources_[index];
  NodeMotion motion;
  if (source.superelement >= 0)
    motion = rigid_motion(body_of(from_, source.superelement), now.superelements[source.superelement]);
  else if (source.marker)
    motion = motion_of_marker(*source.marker, motion_of(now, source.marker->node));
  else
    motion = motion_of(now, source.node);
  result.x().col(index) = source.node >= 0 ? Vector3d(state.x().col(source.node)) : motion.x;
  const int carrier = source.marker ? source.marker->node : source.node;
  const bool same_axes = source.superelement < 0 && (!source.marker || source.marker->R.isIdentity(0.0));
  result.Q().col(index) =
      same_axes ? Eigen::Vector4d(state.Q().col(carrier)) : wxyz(Eigen::Quaterniond(motion.R).normalized());
  if (node.translation >= 0) {
    set_translation(to_, motion.xd, node.translation, result.v());
    set_translation(to_, motion.xdd, node.translation, result.vdot());
  }
  if (node.rotation >= 0) {
    set_rotation(to_, motion.Omega, node.rotation, result.v());
    set_rotation(to_, motion.Omegad, node.rotation, result.vdot());
  }
}

void StateTransfer::set_superelements(const State& state, State& result) const {
  for (std::size_t i = 0; i < to_.superelements.size(); ++i) {
    const int own = superelements_[i], at = to_.internal_offset[i], first = to_.sizes.boundary + at;
    const int modes = body_of(to_, i).modes;
    result.y().segment(at, modes).setZero();
    result.v().segment(first, modes).setZero();
    result.vdot().segment(first, modes).setZero();
    if (own < 0) {  // was rigid: its frame has the axes of the body
      if (frames_[i] >= 0) result.frames().col(i) = state.Q().col(frames_[i]);
      continue;
    }
    const int there = from_.internal_offset[own], both = std::min(modes, body_of(from_, own).modes);
    result.frames().col(i) = state.frames().col(own);
    result.y().segment(at, both) = state.y().segment(there, both);
    result.v().segment(first, both) = state.v().segment(from_.sizes.boundary + there, both);
    result.vdot().segment(first, both) = state.vdot().segment(from_.sizes.boundary + there, both);
  }
}

void StateTransfer::set_modal_bodies(const State& state, const Evaluation& now, State& result) const {
  for (std::size_t i = 0; i < to_.modal_bodies.size(); ++i) {
    const ModalBody& body = to_.modal_bodies[i];
    const int at = to_.sizes.first_modal() + body.offset;
    result.w().segment(body.offset, body.modes).setZero();
    result.v().segment(at, body.modes).setZero();
    result.vdot().segment(at, body.modes).setZero();
    if (modal_bodies_[i] < 0) continue;
    const ModalBody& own = from_.modal_bodies[modal_bodies_[i]];
    const int modes = std::min(body.modes, own.modes), there = from_.sizes.first_modal() + own.offset;
    result.w().segment(body.offset, modes) = state.w().segment(own.offset, modes);
    result.v().segment(at, modes) = state.v().segment(there, modes);
    result.vdot().segment(at, modes) = state.vdot().segment(there, modes);
    if (body.modes < own.modes) leave_modes_out(body, own, now.modal_bodies[modal_bodies_[i]], result);
  }
}

/// Sets the frame so that the mass keeps its mean pose, with the momenta of the removed modes.
void StateTransfer::leave_modes_out(const ModalBody& body, const ModalBody& own, const ModalScratch& scratch,
                                    State& result) const {
  const Node& node = to_.nodes[body.node];
  const Vector3d x = result.x().col(body.node), velocity = translation_at(to_, result.v(), node.translation);
  const CentralMomenta momenta = central_momenta(own, scratch, x, scratch.A.transpose() * velocity);
  NodeMotion frame;
  frame.R = scratch.A * exp_so3<double>(mean_turn(own, body.modes, scratch.w));
  const double* rates = result.v().data() + to_.sizes.first_modal() + body.offset;
  ModalScratch there = make_scratch(body);
  update_kinematics(body, frame, {result.w().data() + body.offset, rates, rates}, Vector3d::Zero(), there);
  result.x().col(body.node) = momenta.center - frame.R * there.c / body.mass;
  result.Q().col(body.node) = wxyz(Eigen::Quaterniond(frame.R).normalized());
  const Vector3d spin = spin_of(body, there, momenta.angular);
  set_translation(to_, (momenta.linear - frame.R * (spin.cross(there.c) + there.cd)) / body.mass, node.translation,
                  result.v());
  set_rotation(to_, spin, node.rotation, result.v());
}

void StateTransfer::set_treads(const State& state, State& result) const {
  for (std::size_t i = 0; i < to_.tyres.size(); ++i) {
    if (!to_.tyres[i].relaxes()) continue;
    const int lag = to_.tyres[i].lag, own = from_.tyres[i].lag;
    const int at = to_.sizes.first_modal() + lag, there = from_.sizes.first_modal() + own;
    result.w().segment<2>(lag) = state.w().segment<2>(own);
    result.v().segment<2>(at) = state.v().segment<2>(there);
    result.vdot().segment<2>(at) = state.vdot().segment<2>(there);
  }
}

void StateTransfer::set_hinges(const State& state, State& result) const {
  for (std::size_t turn = 0; turn < turns_.size(); ++turn)
    if (turns_[turn] >= 0) result.hinges()[turn] = state.hinges()[turns_[turn]];
}

void StateTransfer::apply(const State& state, const Evaluation& now, State& result) const {
  result.time() = state.time();
  result.load_time() = state.load_time();
  result.step() = state.step();
  result.work() = state.work();
  result.dissipated() = state.dissipated();
  result.initial_energy() = state.initial_energy();
  for (int k = 0; k < 3; ++k) result.force_scale(k) = state.force_scale(k);
  result.acceleration_scale() = state.acceleration_scale();
  result.load_power() = state.load_power();
  result.damping_power() = state.damping_power();
  for (int i = 0; i < std::ssize(to_.nodes); ++i) set_node(i, state, now, result);
  set_superelements(state, result);
  set_modal_bodies(state, now, result);
  set_treads(state, result);
  set_hinges(state, result);
  result.algorithmic() = result.vdot();  // a step has those of its own model
  const bool same_constraints = from_.sizes.constraints == to_.sizes.constraints;
  result.lambda().setZero();
  result.active().setOnes();
  if (!same_constraints) return;
  result.lambda() = state.lambda();
  result.active() = state.active();
}

bool share_states(const Model& a, const Model& b) {
  const auto same_nodes = [&] { return std::ranges::equal(a.nodes, b.nodes, {}, &Node::name, &Node::name); };
  const auto same_sizes = [](const Sizes& s, const Sizes& t) {
    return s.nodes == t.nodes && s.boundary == t.boundary && s.modal == t.modal && s.internal == t.internal &&
           s.constraints == t.constraints && s.superelements == t.superelements && s.hinges == t.hinges;
  };
  return same_sizes(a.sizes, b.sizes) && same_nodes();
}

State transfer(const Model& from, const State& state, const Model& to) {
  Evaluation now(from);
  evaluate(from, state, now);
  update_modal_nodes(from, now);
  State result(to.sizes);
  StateTransfer(from, to).apply(state, now, result);
  result.work() = result.dissipated() = result.initial_energy() = 0.0;
  result.vdot().setZero();
  result.lambda().setZero();
  result.active().setOnes();
  return result;
}

}  // namespace tisserand::mechanism
