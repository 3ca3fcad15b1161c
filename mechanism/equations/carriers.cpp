// Products with the kinematics of nodes of modal bodies.
#include "mechanism/equations/carriers.hpp"

#include <algorithm>

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Columns of a carrier.
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

/// Rows x, y, Θ of a column of T.
Vector3d rows_in_plane(const Eigen::Matrix<double, 6, Eigen::Dynamic>& T, Index column) {
  return {T(0, column), T(1, column), T(5, column)};
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

void scatter_pulled(const Model& model, const ElementMap& map, const double* force, const Evaluation& evaluation,
                    Eigen::VectorXd& result) {
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    const Eigen::Map<const Vector6d> f(force + local);
    for (Index j = 0; j < width; ++j) {
      const int coordinate = map.coordinates[first + j];
      if (coordinate < 0) continue;
      result[coordinate] += modal < 0 ? f[j] : terms_of(evaluation, modal).T.col(j).dot(f);
    }
  });
}

void add_pulled_force(const Model& model, const ElementMap& map, const double* force, Evaluation& evaluation) {
  scatter_pulled(model, map, force, evaluation, evaluation.residual);
  for (std::size_t c = 0; c < map.carriers.size(); ++c)
    if (const int modal = modal_node(model, map.carriers[c]); modal >= 0)
      evaluation.modal_forces[modal] += Eigen::Map<const Vector6d>(force + 6 * c);
}

CarrierMatrix pulled_rows(const Model& model, const ElementMap& map, const LocalMatrix& B, const Evaluation& evaluation,
                          Eigen::VectorXd& buffer) {
  CarrierMatrix rows(buffer.data(), B.rows(), static_cast<Index>(map.coordinates.size()));
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    if (modal < 0)
      rows.middleCols(first, width) = B.middleCols<6>(local);
    else
      rows.middleCols(first, width).noalias() = B.middleCols<6>(local).lazyProduct(terms_of(evaluation, modal).T);
  });
  return rows;
}

CarrierMatrix pulled_tangent(const Model& model, const ElementMap& map, const LocalMatrix& K, const double* force,
                             Evaluation& evaluation) {
  const auto n = static_cast<Index>(map.coordinates.size());
  const CarrierMatrix half = pulled_rows(model, map, K, evaluation, evaluation.carriers.half);
  CarrierMatrix full(evaluation.carriers.full.data(), n, n);
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

CarrierMatrix pulled_rate_gradient(const Model& model, const ElementMap& map, const LocalMatrix& B,
                                   const LocalMatrix& N, Evaluation& evaluation, Eigen::VectorXd& buffer) {
  CarrierMatrix rows = pulled_rows(model, map, N, evaluation, buffer);
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    if (modal < 0) return;
    const ModalNode& node = model.modal_nodes[modal];
    CarrierMatrix Z(evaluation.carriers.gradient.data(), 6, width);
    rate_gradient(node, evaluation.modal_bodies[node.body], terms_of(evaluation, modal), Z);
    rows.middleCols(first, width).noalias() += B.middleCols<6>(local).lazyProduct(Z);
  });
  return rows;
}

void carrier_bias(const Model& model, const ElementMap& map, const Evaluation& evaluation, double* bias) {
  for_each_carrier(model, map, [&](Index local, Index, int modal, Index) {
    Eigen::Map<Vector6d> b(bias + local);
    if (modal < 0)
      b.setZero();
    else
      b = terms_of(evaluation, modal).bias;
  });
}

void pushed_increment(const Model& model, const ElementMap& map, const Evaluation& evaluation, const Eigen::VectorXd& d,
                      double* local_increment) {
  for_each_carrier(model, map, [&](Index local, Index first, int modal, Index width) {
    const auto at = [&](Index j) {
      const int coordinate = map.coordinates[first + j];
      return coordinate < 0 ? 0.0 : d[coordinate];
    };
    const int node = map.carriers[local / 6];
    const Vector3d move(at(0), at(1), at(2));
    const Vector3d turn = step_tangent(model, evaluation, node) * Vector3d(at(3), at(4), at(5));
    Eigen::Map<Vector6d> increment(local_increment + local);
    increment << move, turn;
    if (modal < 0) return;
    const auto& T = terms_of(evaluation, modal).T;
    increment = (T.leftCols<6>() * increment).eval();
    for (Index j = 6; j < width; ++j) increment += at(j) * T.col(j);
  });
}

PlanarVector pushed_through_carriers(const Model& model, const ElementMap& map, const Evaluation& evaluation,
                                     const Eigen::VectorXd& d) {
  PlanarVector local;
  for_each_carrier(model, map, [&](Index six, Index first, int modal, Index width) {
    const int* const at = map.coordinates.data() + first;
    Vector3d own = Vector3d::Zero();
    for (int c = 0; c < 3; ++c)
      if (at[planar_columns[c]] >= 0) own[c] = d[at[planar_columns[c]]];
    if (modal >= 0) {
      const auto& T = terms_of(evaluation, modal).T;
      own.head<2>() += T.col(5).head<2>() * own[2];
      for (Index j = 6; j < width; ++j) own += rows_in_plane(T, j) * d[at[j]];
    }
    local.segment<3>(six / 2) = own;
  });
  return local;
}

void scatter_through_carrier(const Model& model, const ElementMap& map, int carrier, const Vector3d& force,
                             const Evaluation& evaluation, Eigen::VectorXd& result) {
  const int modal = modal_node(model, map.carriers[carrier / 3]);
  const int* const at = map.coordinates.data() + (carrier == 0 ? 0 : width_of(model, map.carriers[0]));
  Vector3d own = force;
  if (modal >= 0) {
    const auto& T = terms_of(evaluation, modal).T;
    own[2] += T.col(5).head<2>().dot(force.head<2>());
    for (Index j = 6; j < 6 + modal_body_of(model, modal).modes; ++j) result[at[j]] += rows_in_plane(T, j).dot(force);
  }
  for (int c = 0; c < 3; ++c)
    if (at[planar_columns[c]] >= 0) result[at[planar_columns[c]]] += own[c];
}

void turn_columns(const Model& model, const ElementMap& map, const Evaluation& evaluation, CarrierMatrix& rows) {
  for_each_carrier(model, map, [&](Index local, Index first, int, Index) {
    const Matrix3d T = step_tangent(model, evaluation, map.carriers[local / 6]);
    for (Index k = 0; k < rows.rows(); ++k) {
      const Eigen::RowVector3d turned = rows.row(k).segment<3>(first + 3) * T;
      rows.row(k).segment<3>(first + 3) = turned;
    }
  });
}

Eigen::MatrixXd model_rows(const Model& model, const ElementMap& map, const LocalMatrix& B,
                           const Evaluation& evaluation) {
  if (map.carriers.empty()) return B;
  Eigen::VectorXd buffer(B.rows() * static_cast<Index>(map.coordinates.size()));
  return pulled_rows(model, map, B, evaluation, buffer);
}

Matrix3d step_tangent(const Model& model, const Evaluation& evaluation, int node) {
  const int modal = modal_node(model, node);
  const int owner = modal < 0 ? node : modal_body_of(model, modal).node;
  if (owner < 0 || model.nodes[owner].rotation < 0 || model.planar) return Matrix3d::Identity();
  const Vector3d turn = evaluation.displacement.segment<3>(model.nodes[owner].rotation);
  return turn.isZero(0.0) ? Matrix3d(Matrix3d::Identity()) : tangent_so3<double>(turn);
}

}  // namespace tisserand::mechanism
