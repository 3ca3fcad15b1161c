// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of a part or mesh file: names and numbers by which part.yaml can refer to them, and the forms of its faces.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/faces/face_facts.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Face of a geometry, mesh or patch, or a group or set that has faces, with its cells and its form.
struct SurveyedFace {
  std::string name;   ///< "face 12", "face 12 ('top')", or the name of the group, set or patch
  std::string label;  ///< label in pictures: "12", or the name
  FaceCells cells;
  FaceFacts facts;
};

/// Contents of a part or mesh file, as `reducer groups` lists and draws them.
struct Survey {
  std::string text;  ///< tables of entities, groups and sets with sizes and boxes, and of the forms of faces
  Units units;
  std::vector<Eigen::Vector3d> position;  ///< positions of the nodes of all cells
  std::vector<SurveyedFace> faces;        ///< faces that have numbers or are patches
  std::vector<SurveyedFace> groups;       ///< groups of faces
  Mesh deck;                              ///< elements of a deck, whose nodes are rows of `position`
};

/// Surveys a part or mesh file: the names and numbers by which part.yaml can refer to its contents, and the forms of
/// its faces. Geometry is meshed coarsely unless the part defines the sizes. Areas and middles of faces come from
/// OpenCASCADE if it made the geometry, otherwise from the mesh.
Survey survey(const formats::Part& part);

/// Makes a part that consists of a mesh or geometry file only, in its own units.
formats::Part part_of_file(const std::string& file);

/// Makes a copy of the part in which a geometry is meshed finely enough to follow curved faces. Sizes that the part
/// defines stay.
formats::Part finely_meshed(const formats::Part& part);

/// Form of a face in words, such as "cylinder, concave, radius 4 mm".
std::string form_text(const FaceFacts& facts, const Units& units);

}  // namespace tisserand::reducer
