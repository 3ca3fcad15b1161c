// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a scene before it moves: open joints, connected groups, undetermined motions, doubtful masses.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "mechanism/equations/mobility.hpp"

namespace tisserand::mechanism {

/// Gap of a joint, a coupling or an initial value: `length` along the directions that it constrains, and `angle`, the
/// largest residual of its other equations [rad, or cosine of two axes].
struct JointGap {
  std::string joint;
  double length = 0.0;
  double angle = 0.0;
};

/// Text "'crank' by 0.1 m and 0.02 rad, 'slider' by ..."; `unit` follows each length.
std::string gaps_text(const std::vector<JointGap>& gaps, const std::string& unit);

struct Preflight {
  std::vector<JointGap> gaps;                    ///< gaps above round-off, before the projection closes them
  std::vector<std::vector<std::string>> groups;  ///< connected bodies; more than one group: they move independently
  std::vector<std::string> doubts;               ///< masses and inertias that suggest typing errors or wrong units
};

/// Preflight report of the state before the projection, after evaluate().
Preflight examine(const Model& model, const Evaluation& evaluation);

/// Joints and couplings that are open by more than 1e-9 (relative to the characteristic length, or rad) at the last
/// evaluate(). Their lengths are distances of the markers.
std::vector<JointGap> marker_gaps(const Model& model, const Evaluation& evaluation);

/// Motions of massless bodies that no constraint, stiffness or damping determines: "'hub' can turn about [0, 0, 1]".
/// They are null vectors of the columns of [M + C + K; B] that belong to massless nodes ([GA00] section 4: condition
/// for a regular system). Uses the state of the last evaluate() and overwrites the iteration matrix.
std::vector<std::string> undetermined_motions(const Model& model, const State& state, Evaluation& evaluation);

/// A line "quantity, value" of a printed table.
struct PreflightLine {
  std::string name;
  std::string value;
};
/// Complete table that `check` prints.
std::vector<PreflightLine> preflight_table(const Preflight& preflight, const Mobility& mobility, const Units& units);

/// Lines of this table that may be mistakes, which a run reports too: unconnected bodies, joints that are open at the
/// start, masses and inertias.
std::vector<PreflightLine> preflight_doubts(const Preflight& preflight, const Units& units);

}  // namespace tisserand::mechanism
