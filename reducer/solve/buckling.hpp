// SPDX-License-Identifier: GPL-3.0-or-later
// Linear buckling of the supported part under each of its load cases.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/loads/load_vectors.hpp"
#include "reducer/report/phase_listener.hpp"
#include "reducer/solve/statics.hpp"
#include "reducer/solve/supported.hpp"

namespace tisserand::reducer {

/// Load factors of one load case at which the part buckles, and the buckling shapes.
struct CaseBuckling {
  int asked = 0;           ///< requested number of factors
  Eigen::VectorXd factor;  ///< factors λ > 0, ascending: the part buckles under λ times the load
  /// Buckling shapes in coordinates q (coordinates x factors). The largest displacement of a shape is 1, or the
  /// largest rotation if the shape turns nodes without displacement.
  Eigen::MatrixXd q;
  std::optional<double> reversed;  ///< lowest factor of the reversed load, see LoadFactors::reversed
  double limit = 0.0;              ///< limit above which factors are ignored, see LoadFactors::limit
  double residual = 0.0;           ///< largest residual, see LoadFactors::residual
  int more_equal = 0;              ///< further factors that equal the last one, see LoadFactors::more_equal
};

/// Supported part, its loads and static solutions, and the number of load factors: input of buckling().
struct BucklingProblem {
  const Supported& supported;
  const LoadVectors& loads;
  const Statics& statics;
  int count = 0;  ///< number of load factors per load case
};

/// Throws Error if the part has no load case or no supports. Without supports, loads of fixed direction turn the part
/// over.
void require_buckling_load(const formats::Part& part);

/// Warnings about buckling that name the ties whose second-order terms are omitted, and the beam sections with unknown
/// Wagner constant β.
std::vector<std::string> buckling_warnings(const Mesh& mesh);

/// Computes the lowest buckling factors of each load case, (S + λ K_g) φ = 0; fewer if fewer exist. The stress is that
/// of linear statics, and loads keep their size and direction. Throws Error for a load case without stress.
std::vector<CaseBuckling> buckling(const BucklingProblem& problem, const PhaseListener& begin);

}  // namespace tisserand::reducer
