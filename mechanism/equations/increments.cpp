// Exponential of rotation vectors, and the rows of constraints.
#include "mechanism/equations/increments.hpp"

#include <utility>

#include "common/math/rotation.hpp"
#include "mechanism/equations/carriers.hpp"
#include "mechanism/frames/turn.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// exp of a rotation vector as a quaternion.
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
      const ElementMap& map = model.joints.maps[i];
      const auto product =
          rows_times<D>(joint, evaluation.joints[i], pushed<D>(model, map, joint.a.node, 0, evaluation, d),
                        pushed<D>(model, map, joint.b.node, 6, evaluation, d));
      for (int k = 0; k < joint.size(); ++k) rows[joint.row + k] = product[k];
    });
  }
  for (const Coupling& coupling : model.couplings) {
    double sum = 0.0;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Coordinate& coordinate = model.coordinates[at];
      const ElementMap& map = model.coordinates.maps[at];
      const Row12& G = evaluation.coordinates[at].G;
      sum += term.factor * in_space(coordinate.relation.planar, [&]<int D>() {
               return carrier_part<D>(G, 0).dot(pushed<D>(model, map, coordinate.a.node, 0, evaluation, d)) +
                      carrier_part<D>(G, 6).dot(pushed<D>(model, map, coordinate.b.node, 6, evaluation, d));
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
        scatter_pulled<D>(model, model.joints.maps[i], first,
                          transposed_times<D>(joint, evaluation.joints[i], mu.data() + joint.row, first), evaluation,
                          result);
    });
  }
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const double own = term.factor * mu[coupling.row];
      in_space(model.coordinates[at].relation.planar, [&]<int D>() {
        for (const int first : {0, 6})
          scatter_pulled<D>(model, model.coordinates.maps[at], first,
                            own * carrier_part<D>(evaluation.coordinates[at].G, first), evaluation, result);
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
      const Eigen::Quaterniond q0(Q0(0, column), Q0(1, column), Q0(2, column), Q0(3, column));
      Q.col(column) = wxyz(q0 * exp_quaternion(rotation_at(model, d, node.rotation)));
    }
  }
  to.w() = from.w() + d.segment(model.sizes.first_modal(), model.sizes.modal);
  to.y() = from.y() + d.tail(model.sizes.internal);
}

}  // namespace tisserand::mechanism
