// SPDX-License-Identifier: GPL-3.0-or-later
// The body, state and results of references/goncalves_ambrosio/known_answers.json.
#pragma once

#include <string>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "formats/modal_body/modal_body.hpp"
#include "mechanism/build/modal_bodies.hpp"
#include "mechanism/frames/motion.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/superelement_known_answers.hpp"

namespace tisserand::test_support {

nlohmann::json modal_answers();

/// The five nodes with their stiffness.
LumpedModel known_model(const nlohmann::json& answers);

/// `reference`: "node_fixed" or "mean_axis"; modes as listed.
formats::ModalBody known_body(const nlohmann::json& answers, const std::string& reference);

/// Frame and modes at one instant.
struct ModalState {
  mechanism::NodeMotion frame;
  Eigen::VectorXd w, wd, wdd;
  mechanism::ModalCoordinates modes() const { return {w.data(), wd.data(), wdd.data()}; }
};

ModalState known_modal_state(const nlohmann::json& answers);

formats::ModalBodySpec modal_spec(const std::string& name, const std::string& file);

}  // namespace tisserand::test_support
