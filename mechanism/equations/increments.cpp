// SPDX-License-Identifier: GPL-3.0-or-later
// Exponential of rotation vectors, and products with the rows of constraints.
#include "mechanism/equations/increments.hpp"

#include "common/math/rotation.hpp"
#include "mechanism/equations/carriers.hpp"
#include "mechanism/frames/turn.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// Quaternion of exp of a rotation vector.
Eigen::Quaterniond exp_quaternion(const Eigen::Vector3d& turn) {
  const double a2 = turn.squaredNorm();
  const AngleFunctions<double> half(0.25 * a2);
  // cos(a/2) = 1 − (a/2)² c(a/2), sin(a/2)/a = s(a/2)/2
  Eigen::Quaterniond q;
  q.w() = 1.0 - 0.25 * a2 * half.c;
  q.vec() = 0.5 * half.s * turn;
  return q;
}

}  // namespace

void apply_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> rows) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    in_space(joint.planar, [&]<int D>() {
      const Carriers on{model, model.joints.maps[i], evaluation};
      const auto product = rows_times<D>(joint, evaluation.joints[i], on.pushed<D>(joint.a.node, 0, d),
                                         on.pushed<D>(joint.b.node, 6, d));
      for (int k = 0; k < joint.size(); ++k) rows[joint.row + k] = product[k];
    });
  }
  for (const Coupling& coupling : model.couplings) {
    double sum = 0.0;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Coordinate& coordinate = model.coordinates[at];
      const Carriers on{model, model.coordinates.maps[at], evaluation};
      const Row12& G = evaluation.coordinates[at].G;
      sum += term.factor * in_space(coordinate.relation.planar, [&]<int D>() {
               return carrier_part<D>(G, 0).dot(on.pushed<D>(coordinate.a.node, 0, d)) +
                      carrier_part<D>(G, 6).dot(on.pushed<D>(coordinate.b.node, 6, d));
             });
    }
    rows[coupling.row] = sum;
  }
}

void apply_transposed_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& mu,
                               Eigen::VectorXd& result) {
  result.setZero();
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    in_space(joint.planar, [&]<int D>() {
      for (const int first : {0, 6})
        Carriers{model, model.joints.maps[i], evaluation}.scatter<D>(
            first, transposed_times<D>(joint, evaluation.joints[i], mu.data() + joint.row, first), result);
    });
  }
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const double own = term.factor * mu[coupling.row];
      in_space(model.coordinates[at].relation.planar, [&]<int D>() {
        for (const int first : {0, 6})
          Carriers{model, model.coordinates.maps[at], evaluation}.scatter<D>(
              first, own * carrier_part<D>(evaluation.coordinates[at].G, first), result);
      });
    }
}

void retract(const Model& model, const State& from, const Eigen::Ref<const Eigen::VectorXd>& d, State& to) {
  auto x = to.x();
  auto Q = to.Q();
  const auto x0 = from.x();
  const auto Q0 = from.Q();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.translation < 0 && node.rotation < 0) continue;
    const auto column = static_cast<Eigen::Index>(i);
    if (model.planar) {
      if (node.translation >= 0) {
        x.col(column) = x0.col(column);
        x.col(column).head<2>() += d.segment<2>(node.translation);
      }
      if (node.rotation >= 0) {
        const Turn half(0.5 * d[node.rotation]);
        const double w = Q0(0, column), z = Q0(3, column);
        Q.col(column) << w * half.c - z * half.s, 0.0, 0.0, w * half.s + z * half.c;
      }
      continue;
    }
    if (node.translation >= 0) x.col(column) = x0.col(column) + translation_at(model, d, node.translation);
    if (node.rotation >= 0) {
      Q.col(column) = wxyz(quaternion(Q0.col(column)) * exp_quaternion(rotation_at(model, d, node.rotation)));
    }
  }
  to.w() = from.w() + d.segment(model.sizes.first_modal(), model.sizes.modal);
  to.y() = from.y() + d.tail(model.sizes.internal);
}

}  // namespace tisserand::mechanism
