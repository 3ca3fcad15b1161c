// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates of a node in velocity vectors: three translations and three rotations; in planar models two and one.
// Missing components are zero.
#pragma once

#include <Eigen/Core>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

inline int translations_of(const Model& model) { return model.planar ? 2 : 3; }
inline int rotations_of(const Model& model) { return model.planar ? 1 : 3; }

/// Translation in `v` (world axes) whose first coordinate is `first`. In planar models z is 0.
template <class Vector>
Eigen::Vector3d translation_at(const Model& model, const Vector& v, int first) {
  return {v[first], v[first + 1], model.planar ? 0.0 : v[first + 2]};
}

/// Rotation in `v` (material axes) whose first coordinate is `first`. In planar models x and y are 0.
template <class Vector>
Eigen::Vector3d rotation_at(const Model& model, const Vector& v, int first) {
  if (model.planar) return {0.0, 0.0, v[first]};
  return {v[first], v[first + 1], v[first + 2]};
}

template <class Vector>
void set_translation(const Model& model, const Eigen::Vector3d& value, int first, Vector&& v) {
  for (int k = 0; k < translations_of(model); ++k) v[first + k] = value[k];
}

template <class Vector>
void set_rotation(const Model& model, const Eigen::Vector3d& value, int first, Vector&& v) {
  if (model.planar)
    v[first] = value.z();
  else
    for (int k = 0; k < 3; ++k) v[first + k] = value[k];
}

/// Velocity coordinate of component `k` (0 to 5) of [ẋ Ω] of a node, −1 if the node does not own it.
inline int coordinate_of(const Model& model, const Node& node, int k) {
  const int first = k < 3 ? node.translation : node.rotation;
  if (first < 0) return -1;
  if (!model.planar) return first + k % 3;
  return k < 2 ? first + k : k == 5 ? first : -1;
}

}  // namespace tisserand::mechanism
