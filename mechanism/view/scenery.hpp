// SPDX-License-Identifier: GPL-3.0-or-later
// Objects drawn besides bodies: tyres, and the roads on which they roll.
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
  formats::Surface surface;  ///< surface in axes of the frame
};

/// Tyres as rings of their unloaded radius on their wheels, and the strip of each road that its tyres pass, with a
/// margin of a few radii. Empty if the text of the scene or the motion of the wheels is not stored.
std::vector<Scenery> scenery_of(const ViewedRun& run);

/// Contact centres and normals of all tyres, T x 3 tyres; 0 columns if the file has none.
struct TyreContacts {
  Eigen::MatrixXd centre, normal;
};
TyreContacts tyre_contacts(const ViewedRun& run);

/// Contact centre and tyre axes (ISO-W) of a tyre over time; in the air the centre of its wheel. No position: not
/// stored.
Track contact_of(const ViewedRun& run, const TyreContacts& contacts, const formats::SimulatedLink& tyre);

}  // namespace tisserand::mechanism
