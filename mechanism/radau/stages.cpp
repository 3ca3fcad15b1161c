// SPDX-License-Identifier: GPL-3.0-or-later
// Collocation polynomials and rotation vectors.
#include "mechanism/radau/stages.hpp"

#include <cmath>

#include "common/math/rotation.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism::radau {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// Values at τ of Lagrange's polynomials of the stages.
Vector3d through_stages(double tau) {
  const Vector3d& c = coefficients().c;
  Vector3d l;
  for (int k = 0; k < 3; ++k) {
    const double a = c[(k + 1) % 3], b = c[(k + 2) % 3];
    l[k] = (tau - a) * (tau - b) / ((c[k] - a) * (c[k] - b));
  }
  return l;
}

/// Values and derivatives by τ of Lagrange's polynomials of 0 and the stages. The first belongs to the start.
struct Basis {
  Vector4d value, slope;
};

Basis through_start(double tau) {
  const Vector3d& c = coefficients().c;
  const double node[] = {0.0, c[0], c[1], c[2]};
  Basis basis;
  for (int k = 0; k < 4; ++k) {
    double value = 1.0, slope = 0.0;
    for (int j = 0; j < 4; ++j) {
      if (j == k) continue;
      const double factor = (tau - node[j]) / (node[k] - node[j]);
      slope = slope * factor + value / (node[k] - node[j]);
      value *= factor;
    }
    basis.value[k] = value;
    basis.slope[k] = slope;
  }
  return basis;
}

/// Value and slope at τ of the polynomial that vanishes at 0 and at the stages and has slope 1 at 0.
struct Bubble {
  double value, slope;
};

Bubble bubble(double tau) {
  const Vector3d& c = coefficients().c;
  const double p = (tau - c[0]) * (tau - c[1]) * (tau - c[2]), p0 = -c[0] * c[1] * c[2];
  const double slope = (tau - c[1]) * (tau - c[2]) + (tau - c[0]) * (tau - c[2]) + (tau - c[0]) * (tau - c[1]);
  return {tau * p / p0, (p + tau * slope) / p0};
}

/// Applies T(θ) or T⁻¹(θ) to the rotations of all nodes in a column.
template <class Map, class Column>
void map_rotations(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& turns, Map map, Column&& column) {
  for (const Node& node : model.nodes) {
    if (node.rotation < 0 || model.planar) continue;  // T(θ) x = x for parallel vectors
    const Vector3d theta = turns.segment<3>(node.rotation);
    column.template segment<3>(node.rotation) = (map(theta) * column.template segment<3>(node.rotation)).eval();
  }
}

}  // namespace

Stages::Stages(const Sizes& sizes)
    : d(Columns::Zero(sizes.velocities(), 3)),
      v(d),
      a(d),
      lambda(Columns::Zero(sizes.constraints, 3)),
      v_begin(Eigen::VectorXd::Zero(sizes.velocities())),
      a_begin(v_begin),
      displacement(v_begin) {}

void update_rates(const Model& model, Stages& stages) {
  const Eigen::Matrix3d weights = coefficients().inverse.transpose() / stages.step;
  stages.v = stages.d.lazyProduct(weights);
  for (int i = 0; i < 3; ++i) map_rotations(model, stages.d.col(i), tangent_so3<double>, stages.v.col(i));
  const Vector3d sums = weights.colwise().sum();
  stages.a = stages.v.lazyProduct(weights);
  for (int i = 0; i < 3; ++i) stages.a.col(i) -= sums[i] * stages.v_begin;
}

void predict(const Model& model, const State& state, const StepEnd& end, const Stages& last, Stages& stages) {
  const double step = end.time - state.time();
  const Coefficients& method = coefficients();
  for (int i = 0; i < 3; ++i) {
    if (last.step > 0.0) {
      const double tau = 1.0 + method.c[i] * step / last.step;
      const Vector4d p = through_start(tau).value;
      const Vector3d l = through_stages(tau);
      stages.v.col(i) = p[0] * last.v_begin + p[1] * last.v.col(0) + p[2] * last.v.col(1) + p[3] * last.v.col(2);
      stages.lambda.col(i) = l[0] * last.lambda.col(0) + l[1] * last.lambda.col(1) + l[2] * last.lambda.col(2);
    } else {
      stages.v.col(i) = state.v() + (method.c[i] * step) * state.vdot();
      stages.lambda.col(i) = state.lambda();
    }
  }
  stages.step = step;
  stages.end = end;
  stages.v_begin = state.v();
  stages.a_begin = state.vdot();
  const Eigen::Matrix3d weights = step * method.A.transpose();
  stages.d = stages.v.lazyProduct(weights);
  for (int sweep = 0; sweep < 2; ++sweep) {
    stages.a = stages.v;
    for (int i = 0; i < 3; ++i) map_rotations(model, stages.d.col(i), inverse_tangent_so3<double>, stages.a.col(i));
    stages.d = stages.a.lazyProduct(weights);
  }
  update_rates(model, stages);
}

void interpolate(const Model& model, const State& begin, double tau, Stages& stages, State& state) {
  const Basis p = through_start(tau), at_start = through_start(0.0);
  const Bubble b = bubble(tau);
  const double h = stages.step;
  const auto& d = stages.d;
  const auto& v = stages.v;
  Eigen::VectorXd& displacement = stages.displacement;
  displacement = p.value[1] * d.col(0) + p.value[2] * d.col(1) + p.value[3] * d.col(2);
  displacement += b.value * (h * stages.v_begin - at_start.slope[1] * d.col(0) - at_start.slope[2] * d.col(1) -
                             at_start.slope[3] * d.col(2));
  retract(model, begin, displacement, state);
  state.v() = p.value[0] * stages.v_begin + p.value[1] * v.col(0) + p.value[2] * v.col(1) + p.value[3] * v.col(2);
  state.vdot() = p.slope[0] * stages.v_begin + p.slope[1] * v.col(0) + p.slope[2] * v.col(1) + p.slope[3] * v.col(2);
  displacement = h * stages.a_begin - at_start.slope[0] * stages.v_begin - at_start.slope[1] * v.col(0) -
                 at_start.slope[2] * v.col(1) - at_start.slope[3] * v.col(2);
  state.v() += b.value * displacement;
  state.vdot() = (state.vdot() + b.slope * displacement) / h;
  const Vector3d l = through_stages(tau);
  state.lambda() = l[0] * stages.lambda.col(0) + l[1] * stages.lambda.col(1) + l[2] * stages.lambda.col(2);
}

double integral(const Stages& stages, const Vector3d& power, double tau) {
  // Two points of Gauss integrate the quadratic polynomial exactly.
  const double half = 0.5 * tau, distance = half / std::sqrt(3.0);
  const double sum = through_stages(half - distance).dot(power) + through_stages(half + distance).dot(power);
  return stages.step * half * sum;
}

}  // namespace tisserand::mechanism::radau
