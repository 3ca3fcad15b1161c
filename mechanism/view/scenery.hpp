// What is drawn besides bodies: tyres, and the roads that they roll on.
#pragma once

#include <string>
#include <vector>

#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

struct Scenery {
  std::string name;
  std::string kind;    ///< tyre, road
  std::string colour;  ///< #rrggbb
  Track frame;
  formats::Surface surface;  ///< axes of the frame
};

/// Tyres as rings of their unloaded radius on their wheels; of each road the strip that its tyres pass, a few radii
/// beyond their way on every side. None where the text of the scene or the motion of the wheels is not stored.
std::vector<Scenery> scenery_of(const ViewedRun& run);

/// Contact centres and normals of all tyres, T x 3 tyres; of a file without them 0 columns.
struct TyreContacts {
  Eigen::MatrixXd centre, normal;
};
TyreContacts tyre_contacts(const ViewedRun& run);

/// Contact centre and tyre axes (ISO-W) of a tyre over time; in the air its wheel's centre. Without position: not
/// stored.
Track contact_of(const ViewedRun& run, const TyreContacts& contacts, const formats::SimulatedLink& tyre);

}  // namespace tisserand::mechanism
