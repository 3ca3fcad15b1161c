// SPDX-License-Identifier: GPL-3.0-or-later
// Drawn shape of a body, in the axes of its frame, and its deformation.
#pragma once

#include <string>
#include <vector>

#include "formats/page/deformation.hpp"
#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

struct BodyShape {
  std::string source;                ///< recovery, section, scene, inertia, nodes, marker (formats/PAGE.md)
  formats::Surface surface;          ///< undeformed; empty for a marker
  formats::Deformation deformation;  ///< no columns: no deformation
  Eigen::MatrixXd stress;            ///< 6 V x m: [xx yy zz xy yz zx] per amplitude; empty: unknown or not requested
  std::vector<int> elements;         ///< element of each triangle; empty: unknown
  bool points = false;               ///< the vertices are drawn too
  int all_vertices = 0;              ///< number of vertices before thinning
  std::vector<int> stations;         ///< nodes whose motions are the amplitudes, in the order of their columns
  /// Shapes from recovery files: node (−1: internal) and component (0 to 2 translations, 3 to 5 rotations) of each
  /// column.
  std::vector<int> coordinate_node, coordinate_component;
  /// Node number of columns that are no coordinates: second-order strain, static answers to inertia loads.
  static constexpr int beyond = -2;
  std::vector<Eigen::Matrix3d> station_axes;  ///< swept sections: axes at rest, in axes of the node
};

/// Largest number of vertices of one body. More are thinned.
inline constexpr int most_vertices = 50'000;

struct ShapeOptions {
  bool stress = false;                ///< stress of bodies with recovery files
  std::vector<std::string> recovery;  ///< recovery files besides those stored with the superelements
};

/// Shape of a body. Notes go to the run. Throws Error: wrong shape files, recovery files of another superelement.
BodyShape shape_of_body(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options);

}  // namespace tisserand::mechanism
