// SPDX-License-Identifier: GPL-3.0-or-later
// Carriers: forces and relations on nodes of modal bodies, expressed in the coordinates of these bodies, because such
// nodes own no coordinates.
//
// Joints, coordinates and loads use six coordinates per carrier. If a carrier follows a modal body, their map lists the
// carriers, and T of each carrier transforms the terms: [ẋ; Ω] = T [ṙ ω ẇ], 6 x (6 + m). For other nodes T is the unit
// matrix. Maps without such a carrier list none, and T is not applied.
#pragma once

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/model/element_map.hpp"

namespace tisserand::mechanism {

/// Makes buffers for the carriers of any joint, coordinate or load of the model.
CarrierScratch make_carrier_scratch(const Model& model);

/// View of a result in one of the buffers of CarrierScratch.
using CarrierMatrix = Eigen::Map<Eigen::MatrixXd>;
/// View of a matrix of fixed size or of a row, without a copy.
using LocalMatrix = Eigen::Map<const Eigen::MatrixXd>;
template <class Matrix>
LocalMatrix local_view(const Matrix& m) {
  return {m.data(), m.rows(), m.cols()};
}

/// Carriers of a joint, a coordinate or a force element (the nodes on which it acts), and their motion. T of a carrier
/// maps [ṙ ω ẇ] of its modal body to [ẋ; Ω], and is 1 for a node with own coordinates. `map` lists the carriers only if
/// one of them follows a modal body.
struct Carriers {
  const Model& model;
  const ElementMap& map;
  const Evaluation& evaluation;

  // For maps that list carriers. Local matrices have six columns (and rows) per carrier, results n, the size of
  // map.coordinates.

  /// Tangent Tᵀ K T + ∂(Tᵀ force)/∂q of a force on the carriers (n x n). K is ∂(force)/∂(local q).
  CarrierMatrix tangent(const LocalMatrix& K, const double* force, CarrierScratch& scratch) const;
  /// Product B T of local rows B, stored in `buffer`.
  CarrierMatrix rows(const LocalMatrix& B, Eigen::VectorXd& buffer) const;
  /// Derivative ∂(B T v)/∂q = N T + B ∂(T v)/∂q of the rates of local rows B, with N = ∂(B v)/∂(local q).
  CarrierMatrix rate_gradient(const LocalMatrix& B, const LocalMatrix& N, CarrierScratch& scratch) const;
  /// Multiplies the columns of rotations by T(θ) of THEORY (3), with the rotation vector θ of the step. Then they
  /// belong to increments of θ.
  void turn_columns(CarrierMatrix& matrix) const;
  /// Computes Ṫ v in `values`, six numbers per carrier: the acceleration of the carrier less T v̇.
  void bias(double* values) const;

  // For all maps, on the single carrier whose columns begin at `first` of local vectors:

  /// Motion T d of the carrier `node` for increments d of all coordinates. Increments of rotations are those of the
  /// rotation vectors of the step.
  template <int D>
  CarrierVector<D> pushed(int node, int first, const Eigen::VectorXd& d) const;
  /// Adds Tᵀ force on one carrier to `result`, in coordinates of the model.
  template <int D>
  void scatter(int first, const CarrierVector<D>& force, Eigen::VectorXd& result) const {
    if (map.carriers.empty())
      scatter_carrier<D>(map.coordinates.data() + first, force, result);
    else
      scatter_through<D>(first, force, result);
  }

 private:
  template <int D>
  void scatter_through(int first, const CarrierVector<D>& force, Eigen::VectorXd& result) const;
};

/// Adds Tᵀ force to the residual. `force`: six numbers per carrier. The share of modal nodes is also added to
/// Evaluation::modal_forces.
void add_pulled_force(const Model& model, const ElementMap& map, const double* force, Evaluation& evaluation);

/// Adds Tᵀ force of one carrier, whose columns begin at `first` of local vectors, to the residual. The share of a modal
/// node is also added to Evaluation::modal_forces.
template <int D>
void add_carrier_force(const Model& model, const ElementMap& map, int first, const CarrierVector<D>& force,
                       Evaluation& evaluation) {
  Carriers{model, map, evaluation}.scatter<D>(first, force, evaluation.residual);
  if (map.carriers.empty()) return;
  if (const int modal = modal_node(model, map.carriers[first / 6]); modal >= 0)
    for (int c = 0; c < force.size(); ++c) evaluation.modal_forces[modal][Space<D>::columns[c]] += force[c];
}

/// Local rows B in the columns of map.coordinates, for maps with and without carriers. Allocates memory, so it is not
/// for the time step.
Eigen::MatrixXd model_rows(const Model& model, const ElementMap& map, const LocalMatrix& B,
                           const Evaluation& evaluation);

/// Matrix T(θ) of THEORY (3), with the rotation vector θ over the step of the node, or of the body that it follows. It
/// is 1 without rotations.
Eigen::Matrix3d step_tangent(const Model& model, const Evaluation& evaluation, int node);

}  // namespace tisserand::mechanism
