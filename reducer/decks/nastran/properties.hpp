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

/// Index of a property in its vector of the mesh; −1 after a fault.
struct PropertyRow {
  int row = -1;
  double offset = 0.0;  ///< shells: offset of the middle surface from the reference surface (PCOMP with Z0)
};

/// Spring stiffness of PELAS. Zero is permitted, as in Nastran.
struct ElasticProperty {
  double stiffness = 0.0;
};

/// Stiffness of PBUSH along the axes of the bushing (3) and about them (3).
struct BushProperty {
  Eigen::Matrix<double, 6, 1> stiffness = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Property cards of one kind of element, and the properties read from them so far.
template <class Read>
struct PropertyCards {
  std::vector<std::string> names;
  std::string kinds;                      ///< names of the cards in words, for messages
  std::map<long, std::size_t> card = {};  ///< key: id, value: index in NastranCards::cards
  /// Properties read so far. The key is the id of the property and the thickness of the element (0: that of the card).
  std::map<std::pair<long, double>, Read> read = {};
};

/// Properties of a deck. A property is read when the first element needs it, so unused ones are not checked.
struct NastranProperties {
  PropertyCards<PropertyRow> beam{{"PBAR", "PBARL", "PBEAM", "PBEAML"}, "PBAR, PBARL, PBEAM or PBEAML"};
  PropertyCards<PropertyRow> rod{{"PROD", "PTUBE"}, "PROD or PTUBE"};
  PropertyCards<PropertyRow> shell{{"PSHELL", "PCOMP"}, "PSHELL or PCOMP"};
  PropertyCards<PropertyRow> solid{{"PSOLID"}, "PSOLID"};
  PropertyCards<std::optional<BushProperty>> bush{{"PBUSH"}, "PBUSH"};
  std::map<long, ElasticProperty> elastic;
};

/// Finds the property cards, reads PELAS, and adds faults for duplicate ids.
void index_properties(NastranModel& model);

/// Index in Mesh::beam_properties of the property `id` for a beam; −1 after a fault. A fault of the property card is
/// added once, a missing card for every element. The next functions do this for other kinds of elements.
int beam_property(NastranModel& model, CardFields& element, long id);
int rod_property(NastranModel& model, CardFields& element, long id);
PropertyRow shell_property(NastranModel& model, CardFields& element, long id, double thickness);
int solid_property(NastranModel& model, CardFields& element, long id);
const BushProperty* bush_property(NastranModel& model, CardFields& element, long id);

/// Constants of a rod, which becomes a beam without bending stiffness.
struct RodConstants {
  double area = 0.0;
  double torsion_constant = 0.0;
  double mass_per_length = 0.0;  ///< non-structural mass per length
};
/// Adds the property of a rod to Mesh::beam_properties and returns its index; −1 after a fault. `material_index`:
/// field of `card` with the id of the material.
int add_rod_property(NastranModel& model, CardFields& card, int material_index, const RodConstants& rod);

/// Reads the card of a beam property for beam_property(), and returns its index; −1 after a fault.
int read_beam_property(NastranModel& model, CardFields& card);
PropertyRow read_shell_property(NastranModel& model, CardFields& card, double thickness);

}  // namespace tisserand::reducer
