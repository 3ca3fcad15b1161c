// Newton's iteration for positions at given accelerations.
#include "mechanism/ledger/settle.hpp"

#include <algorithm>
#include <limits>

#include "mechanism/equations/increments.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {
namespace {

constexpr int most_iterations = 30;
/// Of the size of the scene: an increment that moves nothing any more.
constexpr double still_increment = 1e-12;

/// Largest increment of a node, in lengths of the scene; not-a-number if it is none.
double size_of_increment(const Model& model, const Eigen::VectorXd& increment) {
  double largest = 0.0;
  for (const Node& node : model.nodes) {
    if (node.translation >= 0)
      largest = std::max(largest, increment.segment<3>(node.translation).norm() / model.length);
    if (node.rotation >= 0) largest = std::max(largest, increment.segment<3>(node.rotation).norm());
  }
  return increment.allFinite() ? largest : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

State settled(const Model& model, const State& given, double period) {
  const TangentRequest request{{1.0 / (period * period), 0.0, 1.0}, TangentKind::exact, {}};
  Workspace workspace(model);
  State state = given;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    evaluate(model, state, workspace.now);
    if (!workspace.matrix.factor(model, state, request, workspace.now).regular) return given;
    workspace.matrix.solve_increment(model, -workspace.now.constraint, workspace.now);
    const double size = size_of_increment(model, workspace.matrix.increment);
    if (!(size < 0.5)) return given;
    if (size >= before && size < 1e3 * still_increment) return state;  // round-off is reached
    before = size;
    state.lambda() += workspace.matrix.multipliers;
    const State from = state;
    retract(model, from, workspace.matrix.increment, state);
    if (size < still_increment) return state;
  }
  return given;
}

}  // namespace tisserand::mechanism
