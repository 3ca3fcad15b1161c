// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of a model that deform, and their deformation relative to the floating frame.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Number of deforming bodies. The index of a deforming body counts superelements first, then modal bodies.
inline std::size_t deforming_bodies(const Model& model) {
  return model.superelements.size() + model.modal_bodies.size();
}
/// Index of the modal body that is the deforming body `index`; -1: that body is a superelement.
inline int modal_body_of(const Model& model, std::size_t index) {
  const std::size_t before = model.superelements.size();
  return index < before ? -1 : static_cast<int>(index - before);
}
/// Name of the deforming body `index`.
const std::string& name_of(const Model& model, std::size_t index);
/// Index of the deforming body with this name; deforming_bodies() if there is none.
std::size_t deforming_body(const Model& model, const std::string& name);
/// Number of coordinates of the deformation of body `index`.
Eigen::Index deformation_size(const Model& model, std::size_t index);

/// Deformation y of a body and its rate, in axes of the floating frame. For a superelement y holds boundary, then
/// internal coordinates, THEORY (6). For a modal body it holds the motion [d; θ] of the frame that belongs to the
/// deformation, then the modal coordinates w.
struct Deformation {
  Eigen::VectorXd y;
  Eigen::VectorXd rate;  ///< rate ẏ of the deformation [y/time]
};

/// Deformation y of body `index` at the evaluated state, without its rate.
Eigen::VectorXd y_of(const Model& model, std::size_t index, const Evaluation& now);
/// Deformation of body `index` and its rate at the evaluated state. For superelements ẏ = Υ q̇, THEORY (23). For modal
/// bodies the motion of the frame is zero.
Deformation deformation_of(const Model& model, std::size_t index, const Evaluation& now);
/// Largest speed of a node that has translations.
double largest_speed(const Model& model, const State& state);

/// Number of the welded part to which each deforming body belongs. Bodies with one number are welded together, by
/// welded_beams() or by fixed joints with modal bodies.
std::vector<int> welded_parts(const Model& model);

}  // namespace tisserand::mechanism
