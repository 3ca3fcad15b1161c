// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of the benchmarks, written in code, and a run in memory with its costs.
#pragma once

#include <map>
#include <string>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/step/workspace.hpp"
#include "tests/support/bodies/beam_superelement.hpp"

namespace tisserand::benchmarks {

/// A scene with the superelement files that it names, in memory.
struct Case {
  formats::Scene scene;
  mechanism::SuperelementFiles files;
  mechanism::StepTuning tuning = {};
  std::map<std::string, formats::Companion> companions = {};  ///< companions of these files

  mechanism::BodyFiles body_files() const;
};

/// Hinged beam of [Car00] 8.1 under a moment of 200, 2000 steps of 0.01, as one reduced body of 24 beam elements.
/// Boundary nodes are base and tip, with `modes` (at most 138) fixed-boundary modes. Frame karcher, inertia B.
Case hinged_beam(int modes, formats::Formulation formulation);

/// Inertia and stiffening of a superelement.
struct SecondOrderTerms {
  formats::InertiaOption inertia = formats::InertiaOption::B;
  formats::StiffeningOption stiffening = formats::StiffeningOption::off;
};

/// Hinged beam of [Car00] 8.1 from 24 elements without shear, with its companion.
Case hinged_beam(int modes, SecondOrderTerms terms);

/// Hinged beam of [Car00] 8.1 as geometrically exact elements of two or three nodes.
Case nonlinear_beam(int elements, int nodes_per_element);

/// Horizontal chain of superelements (1 m of steel each, 4 modes) on spherical joints. Ground holds the first one, and
/// the chain falls from rest under gravity in steps of 1 ms.
Case chain(int elements, int steps);

/// Beam of `pieces` elements, reduced to the nodes base and tip and its `modes` lowest modes with fixed boundary.
formats::Superelement reduced_beam(const test_support::BeamData& beam, int pieces, int modes);

/// CPU time of this process [s].
double cpu_seconds();

/// Times [s], counts and errors of a run.
struct Cost {
  double seconds_model = 0.0, seconds_start = 0.0;
  double seconds_steps = 0.0;  ///< without output
  double seconds_output = 0.0;
  long steps = 0, iterations = 0, factorisations = 0, rejected = 0;
  double error = 0.0;  ///< largest error of the base's angular velocity about z against the converged reference
  double error_rms = 0.0;
  double seconds() const { return seconds_steps + seconds_output; }
};

/// Builds, starts and runs the case. Writes every tenth step to a results file in the folder for temporary files.
/// Throws if a step fails.
Cost run(const Case& input);

/// Runs the hinged beam as run() does, with errors against its reference; `base`: name of the base node.
Cost run_hinged_beam(const Case& input, const std::string& base);

/// A model that has run to `time`, for measurements of its kernels.
struct Stopped {
  formats::Scene scene;
  mechanism::BuiltModel built;
  mechanism::Workspace workspace;
  Stopped(const Case& input, double time);
};

}  // namespace tisserand::benchmarks
