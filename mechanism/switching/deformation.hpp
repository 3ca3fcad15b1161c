// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of a model that deform, and their deformation relative to the floating frame.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Number of deforming bodies. Indices count superelements first, then modal bodies.
inline std::size_t deforming_bodies(const Model& model) {
  return model.superelements.size() + model.modal_bodies.size();
}
/// Index of the modal body of a deforming body; -1: it is a superelement.
inline int modal_body_of(const Model& model, std::size_t index) {
  const std::size_t before = model.superelements.size();
  return index < before ? -1 : static_cast<int>(index - before);
}
const std::string& name_of(const Model& model, std::size_t index);
/// Index of the deforming body of that name; deforming_bodies() if there is none.
std::size_t deforming_body(const Model& model, const std::string& name);
/// Number of coordinates of a deformation.
Eigen::Index deformation_size(const Model& model, std::size_t index);

/// Deformation in axes of the frame. Superelement: boundary, then internal coordinates. Modal body: the motion [d; θ]
/// of the frame that belongs to the deformation, then w.
struct Deformation {
  Eigen::VectorXd y;
  Eigen::VectorXd rate;  ///< [1/time]
};

/// Deformation y at the evaluated state, without its rate.
Eigen::VectorXd y_of(const Model& model, std::size_t index, const Evaluation& now);
/// Deformation of a body at the evaluated state: ẏ = Υ q̇; for modal bodies without motion of the frame.
Deformation deformation_of(const Model& model, std::size_t index, const Evaluation& now);
/// Largest speed of a node that has translations.
double largest_speed(const Model& model, const State& state);

/// Number of the welded part of each deforming body: by welded_beams(), and by fixed joints with modal bodies.
std::vector<int> welded_parts(const Model& model);

}  // namespace tisserand::mechanism
