// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of the constraint Jacobian one by one, for uses outside of the iteration matrix.
#pragma once

#include <cstddef>

#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Calls visit(row, coordinate map, joint or coordinate, values) for each row of the constraint Jacobian B. The item
/// has the two markers. The values (12) belong to the motions [ẋ Ω] of the two nodes. A coupling gives one call per
/// term. Requires evaluate().
template <class Visit>
void for_each_row(const Model& model, const Evaluation& evaluation, Visit visit) {
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    for (int k = 0; k < model.joints[i].size(); ++k)
      visit(model.joints[i].row + k, model.joints.maps[i], model.joints[i], Row12(evaluation.joints[i].B.row(k)));
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      visit(coupling.row, model.coordinates.maps[at], model.coordinates[at],
            Row12(term.factor * evaluation.coordinates[at].G));
    }
}

/// Calls visit(coordinate of the model, value) for each entry of a row in the motions [ẋ Ω] of two nodes. Some values
/// may be zero.
template <class Visit>
void for_each_entry(const Model& model, const ElementMap& map, const Row12& row, const Evaluation& evaluation,
                    Visit visit) {
  const Eigen::MatrixXd columns = model_rows(model, map, local_view(row), evaluation);
  for (std::size_t j = 0; j < map.coordinates.size(); ++j)
    if (map.coordinates[j] >= 0) visit(map.coordinates[j], columns(0, static_cast<Eigen::Index>(j)));
}

}  // namespace tisserand::mechanism
