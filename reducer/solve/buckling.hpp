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

/// Load factors of one load case and the buckling shapes.
struct CaseBuckling {
  int asked = 0;           ///< requested number of factors
  Eigen::VectorXd factor;  ///< λ > 0, ascending: the part buckles under λ times the load
  Eigen::MatrixXd q;       ///< coordinates x factors; the largest displacement is 1, or the largest rotation if a shape
                           ///< turns nodes without moving them
  std::optional<double> reversed;  ///< LoadFactors::reversed
  double limit = 0.0;              ///< LoadFactors::limit
  double residual = 0.0;           ///< LoadFactors::residual
  int more_equal = 0;              ///< LoadFactors::more_equal
};

/// Input of buckling.
struct BucklingProblem {
  const Supported& supported;
  const LoadVectors& loads;
  const Statics& statics;
  int count = 0;  ///< number of load factors per load case
};

/// Throws Error if the part has no load case, or no supports: loads of fixed direction turn a free part over.
void require_buckling_load(const formats::Part& part);

/// Warnings that name ties whose second order is omitted, and sections with unknown β.
std::vector<std::string> buckling_warnings(const Mesh& mesh);

/// Lowest factors of each load case (fewer if fewer exist), (S + λ K_g) φ = 0. The stress is that of linear statics,
/// and loads keep their size and direction. Throws Error for a load case without stress.
std::vector<CaseBuckling> buckling(const BucklingProblem& problem, const PhaseListener& begin);

}  // namespace tisserand::reducer
