// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a scene that must not change what it does.
#pragma once

#include <string>

#include "tests/support/crossings/similarity.hpp"

namespace tisserand::test_support::crossings {

enum class Change {
  turned,     ///< about an axis that is none of the scene
  mirrored,   ///< at a plane that is none of the scene
  units,      ///< mm, t, ms
  far,        ///< 1 km from the origin
  delayed,    ///< begins at t = 10 s
  together,   ///< all of these but for a smaller distance
  reordered,  ///< bodies, joints and forces in the opposite order
  bystander,  ///< another body that nothing joins to the rest
  dense,      ///< linear solver
  umfpack,
  kept,       ///< virtual bodies are kept
  part_frame  ///< rigid and virtual bodies in other axes of their own
};

inline constexpr int changes = 12;
std::string name_of(Change change);

/// What the change means for the numbers of the results.
Similarity similarity_of(Change change);
formats::Scene changed(const formats::Scene& scene, Change change);

}  // namespace tisserand::test_support::crossings
