// SPDX-License-Identifier: GPL-3.0-or-later
// Reads references/second_order_known_answers.json.
#include "tests/support/bodies/second_order_known_answers.hpp"

#include <fstream>

#include <Eigen/LU>

#include "tests/support/bodies/superelement_known_answers.hpp"

namespace tisserand::test_support {

using mechanism::SuperelementBody;

namespace {

/// Reads matrices from entries [a, k, l, value], with k ≤ l where they are symmetric.
template <class Matrices>
void read_sparse(const nlohmann::json& j, Matrices& matrices) {
  const auto count = j.at("shape")[0].get<std::size_t>();
  const auto n = j.at("shape")[1].get<Eigen::Index>();
  const bool symmetric = j.contains("upper") || !std::is_same_v<Matrices, std::array<Eigen::MatrixXd, 3>>;
  if constexpr (requires { matrices.resize(count); }) matrices.resize(count);
  for (Eigen::MatrixXd& A : matrices) A = Eigen::MatrixXd::Zero(n, n);
  for (const auto& e : j.at("entries")) {
    const auto a = e[0].get<std::size_t>();
    const auto k = e[1].get<Eigen::Index>(), l = e[2].get<Eigen::Index>();
    matrices[a](k, l) = e[3].get<double>();
    if (symmetric) matrices[a](l, k) = e[3].get<double>();
  }
}

Eigen::MatrixXd read_symmetric(const nlohmann::json& j) {
  const auto n = j.at("shape")[0].get<Eigen::Index>();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (const auto& e : j.at("entries")) {
    const auto k = e[0].get<Eigen::Index>(), l = e[1].get<Eigen::Index>();
    A(k, l) = A(l, k) = e[2].get<double>();
  }
  return A;
}

}  // namespace

SecondOrderAnswer second_order_answer(const std::string& name) {
  std::ifstream file(std::string(TISSERAND_REFERENCES) + "/second_order_known_answers.json");
  SecondOrderAnswer answer;
  answer.entry = nlohmann::json::parse(file).at(name);
  formats::Superelement& element = answer.element;
  element.name = name;
  element.stiffness = read_symmetric(answer.entry["Sbar"]);
  element.mass = read_symmetric(answer.entry["Mbar"]);
  const Eigen::MatrixXd X = to_matrix(answer.entry["fe"]["X"]);
  const auto boundary = answer.entry["boundary"].get<std::vector<int>>();
  element.node_position.resize(static_cast<Eigen::Index>(boundary.size()), 3);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    element.node_name.push_back("n" + std::to_string(i));
    element.node_position.row(static_cast<Eigen::Index>(i)) = X.row(boundary[i]);
    for (int component = 0; component < 6; ++component) {
      element.dof_node.push_back(static_cast<int>(i));
      element.dof_component.push_back(component);
    }
  }
  for (int k = 0; k < answer.entry["modes"].get<int>(); ++k) {
    element.dof_node.push_back(-1);
    element.dof_component.push_back(k);
  }
  formats::Companion& companion = answer.companion;
  companion.weights = to_vector(answer.entry["alpha"]);
  companion.reference_point = element.node_position.transpose() * companion.weights;
  companion.mass = answer.entry["mass"].get<double>();
  companion.S0 = to_vector(answer.entry["S0"]);
  companion.S1 = (element.mass * formats::rigid_motions(element, companion.reference_point).leftCols<3>()).transpose();
  read_sparse(answer.entry["H"], companion.H);
  read_sparse(answer.entry["C"], companion.C);
  read_sparse(answer.entry["E"], companion.E);
  read_sparse(answer.entry["N"], companion.N);
  read_sparse(answer.entry["T"], companion.T);
  return answer;
}

SuperelementBody second_order_body(const SecondOrderAnswer& answer, formats::InertiaOption inertia,
                                   formats::StiffeningOption stiffening) {
  mechanism::SuperelementOptions options;
  options.inertia = inertia;
  const auto alpha = answer.entry["alpha"].get<std::vector<double>>();
  for (std::size_t i = 0; i < alpha.size(); ++i)
    options.position_weights.push_back({answer.element.node_name[i], alpha[i]});
  options.rotation_weights = options.position_weights;
  options.stiffening = stiffening;
  options.companion = &answer.companion;
  return build_superelement_body(answer.element, formats::rigid_properties(answer.element), options);
}

BodyState second_order_state(const SecondOrderAnswer& answer, const SuperelementBody& body) {
  const auto& given = answer.entry["state"];
  const Eigen::VectorXd v = to_vector(given["v"]), a = to_vector(given["a"]);
  BodyState state;
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    mechanism::NodeMotion node;
    node.x = to_vector(given["x"][i]);
    node.R = to_matrix(given["R"][i]);
    node.xd = v.segment<3>(at);
    node.Omega = v.segment<3>(at + 3);
    node.xdd = a.segment<3>(at);
    node.Omegad = a.segment<3>(at + 3);
    state.nodes.push_back(node);
  }
  const Eigen::MatrixXd inverse = body.file.modal_part.inverse();
  state.y = inverse * to_vector(given["yI"]);
  state.yd = inverse * v.tail(body.modes);
  state.ydd = inverse * a.tail(body.modes);
  state.R0_reference = state.nodes[0].R;
  return state;
}

}  // namespace tisserand::test_support
