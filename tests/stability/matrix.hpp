// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of the matrix, and the outcome of each.
#pragma once

#include <string>
#include <vector>

#include "tests/stability/catalogue.hpp"

namespace tisserand::stability {

enum class State {
  pass,       ///< the criteria hold
  reported,   ///< they do not, and the run says why, by a warning or by the error that ended it
  fail,       ///< a silent wrong answer, not a number, no end, or an end without a reason
  impossible  ///< the cell does not exist
};

std::string word(State state);

struct Cell {
  const Case* of = nullptr;
  std::string factor;  ///< formulation, integrator, solver, scaling, and pairs of them
  std::string level;
  std::vector<std::string> settings;
  std::string impossible;  ///< why the cell does not exist; empty if it does
  std::string id() const { return of->name + " | " + factor + " | " + level; }
};

struct Outcome {
  State state = State::fail;
  double worst = 0.0;  ///< largest error over its tolerance
  std::string said;    ///< warnings or error, or why the cell does not exist
  double seconds = 0.0;
};

/// All levels of each factor with the defaults of the others; formulation × integrator for flexible bodies; solver ×
/// Radau, whose systems are complex.
std::vector<Cell> cells_of(const Case& one);

struct Place {
  std::string mechanism, reducer;  ///< programs
  std::string scenes;              ///< folder of scenes and parts
  std::string work;                ///< folder to write in
};

/// Reduces the parts and copies the scenes beside them. Throws Error.
void prepare(const Place& place);

Outcome run(const Cell& cell, const Place& place);

}  // namespace tisserand::stability
