// SPDX-License-Identifier: GPL-3.0-or-later
// The superelements, arrays, states and results of references/second_order_known_answers.json.
#pragma once

#include <string>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "formats/companion/companion.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/superelement_cases.hpp"

namespace tisserand::test_support {

/// beam2 (two nodes, three modes) or lframe3 (three nodes, two modes).
struct SecondOrderAnswer {
  nlohmann::json entry;
  formats::Superelement element;
  formats::Companion companion;
};

SecondOrderAnswer second_order_answer(const std::string& name);

/// Its body with the weights of the answer, and the second-order terms that are asked for.
mechanism::SuperelementBody second_order_body(const SecondOrderAnswer& answer, formats::InertiaOption inertia,
                                              formats::StiffeningOption stiffening);

/// The state of the answer, internal coordinates in those of `body`.
BodyState second_order_state(const SecondOrderAnswer& answer, const mechanism::SuperelementBody& body);

}  // namespace tisserand::test_support
