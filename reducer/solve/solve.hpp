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

/// Solution of a part on its supports: statics, modes and buckling. Columns of displacements and fields are the load
/// cases of the mesh in order.
struct Solution {
  Mesh mesh;
  System system;
  std::vector<std::string> warnings;
  formats::RigidProperties rigid;
  Partition partition;  ///< partition into held and free coordinates, see Supported
  bool is_free = false;
  LoadVectors loads;
  Statics statics;
  std::optional<SupportedModes> modes;
  std::vector<CaseBuckling> buckling;  ///< buckling of each load case; empty unless requested
  formats::Recovery tables;            ///< mesh and sections, without a superelement
  RecoveredFields fields;              ///< forces and stresses; one state per load case
};

/// Solves a part on its supports. Requires a SolverSession. `begin` receives the phases. Throws Error for any fault of
/// the part, if neither load cases nor modes are requested, and for buckling without load cases or supports.
Solution solve(const formats::Part& part, const SolveRequest& request, const PhaseListener& begin);

/// Solves a mesh with its supports and load cases, as solve() does. `part` gives name, units and the file for
/// messages.
Solution solve_mesh(Mesh mesh, const formats::Part& part, const SolveRequest& request, const PhaseListener& begin);

/// Motions [translation; rotation] of every node for states `q` of the system, in part axes ((6 nodes) x columns).
Eigen::MatrixXd node_motions(const System& system, const Eigen::MatrixXd& q);

/// Index of the longest column, or of the first one whose length is within `round_off` (relative) of the longest. By
/// symmetry there may be several.
Eigen::Index first_longest(const Eigen::Matrix3Xd& columns, double round_off);

}  // namespace tisserand::reducer
