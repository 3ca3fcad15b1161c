// SPDX-License-Identifier: GPL-3.0-or-later
// Drawn shape of a body, in the axes of its frame, and its deformation.
#pragma once

#include <string>
#include <vector>

#include "formats/page/deformation.hpp"
#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Drawn shape of a body in the axes of its frame, its deformation, and what the deformation depends on.
struct BodyShape {
  /// Source of the shape: recovery, section, scene, inertia, nodes, marker (formats/PAGE.md).
  std::string source;
  formats::Surface surface;          ///< undeformed surface; empty for a marker
  formats::Deformation deformation;  ///< shapes and amplitudes of the deformation; no columns: rigid
  /// Stress [xx yy zz xy yz zx] of each vertex per amplitude (6 V x m); empty: unknown or not requested.
  Eigen::MatrixXd stress;
  std::vector<int> elements;  ///< element of each triangle; empty: unknown
  bool points = false;        ///< whether the vertices are drawn too
  int all_vertices = 0;       ///< number of vertices before thinning
  std::vector<int> stations;  ///< nodes whose motions are the amplitudes, in the order of their columns
  /// For shapes from recovery files: node (−1: internal) and component of each column of the deformation. Components 0
  /// to 2 are translations, 3 to 5 rotations.
  std::vector<int> coordinate_node, coordinate_component;
  /// Value in `coordinate_node` for columns that are no coordinates: second-order strain, static answers to inertia
  /// loads.
  static constexpr int beyond = -2;
  /// For sections swept along a line: axes at rest at each station, in axes of its node.
  std::vector<Eigen::Matrix3d> station_axes;
};

/// Largest number of vertices of one body. A surface with more is thinned.
inline constexpr int most_vertices = 50'000;

/// Options of the shapes of bodies.
struct ShapeOptions {
  bool stress = false;                ///< also read the stress of bodies with recovery files
  std::vector<std::string> recovery;  ///< recovery files besides those stored with the superelements
};

/// Shape of a body. Adds notes to the run. Throws Error for wrong shape files, and for recovery files of another
/// superelement.
BodyShape shape_of_body(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options);

}  // namespace tisserand::mechanism
