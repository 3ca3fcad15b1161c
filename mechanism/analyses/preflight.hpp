// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a scene before it moves: open joints, connected groups, undetermined motions, doubtful masses.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "mechanism/equations/mobility.hpp"

namespace tisserand::mechanism {

/// Gap of a joint, a coupling or an initial value. `length` is the gap along the directions that the joint constrains.
/// `angle` is the largest residual of its other equations [rad, or cosine of two axes].
struct JointGap {
  std::string joint;
  double length = 0.0;
  double angle = 0.0;
};

/// Text "'crank' by 0.1 m and 0.02 rad, 'slider' by ..." of gaps. `unit`: label that follows each length.
std::string gaps_text(const std::vector<JointGap>& gaps, const std::string& unit);

/// Findings of the checks of a scene before it moves.
struct Preflight {
  std::vector<JointGap> gaps;  ///< gaps of joints above round-off, before the projection closes the joints
  /// Names of the bodies of each connected group; several groups move independently.
  std::vector<std::vector<std::string>> groups;
  std::vector<std::string> doubts;  ///< sentences on masses and inertias that suggest typing errors or wrong units
};

/// Checks gaps, groups and masses at the last evaluate(), before the projection closes the joints.
Preflight examine(const Model& model, const Evaluation& evaluation);

/// Gaps of joints and couplings that are open by more than 1e-9 at the last evaluate(). The limit is relative to the
/// characteristic length, or in radians. JointGap::length is the distance of the markers.
std::vector<JointGap> marker_gaps(const Model& model, const Evaluation& evaluation);

/// Sentences on motions of massless bodies that no constraint, stiffness or damping determines: "'hub' can turn about
/// [0, 0, 1]". The motions are null vectors of the columns of [M + C + K; B] that belong to massless nodes. [GA00]
/// section 4 has this condition for a regular system. Uses the state of the last evaluate() and overwrites the
/// iteration matrix.
std::vector<std::string> undetermined_motions(const Model& model, const State& state, Evaluation& evaluation);

/// A line "quantity, value" of a printed table.
struct PreflightLine {
  std::string name;
  std::string value;
};
/// Complete preflight table that `check` prints.
std::vector<PreflightLine> preflight_table(const Preflight& preflight, const Mobility& mobility, const Units& units);

/// Lines of preflight_table() that may be mistakes, which a run reports too: unconnected bodies, joints that are open
/// at the start, doubtful masses and inertias.
std::vector<PreflightLine> preflight_doubts(const Preflight& preflight, const Units& units);

}  // namespace tisserand::mechanism
