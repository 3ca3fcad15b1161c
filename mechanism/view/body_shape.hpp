// What is drawn of a body, in the axes of its frame, and how it deforms.
#pragma once

#include <string>
#include <vector>

#include "formats/page/deformation.hpp"
#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

struct BodyShape {
  std::string source;                ///< recovery, section, scene, inertia, nodes, marker (formats/PAGE.md)
  formats::Surface surface;          ///< undeformed; of a marker: empty
  formats::Deformation deformation;  ///< without columns: none
  Eigen::MatrixXd stress;            ///< 6 V x m: [xx yy zz xy yz zx] per amplitude; empty: not known or not asked for
  std::vector<int> elements;         ///< of each triangle; empty: not known
  bool points = false;               ///< the vertices are drawn too
  int all_vertices = 0;              ///< before thinning
  std::vector<int> stations;         ///< nodes whose motion the amplitudes are, in the order of their columns
  /// Of shapes from recovery files: node (−1: internal) and component (0 to 2 translations, 3 to 5 rotations) of each
  /// column.
  std::vector<int> coordinate_node, coordinate_component;
  /// Node of columns that are no coordinates: second-order strain, answers to inertia loads.
  static constexpr int beyond = -2;
  std::vector<Eigen::Matrix3d> station_axes;  ///< of swept sections: at rest, in axes of the node
};

/// The most vertices of one body: more are thinned.
inline constexpr int most_vertices = 50'000;

struct ShapeOptions {
  bool stress = false;                ///< of bodies with recovery files
  std::vector<std::string> recovery;  ///< recovery files beside those that lie beside the superelements
};

/// Notes go to the run. Throws Error: files of shapes, recovery files of another superelement.
BodyShape shape_of_body(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options);

}  // namespace tisserand::mechanism
