// SPDX-License-Identifier: GPL-3.0-or-later
// Objects drawn besides bodies: tyres, and the roads on which they roll.
#pragma once

#include <string>
#include <vector>

#include "formats/page/surface.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Object of a run that is drawn besides the bodies: a tyre or a road.
struct Scenery {
  std::string name;
  std::string kind;          ///< "tyre" or "road"
  std::string colour;        ///< colour as #rrggbb
  Track frame;               ///< motion of the frame
  formats::Surface surface;  ///< surface in axes of the frame
};

/// Tyres and roads of a run. A tyre is a ring of its unloaded radius on its wheel. A road is the strip that its tyres
/// pass, with a margin of a few radii. Empty if the text of the scene or the motion of the wheels is not stored.
std::vector<Scenery> scenery_of(const ViewedRun& run);

/// Contact centres and road normals of all tyres over the T instants (T x 3 tyres). No columns: the file has none.
struct TyreContacts {
  Eigen::MatrixXd centre, normal;
};
/// Reads the contacts of all tyres of a run.
TyreContacts tyre_contacts(const ViewedRun& run);

/// Motion of the contact centre and of the tyre axes (ISO-W) of a tyre over time. In the air it is the centre of the
/// wheel. Without a position it is not stored.
Track contact_of(const ViewedRun& run, const TyreContacts& contacts, const formats::SimulatedLink& tyre);

}  // namespace tisserand::mechanism
