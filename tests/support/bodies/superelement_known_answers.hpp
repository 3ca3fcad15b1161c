// SPDX-License-Identifier: GPL-3.0-or-later
// The superelements and states of references/cardona/known_answers.json.
#pragma once

#include <string>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/superelement_cases.hpp"

namespace tisserand::test_support {

Eigen::VectorXd to_vector(const nlohmann::json& j);

Eigen::MatrixXd to_matrix(const nlohmann::json& j);

/// A superelement of references/cardona/known_answers.json with its state and its results.
struct KnownAnswer {
  nlohmann::json entry;
  formats::Superelement element;
  formats::RigidProperties rigid;
};

KnownAnswer known_answer(const std::string& name);

/// The state of the known answer, internal coordinates mapped to those of `body`.
BodyState known_state(const KnownAnswer& known, const mechanism::SuperelementBody& body, bool from_R_ref);

}  // namespace tisserand::test_support
