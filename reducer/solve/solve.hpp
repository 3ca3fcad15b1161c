// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer solve`: statics, modes and buckling of the unreduced part on its supports.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/recover/stresses.hpp"
#include "reducer/report/phase_listener.hpp"
#include "reducer/solve/buckling.hpp"
#include "reducer/solve/request.hpp"
#include "reducer/solve/statics.hpp"
#include "reducer/solve/supported_modes.hpp"

namespace tisserand::reducer {

/// Solution of a part. Columns of displacements and fields are the load cases of the mesh in order.
struct Solution {
  Mesh mesh;
  System system;
  std::vector<std::string> warnings;
  formats::RigidProperties rigid;
  Partition partition;  ///< Supported::partition
  bool is_free = false;
  LoadVectors loads;
  Statics statics;
  std::optional<SupportedModes> modes;
  std::vector<CaseBuckling> buckling;  ///< one per load case; empty unless requested
  formats::Recovery tables;            ///< mesh and sections, without a superelement
  RecoveredFields fields;              ///< one state per load case
};

/// Solves a part. Needs a SolverSession; `begin` receives the phases. Throws Error for any fault of the part, if
/// neither load cases nor modes are requested, and for buckling without load cases or supports.
Solution solve(const formats::Part& part, const SolveRequest& request, const PhaseListener& begin);

/// Solves a mesh with its supports and load cases; `part` gives name, units and the file for messages.
Solution solve_mesh(Mesh mesh, const formats::Part& part, const SolveRequest& request, const PhaseListener& begin);

/// Motions [translation; rotation] of every node for states q of the system: (6 nodes) x columns, part axes.
Eigen::MatrixXd node_motions(const System& system, const Eigen::MatrixXd& q);

/// First of the columns of largest norm within `round_off` of it: by symmetry there may be several.
Eigen::Index first_longest(const Eigen::Matrix3Xd& columns, double round_off);

}  // namespace tisserand::reducer
