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

/// Target of derivatives: c_m, c_c, c_k, the kind of constraint rows, the factor of A (0: rows alone), the stored
/// values, and buffers for carriers.
struct TangentTarget {
  const TangentCoefficients& coefficients;
  const ConstraintRows& rows;
  double factor = 1.0;
  std::vector<double>& values;
  CarrierScratch& scratch;
};

/// Markers of a joint, a coordinate or a force element with the motion of their carriers.
template <class Item>
MarkerPair markers_of(const Item& item, const Evaluation& evaluation) {
  return {item.a, item.b, motion_of(evaluation, item.a.node), motion_of(evaluation, item.b.node)};
}

/// Adds the local vector to the global one.
template <class Vector>
void scatter(const ElementMap& map, const Vector& local, Eigen::VectorXd& global) {
  for (std::size_t i = 0; i < map.coordinates.size(); ++i)
    if (map.coordinates[i] >= 0) global[map.coordinates[i]] += local[i];
}

/// Adds factor times the local matrix to the stored values.
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

/// Adds a local vector [force; moment] per carrier to the residual.
template <class Vector>
void add_force(const Model& model, const ElementMap& map, const Vector& local, Evaluation& evaluation) {
  if (map.carriers.empty())
    scatter(map, local, evaluation.residual);
  else
    add_pulled_force(model, map, local.data(), evaluation);
}

/// Adds factor times the local matrix ∂(force)/∂(local coordinates) to the stored values. `force()` gives the local
/// force, whose direction matters for modal bodies because their nodes move.
template <class Matrix, class Force>
void add_matrix(const Carriers& on, const Matrix& local, double factor, Force force, const TangentTarget& target) {
  if (on.map.carriers.empty()) {
    scatter_matrix(on.map, local, factor, target.values);
    return;
  }
  const auto f = force();
  scatter_matrix(on.map, on.tangent(local_view(local), f.data(), target.scratch), factor, target.values);
}

/// Updates the force scales with force and moment rows of nodes with six coordinates.
template <class Vector>
void note_scale(const Vector& local, Evaluation& evaluation) {
  for (Eigen::Index i = 0; i < local.size(); i += 6) {
    evaluation.force_scale[0] = std::max(evaluation.force_scale[0], local.template segment<3>(i).cwiseAbs().maxCoeff());
    evaluation.force_scale[1] =
        std::max(evaluation.force_scale[1], local.template segment<3>(i + 3).cwiseAbs().maxCoeff());
  }
}

/// Updates the force scales with the values of a carrier in the plane.
inline void note_scale(const CarrierVector<2>& local, Evaluation& evaluation) {
  double &force = evaluation.force_scale[0], &moment = evaluation.force_scale[1];
  force = std::max({force, std::abs(local[0]), std::abs(local[1])});
  moment = std::max(moment, std::abs(local[2]));
}

/// Adds the forces of all items of a pool of bodies or forces; bodies.hpp and forces.hpp declare it for each type.
template <class T>
void add_forces(const Model& model, const State& state, const Pool<T>& pool, Evaluation& evaluation) = delete;

/// Applied force F(t) of spring i at the load time, scaled like loads.
double applied_force(const Model& model, std::size_t i, double time, Evaluation& evaluation);

/// Updates the motion of all nodes with own coordinates; then that of modal bodies and their active nodes.
void update_motion(const Model& model, const State& state, Evaluation& evaluation);
void update_modal_bodies(const Model& model, const State& state, Evaluation& evaluation);

/// Updates Φ, B and B v of the joints.
void update_joints(const Model& model, Evaluation& evaluation);
/// Updates values, rates and gradients G of the active coordinates.
void update_coordinates(const Model& model, const State& state, Evaluation& evaluation);
/// Updates Φ and its rate of couplings and motions, after their coordinates.
void update_couplings(const Model& model, const State& state, Evaluation& evaluation);

/// Adds Bᵀλ of joints, of couplings and motions; forces, energy and powers of springs.
void add_joints(const Model& model, const State& state, Evaluation& evaluation);
void add_couplings(const Model& model, const State& state, Evaluation& evaluation);
void add_springs(const Model& model, const State& state, Evaluation& evaluation);

/// Updates the channels and passes their values to the expressions that use them, after the active coordinates.
void update_channels(const Model& model, Evaluation& evaluation);

/// Adds the forces of friction in joints, after add_joints().
void add_frictions(const Model& model, const State& state, Evaluation& evaluation);
/// Updates the factors of part loads, also in the scratch of their superelements, before the forces of bodies.
void update_part_loads(const Model& model, const State& state, Evaluation& evaluation);

/// Add rows, columns and geometric stiffness of joints, of couplings and motions. Further tangents are those of
/// springs, of friction (with ∂r/∂λ in the block of Bᵀ), and of loads and spring forces by the channels. For part loads
/// on superelements they omit the effect of internal coordinates.
void add_joint_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target);
void add_coordinate_tangents(const Model& model, const State& state, Evaluation& evaluation,
                             const TangentTarget& target);
/// Updates evaluation.part_load_directions[i] at the motion of the last evaluate().
void update_direction(const Model& model, std::size_t i, Evaluation& evaluation);
void add_friction_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target);
void add_channel_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target);

/// Row c_c ∂(channel)/∂v + c_k ∂(channel)/∂q times ∂(factor)/∂(channel) for one use by a part load, in the coordinates
/// of the map of the use that follow those of the load. Allocates memory.
Eigen::MatrixXd part_load_channel_row(const Model& model, const State& state, std::size_t use,
                                      const TangentCoefficients& coefficients, Evaluation& evaluation);

}  // namespace tisserand::mechanism
