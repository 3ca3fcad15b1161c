// Carriers: what acts on nodes of modal bodies, which own no coordinates, in the coordinates of their bodies.
//
// Joints, coordinates and loads know six coordinates per carrier. Where one of the carriers follows a modal body their
// map lists the carriers, and everything goes through T of each: [ẋ; Ω] = T [ṙ ω ẇ], 6 x (6 + m), the unit matrix for
// other nodes. Maps without such a carrier list none and take the short way.
#pragma once

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/model/element_map.hpp"

namespace tisserand::mechanism {

/// Buffers for any pair of carriers of the model.
CarrierScratch make_carrier_scratch(const Model& model);

/// A result in one of the buffers, and a matrix of fixed size or a row that is handed over without a copy.
using CarrierMatrix = Eigen::Map<Eigen::MatrixXd>;
using LocalMatrix = Eigen::Map<const Eigen::MatrixXd>;
template <class Matrix>
LocalMatrix local_view(const Matrix& m) {
  return {m.data(), m.rows(), m.cols()};
}

/// The carriers of a joint, a coordinate or a force element, which its map lists if one of them follows a modal body,
/// and their motion.
struct Carriers {
  const Model& model;
  const ElementMap& map;
  const Evaluation& evaluation;

  // For maps that list carriers; local matrices have six columns (and rows) per carrier, results n = size of
  // map.coordinates.

  /// Tᵀ K T + ∂(Tᵀ force)/∂q, n x n: the tangent of a force that the carriers receive.
  CarrierMatrix tangent(const LocalMatrix& K, const double* force, CarrierScratch& scratch) const;
  /// B T, in `buffer`.
  CarrierMatrix rows(const LocalMatrix& B, Eigen::VectorXd& buffer) const;
  /// ∂(B T v)/∂q = N T + B ∂(T v)/∂q for N = ∂(B v)/∂(local q).
  CarrierMatrix rate_gradient(const LocalMatrix& B, const LocalMatrix& N, CarrierScratch& scratch) const;
  /// Multiplies the columns of turns with T(displacement of the step): rows for increments of rotation vectors.
  void turn_columns(CarrierMatrix& matrix) const;
  /// Ṫ v, six numbers per carrier: what the carriers' accelerations have besides T v̇.
  void bias(double* values) const;

  // For all maps, and of the carrier alone whose columns begin at `first` of local vectors:

  /// T d for the increments d of all coordinates, turns as increments of the rotation vectors of the step.
  template <int D>
  CarrierVector<D> pushed(int node, int first, const Eigen::VectorXd& d) const;
  /// result += Tᵀ force.
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

/// Adds Tᵀ force to the residual, six numbers per carrier; modal nodes keep what they got (Evaluation::modal_forces).
void add_pulled_force(const Model& model, const ElementMap& map, const double* force, Evaluation& evaluation);

/// The same of the carrier whose columns begin at `first`.
template <int D>
void add_carrier_force(const Model& model, const ElementMap& map, int first, const CarrierVector<D>& force,
                       Evaluation& evaluation) {
  Carriers{model, map, evaluation}.scatter<D>(first, force, evaluation.residual);
  if (map.carriers.empty()) return;
  if (const int modal = modal_node(model, map.carriers[first / 6]); modal >= 0)
    for (int c = 0; c < force.size(); ++c) evaluation.modal_forces[modal][Space<D>::columns[c]] += force[c];
}

/// B in the columns of map.coordinates, for maps with and without carriers; takes memory: not for the step.
Eigen::MatrixXd model_rows(const Model& model, const ElementMap& map, const LocalMatrix& B,
                           const Evaluation& evaluation);

/// T(dΘ) of the rotation that a node owns, or the body it follows, over the step; 1 for ground and where nothing
/// turned.
Eigen::Matrix3d step_tangent(const Model& model, const Evaluation& evaluation, int node);

}  // namespace tisserand::mechanism
