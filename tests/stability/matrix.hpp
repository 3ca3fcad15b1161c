// Cells of the matrix, and what each ends with.
#pragma once

#include <string>
#include <vector>

#include "tests/stability/catalogue.hpp"

namespace tisserand::stability {

enum class State {
  pass,       ///< the criteria hold
  told,       ///< they do not, and the run says why: its doubts, or the error that it ended with
  fail,       ///< a silent wrong answer, no number, no end, or an end without a reason
  impossible  ///< there is no such cell
};

std::string word(State state);

struct Cell {
  const Case* of = nullptr;
  std::string factor;  ///< formulation, integrator, solver, scaling, and pairs of them
  std::string level;
  std::vector<std::string> settings;
  std::string impossible;  ///< why there is none; empty: there is
  std::string id() const { return of->name + " | " + factor + " | " + level; }
};

struct Outcome {
  State state = State::fail;
  double worst = 0.0;  ///< largest error over its tolerance
  std::string said;    ///< doubts or error
  double seconds = 0.0;
};

/// Every factor fully against the default of the others; formulation × integrator for flexible bodies; solver × Radau,
/// whose systems are complex.
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
