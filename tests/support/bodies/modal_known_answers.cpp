// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the body and the state of references/goncalves_ambrosio/known_answers.json.
#include "tests/support/bodies/modal_known_answers.hpp"

#include <fstream>

namespace tisserand::test_support {

nlohmann::json modal_answers() {
  std::ifstream file(std::string(TISSERAND_REFERENCES) + "/goncalves_ambrosio/known_answers.json");
  return nlohmann::json::parse(file);
}

LumpedModel known_model(const nlohmann::json& answers) {
  const nlohmann::json& body = answers.at("body");
  LumpedModel model;
  model.position = to_matrix(body.at("x"));
  model.mass = to_vector(body.at("m"));
  model.stiffness = to_matrix(body.at("K"));
  for (std::size_t k = 0; k < body.at("mu").size(); ++k) {
    model.name.push_back("n" + std::to_string(k + 1));
    model.inertia.push_back(to_matrix(body.at("mu")[k]));
  }
  return model;
}

formats::ModalBody known_body(const nlohmann::json& answers, const std::string& reference) {
  const nlohmann::json& entry = answers.at("body").at(reference);
  const LumpedModel model = known_model(answers);
  formats::ModalBody body;
  body.name = reference;
  body.producer = "references/goncalves_ambrosio";
  body.units = Units::si();
  body.reference = reference == "mean_axis" ? formats::ModalReference::mean_axis : formats::ModalReference::nodes;
  if (reference == "node_fixed")
    for (const nlohmann::json& pair : entry.at("reference_conditions_node_component_1based")) {
      body.reference_node.push_back(pair[0].get<int>() - 1);
      body.reference_component.push_back(pair[1].get<int>() - 1);
    }
  body.node_name = model.name;
  body.node_position = model.position;
  body.node_mass = model.mass;
  body.node_inertia = model.inertia;
  for (const nlohmann::json& rows : entry.at("X")) body.X.emplace_back(to_matrix(rows));
  body.omega2 = to_vector(entry.at("omega_squared"));
  body.zeta.setZero(body.omega2.size());
  body.integrals = formats::integrals_of(body);
  return body;
}

ModalState known_modal_state(const nlohmann::json& answers) {
  const nlohmann::json& entry = answers.at("state");
  const Eigen::VectorXd v = to_vector(entry.at("v")), a = to_vector(entry.at("a"));
  ModalState state;
  state.frame.x = to_vector(entry.at("r"));
  state.frame.R = to_matrix(entry.at("A"));
  state.frame.xd = v.head<3>();
  state.frame.Omega = v.segment<3>(3);
  state.frame.xdd = a.head<3>();
  state.frame.Omegad = a.segment<3>(3);
  state.w = to_vector(entry.at("w"));
  state.wd = v.tail(3);
  state.wdd = a.tail(3);
  return state;
}

formats::ModalBodySpec modal_spec(const std::string& name, const std::string& file) {
  formats::ModalBodySpec spec;
  spec.name = name;
  spec.file = file;
  return spec;
}

}  // namespace tisserand::test_support
