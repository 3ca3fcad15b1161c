// SPDX-License-Identifier: GPL-3.0-or-later
// Combination of the parts, condensation, scaling.
#include "mechanism/radau/stage_matrix.hpp"

#include <algorithm>

namespace tisserand::mechanism::radau {

template <class Scalar>
StageMatrix<Scalar>::StageMatrix(const Model& model)
    : values_(static_cast<std::size_t>(model.pattern->values())),
      unknowns_(Vector::Zero(model.pattern->size())),
      solver_(*model.pattern, model.solver.kind) {
  Eigen::Index most = 0, widest = 0;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const Eigen::Index nb = body.boundary_size, m = body.modes;
    Element element;
    element.BI.setZero(nb, m);
    element.eliminated.setZero(m, nb);
    element.condensed.setZero(nb, nb);
    element.inverse_II.setZero(m);
    if (body.damping.is_full()) {
      element.full_II.setIdentity(m, m);
      element.IB.setZero(m, nb);
      element.lu = Eigen::PartialPivLU<Matrix>(element.full_II);
    }
    elements_.push_back(element);
    most = std::max(most, m);
    widest = std::max(widest, nb);
  }
  internal_.setZero(most);
  boundary_.setZero(widest);
}

template <class Scalar>
void StageMatrix<Scalar>::condense(const SuperelementBody& body, const TangentParts::Element& parts, Scalar omega,
                                   Element& element) {
  const Scalar square = omega * omega;
  const auto combine = [&](const std::array<Eigen::MatrixXd, 3>& part, Matrix& sum) {
    sum = square * part[0].template cast<Scalar>() + omega * part[1].template cast<Scalar>() +
          part[2].template cast<Scalar>();
  };
  combine(parts.BB, element.condensed);
  if (body.modes == 0) return;
  combine(parts.BI, element.BI);
  combine(parts.IB, element.eliminated);
  for (Eigen::Index k = 0; k < body.modes; ++k)
    element.inverse_II[k] = square + omega * body.damping.internal[k] + body.S_II[k];
  if (body.damping.is_full()) {
    element.full_II = omega * body.damping.II.template cast<Scalar>();
    element.full_II.diagonal() += element.inverse_II;
    element.lu.compute(element.full_II);
    element.IB = element.eliminated;
    element.eliminated = element.lu.solve(element.IB);
  } else {
    element.inverse_II = element.inverse_II.cwiseInverse();
    element.eliminated = element.inverse_II.asDiagonal() * element.eliminated;
  }
  for (Eigen::Index j = 0; j < body.boundary_size; ++j)
    for (Eigen::Index k = 0; k < body.modes; ++k)
      element.condensed.col(j) -= element.BI.col(k) * element.eliminated(k, j);
}

template <class Scalar>
FactorReport StageMatrix<Scalar>::factor(const Model& model, const TangentParts& parts, Scalar omega) {
  const Scalar square = omega * omega, rate = 1.0 / omega;
  scale_ = std::norm(omega) * model.mass_scale + model.stiffness_scale;
  if (!(scale_ > 0.0)) scale_ = 1.0;
  const auto& [M, C, K] = parts.values;
  for (std::size_t slot = 0; slot < values_.size(); ++slot) switch (parts.place[slot]) {
      case TangentParts::Place::block:
        values_[slot] = (square * M[slot] + omega * C[slot] + K[slot]) / scale_;
        break;
      case TangentParts::Place::column:
        values_[slot] = M[slot];
        break;
      case TangentParts::Place::row:
        values_[slot] = M[slot] + rate * (K[slot] - M[slot]);
        break;
    }
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    condense(body_of(model, i), parts.elements[i], omega, elements_[i]);
    const Scalar* entry = elements_[i].condensed.data();
    for (const int slot : model.superelements.maps[i].slots) {
      if (slot >= 0) values_[slot] += *entry / scale_;
      ++entry;
    }
  }
  for (std::size_t slot = 0; slot < values_.size(); ++slot)
    values_[slot] *= model.value_scale[static_cast<Eigen::Index>(slot)];
  return solver_.numeric(values_);
}

template <class Scalar>
void StageMatrix<Scalar>::solve(const Model& model, const Eigen::VectorXd& active, Vector& upper, Vector& rows) {
  const int n = model.sizes.boundary, constraints = model.sizes.constraints;
  unknowns_.head(n) = upper.head(n);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    Element& element = elements_[i];
    auto f = upper.segment(n + model.internal_offset[i], body.modes);
    if (body.modes == 0) continue;
    auto solution = internal_.head(body.modes);
    if (body.damping.is_full()) {
      solution = element.lu.solve(f);
      f = solution;
    } else {
      f.array() *= element.inverse_II.array();
    }
    const std::vector<int>& map = model.superelements.maps[i].coordinates;
    for (int k = 0; k < body.modes; ++k)
      for (int j = 0; j < body.boundary_size; ++j)
        if (map[j] >= 0) unknowns_[map[j]] -= element.BI(j, k) * f[k];
  }
  unknowns_.head(n) /= scale_;
  unknowns_.tail(constraints) = rows.cwiseProduct(active.template cast<Scalar>());
  unknowns_.array() *= model.equation_scale.template cast<Scalar>();
  solver_.solve({unknowns_.data(), static_cast<std::size_t>(unknowns_.size())});
  unknowns_.array() *= model.equation_scale.template cast<Scalar>();
  upper.head(n) = unknowns_.head(n);
  rows = scale_ * unknowns_.tail(constraints);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const std::vector<int>& map = model.superelements.maps[i].coordinates;
    for (int j = 0; j < body.boundary_size; ++j)
      if (map[j] >= 0)
        upper.segment(n + model.internal_offset[i], body.modes) -= elements_[i].eliminated.col(j) * unknowns_[map[j]];
  }
}

template class StageMatrix<double>;
template class StageMatrix<std::complex<double>>;

}  // namespace tisserand::mechanism::radau
