// From modes of the reduced part to those of the system.
#include "reducer/modes/free_motions.hpp"

#include <algorithm>

#include "common/error.hpp"
#include "reducer/modes/truncation.hpp"

namespace tisserand::reducer {
namespace {

FreeMotions held_motions(const InternalProblem& problem, const InternalModes& internal, int most) {
  const Eigen::Index count = std::min<Eigen::Index>(most, internal.lambda.size() - internal.loose());
  FreeMotions modes{true, internal.lambda.segment(internal.loose(), count),
                    Eigen::MatrixXd::Zero(problem.system.size(), count)};
  modes.q(problem.partition.internal, Eigen::all) = internal.Phi.middleCols(internal.loose(), count);
  return modes;
}

}  // namespace

FreeMotions free_motions(const InternalProblem& problem, const BoundaryModes& boundary, const InternalModes& internal,
                         const formats::Superelement& element, int most) {
  const int rigid = 6 + internal.loose();
  EigenPairs pairs;
  try {
    pairs = free_modes(element.stiffness, element.mass, rigid + most, rigid);
  } catch (const Error&) {
    return held_motions(problem, internal, most);  // a rigid motion without mass, something loose: FileCertificate says
  }
  constexpr double resolved = 1e13;  // eigenvalues farther above the first are round-off of massless directions
  Eigen::Index count = 0;
  while (rigid + count < pairs.value.size() && pairs.value[rigid + count] > 0.0 &&
         pairs.value[rigid + count] < resolved * pairs.value[rigid])
    ++count;
  if (count == 0) return held_motions(problem, internal, most);
  const Eigen::Index n_B = problem.partition.n_B();
  const Eigen::MatrixXd y = pairs.vector.middleCols(rigid, count);
  FreeMotions modes{false, pairs.value.segment(rigid, count), Eigen::MatrixXd::Zero(problem.system.size(), count)};
  modes.q(problem.partition.boundary, Eigen::all) = y.topRows(n_B);
  modes.q(problem.partition.internal, Eigen::all) =
      boundary.Psi * y.topRows(n_B) + internal.Phi * y.bottomRows(y.rows() - n_B);
  return modes;
}

}  // namespace tisserand::reducer
