// Bodies of a model that deform, and their deformation as seen from the floating frame.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Bodies that deform are counted superelements first, then modal bodies.
inline std::size_t deforming_bodies(const Model& model) {
  return model.superelements.size() + model.modal_bodies.size();
}
/// Of such a body; -1: it is a superelement.
inline int modal_body_of(const Model& model, std::size_t index) {
  const std::size_t before = model.superelements.size();
  return index < before ? -1 : static_cast<int>(index - before);
}
const std::string& name_of(const Model& model, std::size_t index);
/// deforming_bodies() if there is none of that name.
std::size_t deforming_body(const Model& model, const std::string& name);
/// Numbers of a deformation.
Eigen::Index deformation_size(const Model& model, std::size_t index);

/// In axes of the frame. Of superelements boundary, then internal coordinates; of modal bodies the motion of the frame
/// [d; θ] that goes with the deformation, then w.
struct Deformation {
  Eigen::VectorXd y;
  Eigen::VectorXd rate;  ///< [1/time]
};

/// The y alone.
Eigen::VectorXd y_of(const Model& model, std::size_t index, const Evaluation& now);
/// Of a body where it was evaluated: ẏ = Υ q̇; of modal bodies without motion of the frame.
Deformation deformation_of(const Model& model, std::size_t index, const Evaluation& now);
/// Largest speed of a node that has translations.
double largest_speed(const Model& model, const State& state);

/// Number of the part that each of them is a piece of: welded_beams(), and fixed joints with modal bodies.
std::vector<int> welded_parts(const Model& model);

}  // namespace tisserand::mechanism
