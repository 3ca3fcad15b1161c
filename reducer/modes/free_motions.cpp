// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of the system from modes of the reduced part.
#include "reducer/modes/free_motions.hpp"

#include <algorithm>

#include "common/error.hpp"
#include "reducer/modes/truncation.hpp"

namespace tisserand::reducer {
namespace {

FreeMotions held_motions(const ReducedPart& part, int most) {
  const InternalModes& internal = part.internal;
  const Eigen::Index count = std::min<Eigen::Index>(most, internal.lambda.size() - internal.loose());
  FreeMotions modes{true, internal.lambda.segment(internal.loose(), count),
                    Eigen::MatrixXd::Zero(part.system.size(), count)};
  modes.q(part.partition.internal, Eigen::all) = internal.Phi.middleCols(internal.loose(), count);
  return modes;
}

}  // namespace

FreeMotions free_motions(const ReducedPart& part, int most) {
  const int rigid = 6 + part.internal.loose();
  EigenPairs pairs;
  try {
    pairs = free_modes(part.element.stiffness, part.element.mass, rigid + most, rigid);
  } catch (const Error&) {
    return held_motions(part, most);  // a rigid motion without mass, or loose: FileCertificate reports it
  }
  constexpr double resolved = 1e13;  // larger multiples of the first are round-off of massless directions
  Eigen::Index count = 0;
  while (rigid + count < pairs.value.size() && pairs.value[rigid + count] > 0.0 &&
         pairs.value[rigid + count] < resolved * pairs.value[rigid])
    ++count;
  if (count == 0) return held_motions(part, most);
  const Eigen::Index n_B = part.partition.n_B();
  const Eigen::MatrixXd y = pairs.vector.middleCols(rigid, count);
  FreeMotions modes{false, pairs.value.segment(rigid, count), Eigen::MatrixXd::Zero(part.system.size(), count)};
  modes.q(part.partition.boundary, Eigen::all) = y.topRows(n_B);
  modes.q(part.partition.internal, Eigen::all) =
      part.boundary.Psi * y.topRows(n_B) + part.internal.Phi * y.bottomRows(y.rows() - n_B);
  return modes;
}

}  // namespace tisserand::reducer
