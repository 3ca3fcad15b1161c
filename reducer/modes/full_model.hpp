// Quantities of the unreduced part with which the certificate compares those of the reduced one.
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

/// Coordinates up to which a part is compared with its full model, which then takes no longer than the rest.
inline constexpr int most_compared_coordinates = 6000;

/// The blocks of S and M. `system` keeps the whole matrices, too, where functions below need them later: for methods
/// with modes of the free part, for mechanisms, and for parts that are small enough to be compared.
Blocks take_apart(System& system, const Partition& p, const formats::ModeSelection& asked);

/// Mass, centre of mass and inertia about it from Rᵀ M R of the full mass matrix.
formats::RigidProperties full_rigid_properties(const System& system);

struct FreeModes : EigenPairs {
  std::optional<int> counted;  ///< elastic modes below the cut by inertia, which are as many
  SolverReport solver;
};

/// Which elastic modes of the free part are sought.
struct FreeSearch {
  double scale = 0.0;     ///< some eigenvalue ω² of the size of the lowest
  int count = 0;          ///< the lowest
  int rigid_motions = 6;  ///< with those of mechanisms
  int finite = 0;         ///< so many finite eigenvalues are known to exist, which can save a count
};

/// Elastic modes of the free part, vᵀ M v = 1, fewer if there are no more; a group of equal ones is completed. `asked`:
/// by which solver. `share` hears how much of the search is done.
/// Empty if a rigid motion moves no mass. Throws Error if round-off hides the frequencies.
std::optional<FreeModes> full_free_modes(
    const System& system, const FreeSearch& sought, const formats::ModeSelection& asked, Count verify = Count::if_cheap,
    const std::function<void(double)>& share = [](double /*done*/) {});

/// Elastic modes of the free part compared with others.
struct ModeComparison {
  std::vector<double> frequency;  ///< [1/time], at most `count` lowest
  Eigen::MatrixXd assurance;      ///< (vᵢᵀ M u_k)²: one row per frequency, one column per mode u
};

/// Modes v of the full part compared with the modes `u` (coordinates q, uᵀ M u = 1): modal assurance criterion weighted
/// with the mass, 1 where they agree. Empty if a rigid motion moves no mass or round-off hides the frequencies.
ModeComparison compare_free_modes(const System& system, const FreeSearch& sought, const formats::ModeSelection& asked,
                                  const Eigen::MatrixXd& u);

}  // namespace tisserand::reducer
