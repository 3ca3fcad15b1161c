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

/// Load factors of one load case and the shapes in which the part buckles.
struct CaseBuckling {
  int asked = 0;           ///< how many factors were asked for
  Eigen::VectorXd factor;  ///< λ > 0, ascending: the part buckles under λ times the load
  Eigen::MatrixXd q;       ///< coordinates x factors; the largest displacement is 1, or the largest rotation where a
                           ///< shape turns nodes without moving them
  std::optional<double> reversed;  ///< LoadFactors::reversed
  double limit = 0.0;              ///< LoadFactors::limit
  double residual = 0.0;           ///< LoadFactors::residual
  int more_equal = 0;              ///< LoadFactors::more_equal
};

/// What buckling is computed from.
struct BucklingProblem {
  const Supported& supported;
  const LoadVectors& loads;
  const Statics& statics;
  int count = 0;  ///< load factors of each load case
};

/// Throws Error if the part has no load case, or no supports: loads that keep their direction turn a free part over.
void require_buckling_load(const formats::Part& part);

/// Warnings that name ties whose second order is left out, and sections whose β is not known.
std::vector<std::string> buckling_warnings(const Mesh& mesh);

/// The lowest factors (fewer if fewer exist) of each load case: (S + λ K_g) φ = 0 with the stress of the linear
/// statics and with loads that keep their size and direction. Throws Error for a load case without stress.
std::vector<CaseBuckling> buckling(const BucklingProblem& problem, const PhaseListener& begin);

}  // namespace tisserand::reducer
