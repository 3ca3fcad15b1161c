// SPDX-License-Identifier: GPL-3.0-or-later
// M, C and K from three tangents with one unit coefficient each.
#include "mechanism/radau/tangent_parts.hpp"

namespace tisserand::mechanism::radau {
namespace {

constexpr TangentCoefficients unit[] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

}  // namespace

TangentParts::TangentParts(const Model& of_model) : model(of_model), buffer(of_model) {
  const SparsePattern& pattern = *model.pattern;
  for (std::vector<double>& part : values) part.assign(static_cast<std::size_t>(pattern.values()), 0.0);
  place.assign(values[0].size(), Place::block);
  for (int j = 0; j < pattern.size(); ++j)
    pattern.for_each_in(j, [&](int i, int slot) {
      if (j >= model.sizes.boundary)
        place[slot] = Place::column;
      else if (i >= model.sizes.boundary)
        place[slot] = Place::row;
    });
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const Eigen::Index nb = body_of(model, i).boundary_size, m = body_of(model, i).modes;
    Element element;
    for (std::size_t k = 0; k < 3; ++k) {
      element.BB[k].setZero(nb, nb);
      element.BI[k].setZero(nb, m);
      element.IB[k].setZero(m, nb);
    }
    elements.push_back(element);
  }
  orientation.assign(model.nodes.size(), Eigen::Matrix3d::Identity());
}

void TangentParts::take(const State& state, Evaluation& evaluation) {
  for (std::size_t k = 0; k < 3; ++k) {
    TangentRequest request{unit[k], TangentKind::step, {}};
    if (unit[k].stiffness != 0.0) request.rows = {ConstraintRows::Kind::velocity, 1.0};
    evaluate_tangent_without_superelements(model, state, request, evaluation, buffer);
    for (std::size_t slot = 0; slot < place.size(); ++slot)
      values[k][slot] = (place[slot] == Place::block ? buffer.scale : 1.0) * buffer.values[slot];
    for (std::size_t i = 0; i < elements.size(); ++i) {
      SuperelementScratch& scratch = evaluation.superelements[i];
      SuperelementWork& work = work_of(model, i, evaluation);
      scratch.tangent.A_BI.resize(body_of(model, i).boundary_size, body_of(model, i).modes);
      scratch.tangent.A_IB.resize(body_of(model, i).modes, body_of(model, i).boundary_size);
      kept_tangent(body_of(model, i), unit[k], scratch, work);
      elements[i].BB[k] = work.A_BB;
      elements[i].BI[k] = scratch.tangent.A_BI;
      elements[i].IB[k] = scratch.tangent.A_IB;
    }
  }
  ++evaluation.tangents;
  for (std::size_t i = 0; i < orientation.size(); ++i) orientation[i] = evaluation.motion[i].R;
  valid = true;
}

void TangentParts::multiply(const Eigen::VectorXd& x_m, const Eigen::VectorXd& x_c, const Eigen::VectorXd& x_b,
                            Eigen::VectorXd& upper, Eigen::VectorXd& rows) const {
  const int n = model.sizes.boundary;
  for (int j = 0; j < n; ++j)
    model.pattern->for_each_in(j, [&](int i, int slot) {
      if (i < n)
        upper[i] += values[0][slot] * x_m[j] + values[1][slot] * x_c[j];
      else
        rows[i - n] += values[0][slot] * x_b[j];
    });
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const SuperelementBody& body = body_of(model, e);
    const std::vector<int>& map = model.superelements.maps[e].coordinates;
    const int first = n + model.internal_offset[e];
    for (std::size_t k = 0; k < 2; ++k) {
      const Eigen::VectorXd& x = k == 0 ? x_m : x_c;
      const Element& element = elements[e];
      for (int j = 0; j < body.boundary_size; ++j) {
        if (map[j] < 0) continue;
        for (int i = 0; i < body.boundary_size; ++i)
          if (map[i] >= 0) upper[map[i]] += element.BB[k](i, j) * x[map[j]];
        for (int i = 0; i < body.modes; ++i) upper[first + i] += element.IB[k](i, j) * x[map[j]];
      }
      for (int j = 0; j < body.modes; ++j)
        for (int i = 0; i < body.boundary_size; ++i)
          if (map[i] >= 0) upper[map[i]] += element.BI[k](i, j) * x[first + j];
    }
    for (int k = 0; k < body.modes; ++k) upper[first + k] += x_m[first + k] + body.damping.internal[k] * x_c[first + k];
    if (body.damping.is_full() && body.modes > 0)
      upper.segment(first, body.modes) += body.damping.II.lazyProduct(x_c.segment(first, body.modes));
  }
}

}  // namespace tisserand::mechanism::radau
