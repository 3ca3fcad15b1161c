// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities of the unreduced part, with which the certificate compares those of the reduced one.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/modes/spectrum.hpp"
#include "reducer/system/partition.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Largest number of coordinates of a part whose reduced modes are compared with those of the full model. Up to this
/// size the comparison takes no longer than the rest of the reduction.
inline constexpr int most_compared_coordinates = 6000;

/// Splits S and M of `system` into boundary and interior blocks. `system` keeps the whole matrices only if later
/// functions need them: for methods with modes of the free part, for allowed mechanisms, and up to
/// most_compared_coordinates.
Blocks take_apart(System& system, const Partition& p, const formats::ModeSelection& asked);

/// Mass, centre of mass, and inertia about the centre of mass of the unreduced part, from Rᵀ M R with the rigid
/// motions R.
formats::RigidProperties full_rigid_properties(const System& system);

/// Elastic modes of the free part, unreduced, with the report of the solver.
struct FreeModes : EigenPairs {
  /// Number of elastic modes below the cut by Sylvester's law of inertia; it equals the number of modes.
  std::optional<int> counted;
  SolverReport solver;
};

/// Request of full_free_modes(): how many elastic modes of the free part to search for.
struct FreeSearch {
  double scale = 0.0;     ///< an eigenvalue ω² of the magnitude of the lowest elastic one
  int count = 0;          ///< number of requested elastic modes, lowest first
  int rigid_motions = 6;  ///< number of motions without stiffness: six rigid ones and those of mechanisms
  /// Lower bound of the number of finite eigenvalues, which can save a factorisation; 0: unknown.
  int finite = 0;
};

/// Lowest elastic modes v of the free unreduced part with vᵀ M v = 1. A group of equal eigenvalues at the end is
/// completed. There are fewer modes than requested if no more exist. `asked` chooses the solver, `verify` the count of
/// eigenvalues. `share` receives the completed share of the search, 0 to 1. Returns nothing if a rigid motion moves no
/// mass. Throws Error if round-off hides the frequencies.
std::optional<FreeModes> full_free_modes(
    const System& system, const FreeSearch& sought, const formats::ModeSelection& asked, Count verify = Count::if_cheap,
    const std::function<void(double)>& share = [](double /*done*/) {});

/// Frequencies of the unreduced free part, and the assurance (MAC) of its modes v against given modes u.
struct ModeComparison {
  std::vector<double> frequency;  ///< frequencies of the modes v of the unreduced part [1/time], lowest first
  Eigen::MatrixXd assurance;      ///< assurance (vᵢᵀ M u_k)² (modes v x modes u), 1 for equal modes
};

/// Compares elastic modes v of the unreduced free part with the modes `u` (coordinates q x modes) by the modal
/// assurance criterion weighted with the mass. Requires uᵀ M u = 1 for each column. The criterion is 1 for equal
/// modes. The result is empty if a rigid motion moves no mass or round-off hides the frequencies.
ModeComparison compare_free_modes(const System& system, const FreeSearch& sought, const formats::ModeSelection& asked,
                                  const Eigen::MatrixXd& u);

}  // namespace tisserand::reducer
