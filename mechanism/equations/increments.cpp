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

/// Material increment T(θ) d of a node's rotation for an increment d of the rotation vector θ of the step.
Eigen::Vector3d turn_increment(const Model& model, const Evaluation& evaluation, int node, const Eigen::Vector3d& d) {
  if (node < 0 || model.nodes[node].rotation < 0 || model.planar) return d;  // T(θ) d = d for parallel vectors
  const Eigen::Vector3d theta = evaluation.displacement.segment<3>(model.nodes[node].rotation);
  const AngleFunctions<double> f(theta.squaredNorm());
  const Eigen::Vector3d across = theta.cross(d);
  return d - f.c * across + f.d * theta.cross(across);
}

}  // namespace

void apply_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> rows) {
  Eigen::Matrix<double, 12, 1> local;
  const auto gather_local = [&](const ElementMap& map, const auto& pair) {
    if (!map.carriers.empty()) {
      pushed_increment(model, map, evaluation, d, local.data());
      return;
    }
    for (int k = 0; k < 12; ++k) {
      const int coordinate = map.coordinates[k];
      local[k] = coordinate < 0 ? 0.0 : d[coordinate];
    }
    local.segment<3>(3) = turn_increment(model, evaluation, pair.a.node, local.segment<3>(3));
    local.segment<3>(9) = turn_increment(model, evaluation, pair.b.node, local.segment<3>(9));
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const ElementMap& map = model.joints.maps[i];
    if (joint.planar) {
      const Eigen::Vector3d product =
          rows_times_in_plane(joint, evaluation.joints[i], pushed_in_plane(model, map, evaluation, d));
      for (int k = 0; k < joint.size(); ++k) rows[joint.row + k] = product[k];
      continue;
    }
    gather_local(map, joint);
    const Vector6d product = rows_times(evaluation.joints[i], local);
    for (int k = 0; k < joint.size(); ++k) rows[joint.row + k] = product[k];
  }
  for (const Coupling& coupling : model.couplings) {
    double sum = 0.0;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const ElementMap& map = model.coordinates.maps[at];
      const Row12& G = evaluation.coordinates[at].G;
      if (model.coordinates[at].planar) {
        const PlanarVector own = pushed_in_plane(model, map, evaluation, d);
        sum += term.factor * (in_plane(G, 0).dot(own.head<3>()) + in_plane(G, 3).dot(own.tail<3>()));
        continue;
      }
      gather_local(map, model.coordinates[at]);
      sum += term.factor * G.dot(local);
    }
    rows[coupling.row] = sum;
  }
}

void apply_transposed_jacobian(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& mu,
                               Eigen::VectorXd& result) {
  result.setZero();
  const auto add = [&](const ElementMap& map, const Eigen::Matrix<double, 12, 1>& local) {
    if (!map.carriers.empty()) {
      scatter_pulled(model, map, local.data(), evaluation, result);
      return;
    }
    for (int k = 0; k < 12; ++k)
      if (map.coordinates[k] >= 0) result[map.coordinates[k]] += local[k];
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const ElementMap& map = model.joints.maps[i];
    const double* own = mu.data() + joint.row;
    if (joint.planar) {
      for (const auto& [marker, carrier] : {std::pair(&joint.a, 0), std::pair(&joint.b, 3)})
        if (marker->node >= 0)
          scatter_in_plane(model, map, carrier, transposed_times_in_plane(joint, evaluation.joints[i], own, carrier),
                           evaluation, result);
      continue;
    }
    add(map, transposed_times(joint, evaluation.joints[i], own));
  }
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const ElementMap& map = model.coordinates.maps[at];
      const double own = term.factor * mu[coupling.row];
      const Row12& G = evaluation.coordinates[at].G;
      if (model.coordinates[at].planar)
        for (const int carrier : {0, 3})
          scatter_in_plane(model, map, carrier, own * in_plane(G, carrier), evaluation, result);
      else
        add(map, own * G.transpose());
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
