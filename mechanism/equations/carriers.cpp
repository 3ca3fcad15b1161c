// SPDX-License-Identifier: GPL-3.0-or-later
// Products with the kinematics of nodes of modal bodies.
#include "mechanism/equations/carriers.hpp"

#include <algorithm>

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Number of columns of a carrier.
Index width_of(const Model& model, int node) {
  const int modal = modal_node(model, node);
  return modal < 0 ? 6 : 6 + modal_body_of(model, modal).modes;
}

/// Calls visit(local column, first column, modal node, width) for each carrier.
template <class Visit>
void for_each_carrier(const Model& model, const ElementMap& map, Visit visit) {
  Index first = 0, local = 0;
  for (const int node : map.carriers) {
    const Index width = width_of(model, node);
    visit(local, first, modal_node(model, node), width);
    local += 6;
    first += width;
  }
}

const ModalNodeTerms& terms_of(const Evaluation& evaluation, int modal) { return evaluation.modal_nodes[modal]; }

/// Index of the first coordinate of the carrier whose columns begin at `first` of local vectors.
Index first_coordinate(const Model& model, const ElementMap& map, int first) {
  if (map.carriers.empty()) return first;
  Index coordinate = 0;
  for (int carrier = 0; carrier < first / 6; ++carrier) coordinate += width_of(model, map.carriers[carrier]);
  return coordinate;
}

/// Material increment T(θ) d of a node's rotation for an increment d of the rotation vector θ of the step.
Vector3d turn_increment(const Model& model, const Evaluation& evaluation, int node, const Vector3d& d) {
  if (node < 0 || model.nodes[node].rotation < 0) return d;
  const Vector3d theta = evaluation.displacement.segment<3>(model.nodes[node].rotation);
  const AngleFunctions<double> f(theta.squaredNorm());
  const Vector3d across = theta.cross(d);
  return d - f.c * across + f.d * theta.cross(across);
}

}  // namespace

CarrierScratch make_carrier_scratch(const Model& model) {
  Index size = 0;
  const Index carriers = model.channel_uses.empty() ? 2 : 4;
  for (const ModalBody& body : model.modal_bodies) size = std::max<Index>(size, carriers * (6 + body.modes));
  CarrierScratch scratch;
  scratch.half.setZero(6 * carriers * size);
  scratch.full.setZero(size * size);
  scratch.gradient.setZero(6 * size);
  scratch.lower.setZero(6 * size);
  scratch.upper.setZero(6 * size);
  scratch.rate.setZero(6 * size);
  return scratch;
}

void add_pulled_force(const Model& model, const ElementMap& map, const double* force, Evaluation& evaluation) {
  for (int first = 0; first < 6 * std::ssize(map.carriers); first += 6)
    add_carrier_force<3>(model, map, first, Eigen::Map<const Vector6d>(force + first), evaluation);
}

CarrierMatrix Carriers::rows(const LocalMatrix& B, Eigen::VectorXd& buffer) const {
  CarrierMatrix rows(buffer.data(), B.rows(), static_cast<Index>(map.coordinates.size()));
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    if (modal < 0)
      rows.middleCols(first, width) = B.middleCols<6>(local);
    else
      rows.middleCols(first, width).noalias() = B.middleCols<6>(local).lazyProduct(terms_of(evaluation, modal).T);
  });
  return rows;
}

CarrierMatrix Carriers::tangent(const LocalMatrix& K, const double* force, CarrierScratch& scratch) const {
  const auto n = static_cast<Index>(map.coordinates.size());
  const CarrierMatrix half = rows(K, scratch.half);
  CarrierMatrix full(scratch.full.data(), n, n);
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    if (modal < 0) {
      full.middleRows(first, width) = half.middleRows<6>(local);
      return;
    }
    const ModalNodeTerms& terms = terms_of(evaluation, modal);
    full.middleRows(first, width).noalias() = terms.T.transpose().lazyProduct(half.middleRows<6>(local));
  });
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    if (modal < 0) return;
    add_geometric_stiffness(model.modal_nodes[modal], terms_of(evaluation, modal),
                            Eigen::Map<const Vector6d>(force + local), full.block(first, first, width, width));
  });
  return full;
}

CarrierMatrix Carriers::rate_gradient(const LocalMatrix& B, const LocalMatrix& N, CarrierScratch& scratch) const {
  CarrierMatrix gradient = rows(N, scratch.rate);
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    if (modal < 0) return;
    const ModalNode& node = model.modal_nodes[modal];
    CarrierMatrix Z(scratch.gradient.data(), 6, width);
    mechanism::rate_gradient(node, evaluation.modal_bodies[node.body], terms_of(evaluation, modal), Z);
    gradient.middleCols(first, width).noalias() += B.middleCols<6>(local).lazyProduct(Z);
  });
  return gradient;
}

void Carriers::bias(double* values) const {
  for_each_carrier(model, map, [&](Index local, Index, int modal, Index) {
    Eigen::Map<Vector6d> b(values + local);
    if (modal < 0)
      b.setZero();
    else
      b = terms_of(evaluation, modal).bias;
  });
}

template <int D>
CarrierVector<D> Carriers::pushed(int node, int first, const Eigen::VectorXd& d) const {
  constexpr int turns = Space<D>::turns, turn = Space<D>::first_turn;
  const int* const at = map.coordinates.data() + first_coordinate(model, map, first);
  CarrierVector<D> own = gather_carrier<D>(at, d);
  const int modal = modal_node(model, node);
  if constexpr (D == 3)  // T(θ) d = d for parallel vectors
    own.template tail<3>() =
        turn_increment(model, evaluation, modal < 0 ? node : modal_body_of(model, modal).node, own.template tail<3>());
  if (modal < 0) return own;
  const auto& T = terms_of(evaluation, modal).T;
  const TurnOf<D> turned = own.template tail<turns>();
  own.template head<D>() += T.block<D, turns>(0, turn) * turned;
  own.template tail<turns>() = T.block<turns, turns>(turn, turn) * turned;
  for (Index j = 6; j < T.cols(); ++j) own += carrier_part<D>(T.col(j), 0) * d[at[j]];
  return own;
}
template CarrierVector<2> Carriers::pushed<2>(int, int, const Eigen::VectorXd&) const;
template CarrierVector<3> Carriers::pushed<3>(int, int, const Eigen::VectorXd&) const;

template <int D>
void Carriers::scatter_through(int first, const CarrierVector<D>& force, Eigen::VectorXd& result) const {
  constexpr int turns = Space<D>::turns, turn = Space<D>::first_turn;
  const int modal = modal_node(model, map.carriers[first / 6]);
  const int* const at = map.coordinates.data() + first_coordinate(model, map, first);
  CarrierVector<D> own = force;
  if (modal >= 0) {
    const auto& T = terms_of(evaluation, modal).T;
    const TurnOf<D> moment = force.template tail<turns>();
    own.template tail<turns>() = T.block<D, turns>(0, turn).transpose() * force.template head<D>() +
                                 T.block<turns, turns>(turn, turn).transpose() * moment;
    for (Index j = 6; j < T.cols(); ++j) result[at[j]] += carrier_part<D>(T.col(j), 0).dot(force);
  }
  scatter_carrier<D>(at, own, result);
}
template void Carriers::scatter_through<2>(int, const CarrierVector<2>&, Eigen::VectorXd&) const;
template void Carriers::scatter_through<3>(int, const CarrierVector<3>&, Eigen::VectorXd&) const;

void Carriers::turn_columns(CarrierMatrix& matrix) const {
  for_each_carrier(model, map, [&](Index local, Index first, int, Index) {
    const Matrix3d T = step_tangent(model, evaluation, map.carriers[local / 6]);
    for (Index k = 0; k < matrix.rows(); ++k) {
      const Eigen::RowVector3d turned = matrix.row(k).segment<3>(first + 3) * T;
      matrix.row(k).segment<3>(first + 3) = turned;
    }
  });
}

Eigen::MatrixXd model_rows(const Model& model, const ElementMap& map, const LocalMatrix& B,
                           const Evaluation& evaluation) {
  if (map.carriers.empty()) return B;
  Eigen::VectorXd buffer(B.rows() * static_cast<Index>(map.coordinates.size()));
  return Carriers{model, map, evaluation}.rows(B, buffer);
}

Matrix3d step_tangent(const Model& model, const Evaluation& evaluation, int node) {
  const int modal = modal_node(model, node);
  const int owner = modal < 0 ? node : modal_body_of(model, modal).node;
  if (owner < 0 || model.nodes[owner].rotation < 0 || model.planar) return Matrix3d::Identity();
  const Vector3d turn = evaluation.displacement.segment<3>(model.nodes[owner].rotation);
  return turn.isZero(0.0) ? Matrix3d(Matrix3d::Identity()) : tangent_so3<double>(turn);
}

}  // namespace tisserand::mechanism
