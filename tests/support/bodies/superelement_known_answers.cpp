// SPDX-License-Identifier: GPL-3.0-or-later
// Reads references/cardona/known_answers.json.
#include "tests/support/bodies/superelement_known_answers.hpp"

#include <fstream>

#include <Eigen/LU>

namespace tisserand::test_support {

Eigen::VectorXd to_vector(const nlohmann::json& j) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(j.size()));
  for (std::size_t i = 0; i < j.size(); ++i) v[i] = j[i].get<double>();
  return v;
}

Eigen::MatrixXd to_matrix(const nlohmann::json& j) {
  Eigen::MatrixXd A(static_cast<Eigen::Index>(j.size()), static_cast<Eigen::Index>(j[0].size()));
  for (std::size_t i = 0; i < j.size(); ++i) A.row(i) = to_vector(j[i]).transpose();
  return A;
}

KnownAnswer known_answer(const std::string& name) {
  std::ifstream file(std::string(TISSERAND_REFERENCES) + "/cardona/known_answers.json");
  KnownAnswer known;
  known.entry = nlohmann::json::parse(file).at(name);
  const auto n = known.entry["n"].get<int>(), m = known.entry["m"].get<int>();
  known.element.name = name;
  known.element.node_position = to_matrix(known.entry["X"]);
  known.element.stiffness = to_matrix(known.entry["Sbar"]);
  known.element.mass = to_matrix(known.entry["Mbar"]);
  for (int i = 0; i < n; ++i) {
    known.element.node_name.push_back("n" + std::to_string(i));
    for (int component = 0; component < 6; ++component) {
      known.element.dof_node.push_back(i);
      known.element.dof_component.push_back(component);
    }
  }
  for (int k = 0; k < m; ++k) {
    known.element.dof_node.push_back(-1);
    known.element.dof_component.push_back(k);
  }
  known.rigid.mass = known.entry["mass"].get<double>();
  known.rigid.center_of_mass = to_vector(known.entry["xcm"]);
  const Eigen::Matrix3d about_origin = to_matrix(known.entry["inertia_about_origin"]);
  const Eigen::Vector3d c = known.rigid.center_of_mass;
  known.rigid.inertia =
      about_origin - known.rigid.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return known;
}

BodyState known_state(const KnownAnswer& known, const mechanism::SuperelementBody& body, bool from_R_ref) {
  const auto& entry = known.entry;
  const auto n = entry["n"].get<Eigen::Index>(), m = entry["m"].get<Eigen::Index>();
  const Eigen::VectorXd v = to_vector(entry["v"]), a = to_vector(entry["a"]);
  BodyState state;
  for (Eigen::Index i = 0; i < n; ++i) {
    mechanism::NodeMotion node;
    const auto k = static_cast<std::size_t>(i);
    node.x = to_vector(entry["x"][k]);
    node.R = to_matrix(entry["R"][k]);
    node.xd = v.segment<3>(6 * i);
    node.Omega = v.segment<3>(6 * i + 3);
    node.xdd = a.segment<3>(6 * i);
    node.Omegad = a.segment<3>(6 * i + 3);
    state.nodes.push_back(node);
  }
  const Eigen::MatrixXd inverse = body.file.modal_part.inverse();
  state.y = inverse * to_vector(entry["yI"]);
  state.yd = inverse * v.tail(m);
  state.ydd = inverse * a.tail(m);
  state.R0_reference = from_R_ref ? Eigen::Matrix3d(to_matrix(entry["R_ref"])) : state.nodes[0].R;
  return state;
}

}  // namespace tisserand::test_support
