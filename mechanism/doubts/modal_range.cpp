// SPDX-License-Identifier: GPL-3.0-or-later
// Range of a modal body from its modes, and its axial force from the forces on its nodes.
#include "mechanism/doubts/modal_range.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Largest distance of nodes on a line from the line through the ends, over the length.
constexpr double straight = 1e-3;

}  // namespace

ModalRange::ModalRange(const Model& model, int body) : body_(body), attached_(model.nodes.size(), false) {
  for (int k = 0; k < std::ssize(model.modal_nodes); ++k)
    if (model.modal_nodes[k].body == body) nodes_.push_back(k);
  Vector3d end = Vector3d::Zero();
  for (const int a : nodes_)
    for (const int b : nodes_)
      if (const double span = (model.modal_nodes[b].x - model.modal_nodes[a].x).norm(); a < b && span > span_) {
        span_ = span;
        start_ = model.modal_nodes[a].x;
        end = model.modal_nodes[b].x;
      }
  for (const Joint& joint : model.joints)
    for (const int node : {joint.a.node, joint.b.node})
      if (node >= 0) attached_[node] = true;
  if (span_ == 0.0 || model.modal_bodies[body].modes == 0) return;
  axis_ = (end - start_) / span_;
  lag_ = std::numbers::pi / std::sqrt(model.modal_bodies[body].stiffness.minCoeff());
  const auto beside = [&](int k) { return (model.modal_nodes[k].x - start_).cross(axis_).norm() > straight * span_; };
  if (std::ranges::any_of(nodes_, beside)) return;
  set_buckling(model);
  find_forces(model);
}

void ModalRange::set_buckling(const Model& model) {
  const auto place = [&](int k) { return (model.modal_nodes[k].x - start_).dot(axis_); };
  std::ranges::sort(nodes_, {}, place);
  const Matrix3d across = Matrix3d::Identity() - axis_ * axis_.transpose();
  const Eigen::Matrix3Xd chord = (model.modal_nodes[nodes_.back()].Xd - model.modal_nodes[nodes_.front()].Xd) / span_;
  const VectorXd root = model.modal_bodies[body_].stiffness.cwiseSqrt();
  MatrixXd G = MatrixXd::Zero(root.size(), root.size());
  for (std::size_t k = 1; k < nodes_.size(); ++k) {
    const double length = place(nodes_[k]) - place(nodes_[k - 1]);
    if (!(length > 0.0)) continue;
    const Eigen::Matrix3Xd slope =
        across * ((model.modal_nodes[nodes_[k]].Xd - model.modal_nodes[nodes_[k - 1]].Xd) / length - chord);
    G += length * slope.transpose() * slope;
  }
  G = root.cwiseInverse().asDiagonal() * G * root.cwiseInverse().asDiagonal();
  const double softest = Eigen::SelfAdjointEigenSolver<MatrixXd>(G, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  if (softest > 0.0) buckling_ = 1.0 / softest;
}

double ModalRange::deflection(const Model& model, const Evaluation& evaluation) const {
  double largest = 0.0;
  for (const int k : nodes_) {
    const Vector3d moved = model.modal_nodes[k].Xd.lazyProduct(evaluation.modal_bodies[body_].w);
    largest = std::max(largest, moved.norm());
  }
  return largest;
}

bool ModalRange::carries(const Model& model, int node) const {
  const int modal = node < 0 ? -1 : model.nodes[node].modal;
  return modal >= 0 && model.modal_nodes[modal].body == body_;
}

template <class Items>
std::vector<int> ModalRange::on_body(const Model& model, const Items& items) const {
  std::vector<int> found;
  for (int i = 0; i < std::ssize(items); ++i)
    if (carries(model, items[i].a.node) || carries(model, items[i].b.node)) found.push_back(i);
  return found;
}

void ModalRange::find_forces(const Model& model) {
  joints_ = on_body(model, model.joints);
  bushings_ = on_body(model, model.bushings);
  const std::vector<int> coordinates = on_body(model, model.coordinates);
  const auto is_on = [&](int coordinate) { return std::ranges::binary_search(coordinates, coordinate); };
  for (int i = 0; i < std::ssize(model.couplings); ++i)
    for (const CouplingTerm& term : model.couplings[i].terms)
      if (is_on(term.coordinate)) terms_.push_back({i, term});
  for (int i = 0; i < std::ssize(model.springs); ++i)
    if (is_on(model.springs[i].coordinate)) springs_.push_back(i);
  for (int i = 0; i < std::ssize(model.loads); ++i)
    if (carries(model, model.loads[i].at.node)) loads_.push_back(i);
}

double ModalRange::distance(const Model& model, int node) const {
  return carries(model, node) ? (model.modal_nodes[model.nodes[node].modal].x - start_).dot(axis_) : 0.0;
}

double ModalRange::axial_force(const Model& model, const State& state, const Evaluation& evaluation) const {
  const ModalBody& body = model.modal_bodies[body_];
  const ModalScratch& now = evaluation.modal_bodies[body_];
  const Vector3d e = now.A * axis_;
  double sum = 0.0;  // Σ s e·f of the forces on nodes
  const auto take = [&](const auto& pair, const Vector12& residual) {
    sum -= distance(model, pair.a.node) * e.dot(residual.head<3>());
    sum -= distance(model, pair.b.node) * e.dot(residual.segment<3>(6));
  };
  for (const int i : joints_) {
    const Joint& joint = model.joints[i];
    Vector12 force = Vector12::Zero();
    for (int k = 0; k < joint.size(); ++k)
      force += state.lambda()[joint.row + k] * evaluation.joints[i].B.row(k).transpose();
    take(joint, force);
  }
  for (const auto& [coupling, term] : terms_)
    take(model.coordinates[term.coordinate], state.lambda()[model.couplings[coupling].row] * term.factor *
                                                 evaluation.coordinates[term.coordinate].G.transpose());
  for (const int i : springs_) {
    const CoordinateTerms& c = evaluation.coordinates[model.springs[i].coordinate];
    take(model.coordinates[model.springs[i].coordinate],
         -spring_force(model.springs[i], c.value, c.rate, 0.0).Q * c.G.transpose());
  }
  for (const int i : bushings_) take(model.bushings[i], evaluation.bushings[i].force);
  for (const int i : loads_) {
    const Load& load = model.loads[i];
    sum += distance(model, load.at.node) *
           e.dot(load_force(load, motion_of(evaluation, load.at.node), evaluation.load_values[i]).head<3>());
  }
  // Σ m s e·(a − g) of the undeformed body, with a = r̈ + (ω̇~ + ω~ω~) x.
  const auto turned = [&now](const Vector3d& x) -> Vector3d {
    return now.omd.cross(x) + now.om.cross(now.om.cross(x));
  };
  const double inertia = axis_.dot(body.c0 - body.mass * start_) * axis_.dot(now.ga) +
                         axis_.dot(turned(body.P0 * axis_)) - axis_.dot(start_) * axis_.dot(turned(body.c0));
  return (sum - inertia) / span_;
}

double ModalRange::first_frequency(const Model& model, double from) const {
  const ModalBody& body = model.modal_bodies[body_];
  const int n = 6 + body.modes;
  std::vector<int> held;
  for (const int k : nodes_)
    if (attached_[model.modal_nodes[k].node]) held.push_back(k);
  const NodeMotion rest;
  const VectorXd zero = VectorXd::Zero(body.modes);
  ModalScratch scratch = make_scratch(body);
  update_kinematics(body, rest, {zero.data(), zero.data(), zero.data()}, Vector3d::Zero(), scratch);
  tangent(body, {1.0, 0.0, 0.0}, scratch);
  const int rows = held.size() == 1 ? 6 : 3;
  const auto of_nodes = rows * static_cast<Eigen::Index>(held.size());
  MatrixXd G = MatrixXd::Zero(of_nodes + 3, n);
  if (body.planar) G.block<3, 3>(of_nodes, 2).setIdentity();  // no motion out of the plane
  for (std::size_t i = 0; i < held.size(); ++i) {
    ModalNodeTerms terms = make_terms(model.modal_nodes[held[i]]);
    NodeMotion motion;
    update_node<3>(model.modal_nodes[held[i]], scratch, rest, motion, terms);
    G.middleRows(rows * static_cast<Eigen::Index>(i), rows) = terms.T.topRows(rows);
  }
  const MatrixXd free = G.fullPivLu().kernel();
  VectorXd S = VectorXd::Zero(n);
  S.tail(body.modes) = body.stiffness;
  const MatrixXd M = free.transpose() * scratch.tangent * free, K = free.transpose() * S.asDiagonal() * free;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(K, M, Eigen::EigenvaluesOnly);
  if (eigen.info() != Eigen::Success) return 0.0;
  // Counts the rigid motions that the nodes leave free, because round-off gives them a frequency.
  MatrixXd Phi = G.leftCols<6>();
  Phi.rightCols<3>() /= span_ > 0.0 ? span_ : 1.0;
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(1e-6);  // files give positions with six digits
  for (Eigen::Index k = 6 - qr.compute(Phi).rank(); k < K.rows(); ++k)
    if (const double square = eigen.eigenvalues()[k]; square > 1e-6 * from * from) return std::sqrt(square);
  return 0.0;
}

}  // namespace tisserand::mechanism
