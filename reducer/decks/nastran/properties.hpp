// Property cards of a Nastran deck: from their fields to the rows of properties that elements of the mesh name.
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

/// A row of the mesh's properties, −1: its fault is told.
struct PropertyRow {
  int row = -1;
  double offset = 0.0;  ///< shells: of the middle surface from the reference surface (PCOMP with Z0)
};

/// PELAS with a zero stiffness is allowed, as in the program it comes from.
struct ElasticProperty {
  double stiffness = 0.0;
};

/// PBUSH: stiffness along and about the axes of the bushing.
struct BushProperty {
  Eigen::Matrix<double, 6, 1> stiffness = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Property cards of one kind, and what was read of them.
template <class Read>
struct PropertyCards {
  std::vector<std::string> names;
  std::string kinds;                                  ///< the names in words
  std::map<long, std::size_t> card = {};              ///< id -> row of NastranCards::cards
  std::map<std::pair<long, double>, Read> read = {};  ///< by id and thickness of the element (0: of the card)
};

/// Properties are read when the first element asks for them; what no element uses is not judged.
struct NastranProperties {
  PropertyCards<PropertyRow> beam{{"PBAR", "PBARL", "PBEAM", "PBEAML"}, "PBAR, PBARL, PBEAM or PBEAML"};
  PropertyCards<PropertyRow> rod{{"PROD", "PTUBE"}, "PROD or PTUBE"};
  PropertyCards<PropertyRow> shell{{"PSHELL", "PCOMP"}, "PSHELL or PCOMP"};
  PropertyCards<PropertyRow> solid{{"PSOLID"}, "PSOLID"};
  PropertyCards<std::optional<BushProperty>> bush{{"PBUSH"}, "PBUSH"};
  std::map<long, ElasticProperty> elastic;
};

/// Finds the property cards and reads PELAS; faults for ids that stand twice.
void index_properties(NastranModel& model);

/// Rows for an element with that property; −1 after a fault (told once, a missing card with every element).
int beam_property(NastranModel& model, CardFields& element, long id);
int rod_property(NastranModel& model, CardFields& element, long id);
PropertyRow shell_property(NastranModel& model, CardFields& element, long id, double thickness);
int solid_property(NastranModel& model, CardFields& element, long id);
const BushProperty* bush_property(NastranModel& model, CardFields& element, long id);

/// A rod of these constants as a beam that bends without resistance; -1 after a fault. `card` names the material.
struct RodConstants {
  double area = 0.0;
  double torsion_constant = 0.0;
  double mass_per_length = 0.0;  ///< non-structural
};
int add_rod_property(NastranModel& model, CardFields& card, int material_index, const RodConstants& rod);

/// Used by the above; in files of their own.
int read_beam_property(NastranModel& model, CardFields& card);
PropertyRow read_shell_property(NastranModel& model, CardFields& card, double thickness);

}  // namespace tisserand::reducer
