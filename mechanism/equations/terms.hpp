// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of evaluate(): scattering of local vectors and matrices, and the loops over joints, their coordinates and
// elements between two markers.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/tangent.hpp"

namespace tisserand::mechanism {

/// Target to which derivatives are added: coefficients c_m, c_c, c_k, the kind of constraint rows, the stored values,
/// and buffers for carriers. `factor` multiplies A in the values; with 0 only constraint rows are added.
struct TangentTarget {
  const TangentCoefficients& coefficients;
  const ConstraintRows& rows;
  double factor = 1.0;
  std::vector<double>& values;
  CarrierScratch& scratch;
};

/// Markers a and b of a joint, a coordinate or a force element, with the motion of their nodes.
template <class Item>
MarkerPair markers_of(const Item& item, const Evaluation& evaluation) {
  return {item.a, item.b, motion_of(evaluation, item.a.node), motion_of(evaluation, item.b.node)};
}

/// Adds the local vector of an element to the global one.
template <class Vector>
void scatter(const ElementMap& map, const Vector& local, Eigen::VectorXd& global) {
  for (std::size_t i = 0; i < map.coordinates.size(); ++i)
    if (map.coordinates[i] >= 0) global[map.coordinates[i]] += local[i];
}

/// Adds factor · local matrix of an element to the stored values of the iteration matrix.
template <class Matrix>
void scatter_matrix(const ElementMap& map, const Matrix& local, double factor, std::vector<double>& values) {
  if (map.slots.empty()) return;
  const std::size_t size = map.coordinates.size();
  for (std::size_t j = 0; j < size; ++j) {
    if (map.coordinates[j] < 0) continue;
    const double* column = local.data() + j * size;
    const int* slots = map.slots.data() + j * size;
    for (std::size_t i = 0; i < size; ++i)
      if (slots[i] >= 0) values[slots[i]] += factor * column[i];
  }
}

/// Adds a local vector, [force; moment] per carrier, to the residual.
template <class Vector>
void add_force(const Model& model, const ElementMap& map, const Vector& local, Evaluation& evaluation) {
  if (map.carriers.empty())
    scatter(map, local, evaluation.residual);
  else
    add_pulled_force(model, map, local.data(), evaluation);
}

/// Adds factor · local matrix ∂(force)/∂(local coordinates) to the stored values. `force()` gives the local force. It
/// matters for modal bodies, because their nodes move with the modes.
template <class Matrix, class Force>
void add_matrix(const Carriers& on, const Matrix& local, double factor, Force force, const TangentTarget& target) {
  if (on.map.carriers.empty()) {
    scatter_matrix(on.map, local, factor, target.values);
    return;
  }
  const auto f = force();
  scatter_matrix(on.map, on.tangent(local_view(local), f.data(), target.scratch), factor, target.values);
}

/// Updates the force scales with a local vector of nodes, [force; moment] of six numbers each.
template <class Vector>
void note_scale(const Vector& local, Evaluation& evaluation) {
  for (Eigen::Index i = 0; i < local.size(); i += 6) {
    evaluation.force_scale[0] = std::max(evaluation.force_scale[0], local.template segment<3>(i).cwiseAbs().maxCoeff());
    evaluation.force_scale[1] =
        std::max(evaluation.force_scale[1], local.template segment<3>(i + 3).cwiseAbs().maxCoeff());
  }
}

/// Updates the force scales with [force; moment] of one carrier in the plane (2 + 1 numbers).
inline void note_scale(const CarrierVector<2>& local, Evaluation& evaluation) {
  double &force = evaluation.force_scale[0], &moment = evaluation.force_scale[1];
  force = std::max({force, std::abs(local[0]), std::abs(local[1])});
  moment = std::max(moment, std::abs(local[2]));
}

/// Adds the forces of all items of a pool to the evaluation. bodies.hpp and forces.hpp declare it for each type.
template <class T>
void add_forces(const Model& model, const State& state, const Pool<T>& pool, Evaluation& evaluation) = delete;

/// Applied force F(t) of spring i at `time`, times the load factor of the evaluation. It is zero for springs without
/// such a force.
double applied_force(const Model& model, std::size_t i, double time, Evaluation& evaluation);

/// Updates the motion of all nodes with own coordinates, at the state.
void update_motion(const Model& model, const State& state, Evaluation& evaluation);
/// Updates the motion of modal bodies and of their active nodes. Requires update_motion().
void update_modal_bodies(const Model& model, const State& state, Evaluation& evaluation);

/// Updates Φ, B and B v of the joints, at the present motion.
void update_joints(const Model& model, Evaluation& evaluation);
/// Updates values, rates and gradients G of the active joint coordinates.
void update_coordinates(const Model& model, const State& state, Evaluation& evaluation);
/// Updates Φ and its rate of couplings and drives. Requires update_coordinates().
void update_couplings(const Model& model, const State& state, Evaluation& evaluation);

/// Adds the reactions Bᵀλ of joints to the residual.
void add_joints(const Model& model, const State& state, Evaluation& evaluation);
/// Adds the reactions Bᵀλ of couplings and drives to the residual.
void add_couplings(const Model& model, const State& state, Evaluation& evaluation);
/// Adds the forces of springs to the residual, and their energy and powers to the evaluation.
void add_springs(const Model& model, const State& state, Evaluation& evaluation);

/// Updates the values of channels and passes them to the expressions that use them. Requires update_coordinates().
void update_channels(const Model& model, Evaluation& evaluation);

/// Adds the forces of friction in joints to the residual. Requires add_joints().
void add_frictions(const Model& model, const State& state, Evaluation& evaluation);
/// Updates the factors of part loads, also those in the scratch of superelements. The forces of bodies require it.
void update_part_loads(const Model& model, const State& state, Evaluation& evaluation);

/// Adds constraint rows, their transposes and geometric stiffness of joints to the stored values.
void add_joint_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target);
/// Adds rows, their transposes and geometric stiffness of couplings and drives, and the tangents of springs.
void add_coordinate_tangents(const Model& model, const State& state, Evaluation& evaluation,
                             const TangentTarget& target);
/// Updates evaluation.part_load_directions[i], the generalised force of part load i, at the motion of the last
/// evaluate().
void update_direction(const Model& model, std::size_t i, Evaluation& evaluation);
/// Adds the tangents of friction. The derivatives of the residual r by the multipliers λ go into the block of Bᵀ.
void add_friction_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target);
/// Adds the derivatives of loads and spring forces by the channels that their expressions use. For part loads on
/// superelements they omit the effect of internal coordinates.
void add_channel_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target);

/// Row of derivatives of the factor of a part load by the motion, through one use of a channel: ∂(factor)/∂(channel)
/// times c_c ∂(channel)/∂v + c_k ∂(channel)/∂q. Its columns are the coordinates of the map of the use that follow those
/// of the load. Allocates memory.
Eigen::MatrixXd part_load_channel_row(const Model& model, const State& state, std::size_t use,
                                      const TangentCoefficients& coefficients, Evaluation& evaluation);

}  // namespace tisserand::mechanism
