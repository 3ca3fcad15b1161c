// What can be said of a scene before it moves: open joints, what hangs together, what nothing holds, doubtful masses.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "mechanism/equations/mobility.hpp"

namespace tisserand::mechanism {

/// What a joint, a coupling or an initial value leaves open: a length along the directions that it holds, and the
/// largest of its other equations [rad, or cosine of two axes].
struct JointGap {
  std::string joint;
  double length = 0.0;
  double angle = 0.0;
};

/// "'crank' by 0.1 m and 0.02 rad, 'slider' by ..."; `unit`: what stands after lengths.
std::string gaps_text(const std::vector<JointGap>& gaps, const std::string& unit);

struct Preflight {
  std::vector<JointGap> gaps;                    ///< above round-off, before the projection closes them
  std::vector<std::vector<std::string>> groups;  ///< bodies that are connected; more than one: some go their own way
  std::vector<std::string> doubts;               ///< masses and inertias that look like slips of the pen or of units
};

/// Of the state before the projection, after evaluate().
Preflight examine(const Model& model, const Evaluation& evaluation);

/// Joints and couplings that are open by more than 1e-9 of the characteristic length or radians, at the last
/// evaluate(); lengths are distances of their markers.
std::vector<JointGap> marker_gaps(const Model& model, const Evaluation& evaluation);

/// Motions of massless bodies that no constraint, stiffness or damping determines: "'hub' can turn about [0, 0, 1]". A
/// null vector of the columns of [M + C + K; B] that belong to massless nodes ([GA00] section 4: condition for a
/// regular system of equations). At the state of the last evaluate(); overwrites the iteration matrix.
std::vector<std::string> undetermined_motions(const Model& model, const State& state, Evaluation& evaluation);

/// Lines "quantity, value" of a table for people.
struct PreflightLine {
  std::string name;
  std::string value;
};
/// All that `check` tells.
std::vector<PreflightLine> preflight_table(const Preflight& preflight, const Mobility& mobility, const Units& units);

/// Of these what may be a mistake, which a run tells too: bodies that nothing connects, joints that are open at the
/// start, masses and inertias.
std::vector<PreflightLine> preflight_doubts(const Preflight& preflight, const Units& units);

}  // namespace tisserand::mechanism
