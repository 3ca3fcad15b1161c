// Parts of evaluate(): scattering of local vectors and matrices, and the loops over joints, their coordinates and
// what acts between two markers.
#pragma once

#include <algorithm>
#include <vector>

#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/evaluate.hpp"

namespace tisserand::mechanism {

/// The markers of a joint, a coordinate or a force element with the motion of their carriers.
template <class Item>
MarkerPair markers_of(const Item& item, const Workspace& workspace) {
  return {item.a, item.b, motion_of(workspace, item.a.node), motion_of(workspace, item.b.node)};
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
  const double* entry = local.data();
  for (const int slot : map.slots) {
    if (slot >= 0) values[slot] += factor * *entry;
    ++entry;
  }
}

/// Adds a local vector [force; moment] per carrier to the residual.
template <class Vector>
void add_force(const Model& model, const ElementMap& map, const Vector& local, Workspace& workspace) {
  if (map.carriers.empty())
    scatter(map, local, workspace.residual);
  else
    scatter_pulled(model, map, local.data(), workspace);
}

/// Adds factor times the local matrix ∂(force)/∂(local coordinates) to the stored values; `force()` gives the local
/// force, which modal bodies feel through moving nodes.
template <class Matrix, class Force>
void add_matrix(const Model& model, const ElementMap& map, const Matrix& local, double factor, Workspace& workspace,
                Force force) {
  if (map.carriers.empty()) {
    scatter_matrix(map, local, factor, workspace.values);
    return;
  }
  const auto f = force();
  scatter_matrix(map, pulled_tangent(model, map, local_view(local), f.data(), workspace), factor, workspace.values);
}

/// Adds the first `size` rows of `lower` and, transposed, of `upper`, which begin at slot `first` of the map.
template <class Lower, class Upper>
void add_rows(const ConstraintMap& map, std::size_t first, int size, const Lower& lower, const Upper& upper,
              std::vector<double>& values) {
  for (Eigen::Index j = 0; j < lower.cols(); ++j)
    for (int k = 0; k < size; ++k, ++first) {
      if (map.lower[first] < 0) continue;
      values[map.lower[first]] += lower(k, j);
      values[map.upper[first]] += upper(k, j);
    }
}

/// Force and moment rows of nodes with six coordinates.
template <class Vector>
void note_scale(const Vector& local, Workspace& workspace) {
  for (Eigen::Index i = 0; i < local.size(); i += 6) {
    workspace.force_scale[0] = std::max(workspace.force_scale[0], local.template segment<3>(i).cwiseAbs().maxCoeff());
    workspace.force_scale[1] =
        std::max(workspace.force_scale[1], local.template segment<3>(i + 3).cwiseAbs().maxCoeff());
  }
}

/// F(t) of spring i at the load time, scaled as loads are.
double applied_force(const Model& model, std::size_t i, double time, Workspace& workspace);

/// evaluate_tangent() without the superelements, whose internal coordinates a caller may want to keep; exact.
void evaluate_tangent_without_superelements(const Model& model, const State& state,
                                            const TangentCoefficients& coefficients, const ConstraintRows& rows,
                                            Workspace& workspace);

/// Φ, its rate and Bᵀλ of the joints.
void add_joints(const Model& model, const State& state, Workspace& workspace);

/// The active coordinates; Φ, its rate and Bᵀλ of couplings and motions, and the forces of springs.
void add_coordinates(const Model& model, const State& state, Workspace& workspace);

/// Values of the channels, and their passing on to the expressions that use them; after the active coordinates.
void update_channels(const Model& model, Workspace& workspace);
/// Derivatives of loads and spring forces by the channels, times `factor`.
void add_channel_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                          double factor, Workspace& workspace);

/// Forces of friction in joints, after add_joints(). Their tangents: A times `factor`, and ∂r/∂λ beside Bᵀ.
void add_frictions(const Model& model, const State& state, Workspace& workspace);
void add_friction_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                           double factor, Workspace& workspace);

/// Forces, energy and powers of bushings, and their tangents times `factor`.
void add_bushings(const Model& model, Workspace& workspace);
void add_bushing_tangents(const Model& model, const TangentCoefficients& coefficients, double factor,
                          Workspace& workspace);

/// Rows, columns and geometric stiffness (times `stiffness`) of the joints.
void add_joint_tangents(const Model& model, const State& state, double stiffness, const ConstraintRows& kind,
                        Workspace& workspace);

/// The same for couplings and motions, and the tangents of springs times `factor`.
void add_coordinate_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                             double factor, const ConstraintRows& kind, Workspace& workspace);

}  // namespace tisserand::mechanism
