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

/// Largest number of coordinates for a comparison with the full model, which then takes no longer than the rest.
inline constexpr int most_compared_coordinates = 6000;

/// Splits S and M into blocks. `system` also keeps the whole matrices if functions below need them later: for methods
/// with modes of the free part, for mechanisms, and for parts small enough to be compared.
Blocks take_apart(System& system, const Partition& p, const formats::ModeSelection& asked);

/// Mass, centre of mass and inertia about it from Rᵀ M R of the full mass matrix.
formats::RigidProperties full_rigid_properties(const System& system);

struct FreeModes : EigenPairs {
  std::optional<int> counted;  ///< elastic modes below the cut, counted by inertia; equals their number
  SolverReport solver;
};

/// Requested elastic modes of the free part.
struct FreeSearch {
  double scale = 0.0;     ///< some eigenvalue ω² of the size of the lowest
  int count = 0;          ///< number of lowest modes
  int rigid_motions = 6;  ///< including those of mechanisms
  int finite = 0;         ///< number of finite eigenvalues known to exist, which can save a count
};

/// Elastic modes of the free part, vᵀ M v = 1, fewer if there are no more. A group of equal ones is completed. `asked`
/// chooses the solver. `share` receives the share of the search that is done. Empty if a rigid motion moves no mass.
/// Throws Error if round-off hides the frequencies.
std::optional<FreeModes> full_free_modes(
    const System& system, const FreeSearch& sought, const formats::ModeSelection& asked, Count verify = Count::if_cheap,
    const std::function<void(double)>& share = [](double /*done*/) {});

/// Comparison of elastic modes of the free part with others.
struct ModeComparison {
  std::vector<double> frequency;  ///< [1/time], at most `count` lowest
  Eigen::MatrixXd assurance;      ///< (vᵢᵀ M u_k)²: one row per frequency, one column per mode u
};

/// Modal assurance criterion, weighted with the mass, of modes v of the full part and the modes `u` (coordinates q, uᵀ
/// M u = 1). It is 1 for equal modes. Empty if a rigid motion moves no mass or round-off hides the frequencies.
ModeComparison compare_free_modes(const System& system, const FreeSearch& sought, const formats::ModeSelection& asked,
                                  const Eigen::MatrixXd& u);

}  // namespace tisserand::reducer
