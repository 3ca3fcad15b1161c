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
  std::map<std::string, formats::Companion> companions = {};  ///< of those files

  mechanism::BodyFiles body_files() const;
};

/// Hinged beam of [Car00] 8.1, moment 200, 2000 steps of 0.01, as one reduced body: 24 beam elements, boundary nodes
/// base and tip, `modes` (at most 138) modes with fixed boundary; frame karcher, inertia B.
Case hinged_beam(int modes, formats::Formulation formulation);

/// Inertia and stiffening of a superelement.
struct SecondOrderTerms {
  formats::InertiaOption inertia = formats::InertiaOption::B;
  formats::StiffeningOption stiffening = formats::StiffeningOption::off;
};

/// The same beam of 24 elements without shear and with its companion.
Case hinged_beam(int modes, SecondOrderTerms terms);

/// The same beam as geometrically exact elements of two or three nodes.
Case nonlinear_beam(int elements, int nodes_per_element);

/// Horizontal chain of superelements (one metre of steel each, 4 modes) that falls from rest under gravity, the first
/// one held by ground; all joints spherical. Steps of 1 ms.
Case chain(int elements, int steps);

/// Static condensation and the lowest modes with fixed boundary of a beam of `pieces` elements; nodes base and tip.
formats::Superelement reduced_beam(const test_support::BeamData& beam, int pieces, int modes);

/// CPU time of this process [s].
double cpu_seconds();

/// What a run cost and how well it did.
struct Cost {
  double seconds_model = 0.0, seconds_start = 0.0;
  double seconds_steps = 0.0;  ///< without output
  double seconds_output = 0.0;
  long steps = 0, iterations = 0, factorisations = 0, rejected = 0;
  double error = 0.0;  ///< largest of the base's angular velocity about z against the converged reference
  double error_rms = 0.0;
  double seconds() const { return seconds_steps + seconds_output; }
};

/// Builds, starts and runs; writes every tenth step to a results file in the folder for temporary files. Throws if a
/// step fails.
Cost run(const Case& input);

/// As above, with errors against the reference of the hinged beam: the node named `base`.
Cost run_hinged_beam(const Case& input, const std::string& base);

/// A model that has run to `time`, for measurements of its kernels.
struct Stopped {
  formats::Scene scene;
  mechanism::BuiltModel built;
  mechanism::Workspace workspace;
  Stopped(const Case& input, double time);
};

}  // namespace tisserand::benchmarks
