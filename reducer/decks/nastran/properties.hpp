// SPDX-License-Identifier: GPL-3.0-or-later
// Property cards of a Nastran deck: rows of properties of the mesh from their fields.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

struct NastranModel;
class CardFields;

/// Row of the mesh's properties; −1 after a fault.
struct PropertyRow {
  int row = -1;
  double offset = 0.0;  ///< shells: offset of the middle surface from the reference surface (PCOMP with Z0)
};

/// PELAS. Zero stiffness is permitted, as in the original program.
struct ElasticProperty {
  double stiffness = 0.0;
};

/// PBUSH: stiffness along and about the axes of the bushing.
struct BushProperty {
  Eigen::Matrix<double, 6, 1> stiffness = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Property cards of one kind, and the results of reading them.
template <class Read>
struct PropertyCards {
  std::vector<std::string> names;
  std::string kinds;                                  ///< their names in words
  std::map<long, std::size_t> card = {};              ///< key: id, value: index in NastranCards::cards
  std::map<std::pair<long, double>, Read> read = {};  ///< key: id and thickness of the element (0: that of the card)
};

/// Properties. They are read when the first element needs them, so unused ones are not checked.
struct NastranProperties {
  PropertyCards<PropertyRow> beam{{"PBAR", "PBARL", "PBEAM", "PBEAML"}, "PBAR, PBARL, PBEAM or PBEAML"};
  PropertyCards<PropertyRow> rod{{"PROD", "PTUBE"}, "PROD or PTUBE"};
  PropertyCards<PropertyRow> shell{{"PSHELL", "PCOMP"}, "PSHELL or PCOMP"};
  PropertyCards<PropertyRow> solid{{"PSOLID"}, "PSOLID"};
  PropertyCards<std::optional<BushProperty>> bush{{"PBUSH"}, "PBUSH"};
  std::map<long, ElasticProperty> elastic;
};

/// Finds the property cards and reads PELAS; faults for duplicate ids.
void index_properties(NastranModel& model);

/// Rows for an element with this property; −1 after a fault (added once; a missing card for every element).
int beam_property(NastranModel& model, CardFields& element, long id);
int rod_property(NastranModel& model, CardFields& element, long id);
PropertyRow shell_property(NastranModel& model, CardFields& element, long id, double thickness);
int solid_property(NastranModel& model, CardFields& element, long id);
const BushProperty* bush_property(NastranModel& model, CardFields& element, long id);

/// A rod of these constants as a beam without bending stiffness; -1 after a fault. `card` names the material.
struct RodConstants {
  double area = 0.0;
  double torsion_constant = 0.0;
  double mass_per_length = 0.0;  ///< non-structural
};
int add_rod_property(NastranModel& model, CardFields& card, int material_index, const RodConstants& rod);

/// Called by the functions above; in files of their own.
int read_beam_property(NastranModel& model, CardFields& card);
PropertyRow read_shell_property(NastranModel& model, CardFields& card, double thickness);

}  // namespace tisserand::reducer
