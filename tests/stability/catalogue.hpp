// SPDX-License-Identifier: GPL-3.0-or-later
// The hard cases of the matrix: scenes of this folder, what must come out and why, and what each is varied over.
#pragma once

#include <string>
#include <vector>

namespace tisserand::stability {

/// What the run of a case is held against.
struct Criterion {
  enum class Kind {
    end,     ///< |Σ factor × channel at the end − expected| ≤ tolerance
    length,  ///< the same of √(Σ (factor × channel)²)
    balance  ///< largest |energy balance| ≤ tolerance × largest (kinetic + |strain| + |work|)
  };
  struct Term {
    double factor = 1.0;
    std::string channel;
  };
  Kind kind = Kind::end;
  std::vector<Term> terms;
  double expected = 0.0;
  double tolerance = 0.0;
  bool is_length = false;  ///< expected and tolerance scale with the unit of length
};

/// A way to write the bodies of a case: settings in the manner of --set; or why there is none.
struct Formulation {
  std::string name;
  std::vector<std::string> settings;
  std::string impossible;
};

struct Case {
  std::string name;
  std::string scene;  ///< of scenes/ or of the trials' inputs, without .scene.yaml
  std::vector<std::string> settings;
  std::vector<Criterion> criteria;
  std::string source;                          ///< where what is expected comes from
  std::vector<Formulation> formulations = {};  ///< the first is the default; empty: rigid bodies, nothing to vary
  bool takes_steps = true;                     ///< no: statics, without integrator
  bool scales = true;                          ///< has parameters L and M for units of length and mass
  bool quick = true;                           ///< a second at most for all its cells: part of ./check
};

/// A part that `reducer` reduces for the scenes.
struct Part {
  std::string file;    ///< <file>.superelement.h5
  std::string source;  ///< of scenes/ or of the trials' inputs, without .part.yaml
  std::vector<std::string> settings;
};

Criterion balance(double tolerance);
Criterion at_end(const std::string& channel, double expected, double tolerance);

/// Beams in tension, changes of rows, equilibria, steady turns, effects that are `auto`, torsional buckling.
std::vector<Case> states_and_loops();
std::vector<Case> catalogue();
std::vector<Part> parts();
/// Writes the rod as a modal body, clamped at its start, beside the superelements.
void write_modal_rod(const std::string& path);

}  // namespace tisserand::stability
