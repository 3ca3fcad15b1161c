// What a part or mesh file consists of: the names and numbers by which part.yaml can refer to it, and the forms of its
// faces.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/faces/face_facts.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// A face of a geometry, mesh or patch, or a group or set that has faces.
struct SurveyedFace {
  std::string name;   ///< "face 12", "face 12 ('top')", or that of the group, set or patch
  std::string label;  ///< "12", or the name
  FaceCells cells;
  FaceFacts facts;
};

struct Survey {
  std::string text;  ///< tables of entities, groups and sets with sizes and boxes, and of the forms of faces
  Units units;
  std::vector<Eigen::Vector3d> position;  ///< of the nodes of all cells
  std::vector<SurveyedFace> faces;        ///< that have numbers or are patches
  std::vector<SurveyedFace> groups;       ///< of faces
  Mesh deck;                              ///< elements of a deck, whose nodes are rows of `position`
};

/// Geometry is meshed coarsely, unless the part says how; areas and middles of its faces are those of OpenCASCADE where
/// it made them, all others those of the mesh.
Survey survey(const formats::Part& part);

/// A part that consists of a mesh or geometry file alone, in its own units.
formats::Part part_of_file(const std::string& file);

/// The part with a mesh of its geometry that follows curved faces, unless it says how to mesh it.
formats::Part finely_meshed(const formats::Part& part);

/// "cylinder, concave, radius 4 mm": the form of a face in words.
std::string form_text(const FaceFacts& facts, const Units& units);

}  // namespace tisserand::reducer
