// Superelement bodies in known and in random deformed states, for the tests of the superelement body.
#pragma once

#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "common/rotation.hpp"
#include "formats/superelement.hpp"
#include "mechanism/bodies/superelement_evaluate.hpp"
#include "mechanism/motion.hpp"

namespace tisserand::test_support {

inline Eigen::VectorXd to_vector(const nlohmann::json& j) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(j.size()));
  for (std::size_t i = 0; i < j.size(); ++i) v[static_cast<Eigen::Index>(i)] = j[i].get<double>();
  return v;
}

inline Eigen::MatrixXd to_matrix(const nlohmann::json& j) {
  Eigen::MatrixXd A(static_cast<Eigen::Index>(j.size()), static_cast<Eigen::Index>(j[0].size()));
  for (std::size_t i = 0; i < j.size(); ++i) A.row(static_cast<Eigen::Index>(i)) = to_vector(j[i]).transpose();
  return A;
}

/// A superelement of references/cardona/known_answers.json with its state and its results.
struct KnownAnswer {
  nlohmann::json entry;
  formats::Superelement element;
  formats::RigidProperties rigid;
};

inline KnownAnswer known_answer(const std::string& name) {
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
  known.rigid.inertia = about_origin - known.rigid.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return known;
}

/// Nodes and internal coordinates of one body at one instant.
struct BodyState {
  std::vector<mechanism::NodeMotion> nodes;
  Eigen::VectorXd y, yd, ydd;
  Eigen::Matrix3d R0_reference = Eigen::Matrix3d::Identity();
};

/// The state of the known answer, internal coordinates mapped to those of `body`.
inline BodyState known_state(const KnownAnswer& known, const mechanism::SuperelementBody& body, bool from_R_ref) {
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

inline Eigen::Vector3d random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

inline Eigen::VectorXd random_vector_n(std::mt19937& random, Eigen::Index n, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Eigen::VectorXd v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = uniform(random);
  return v;
}

/// A random pose with deformations of relative size `deformation` and rates of order 1.
inline BodyState random_state(const mechanism::SuperelementBody& body, unsigned seed, double deformation) {
  std::mt19937 random(seed);
  const Eigen::Matrix3d R = exp_so3<double>(random_vector(random, 2.0));
  const Eigen::Vector3d c = random_vector(random, 3.0);
  BodyState state;
  state.R0_reference = R;
  for (const mechanism::SuperelementNode& node : body.node) {
    mechanism::NodeMotion motion;
    motion.x = c + R * (node.X + random_vector(random, deformation));
    motion.R = R * exp_so3<double>(random_vector(random, deformation));
    motion.xd = random_vector(random, 1.0);
    motion.Omega = random_vector(random, 1.0);
    motion.xdd = random_vector(random, 1.0);
    motion.Omegad = random_vector(random, 1.0);
    state.nodes.push_back(motion);
  }
  state.y = random_vector_n(random, body.modes, deformation);
  state.yd = random_vector_n(random, body.modes, 1.0);
  state.ydd = random_vector_n(random, body.modes, 1.0);
  return state;
}

/// update_kinematics() and residual() in one go.
inline void evaluate(const mechanism::SuperelementBody& body, const BodyState& state, const Eigen::Vector3d& gravity,
                     mechanism::SuperelementScratch& scratch) {
  mechanism::update_kinematics(body, state.nodes, state.y.data(), state.yd.data(), state.ydd.data(), state.R0_reference, scratch);
  mechanism::residual(body, scratch, gravity);
}

/// (r_B, r_I) of a state.
inline Eigen::VectorXd residual_vector(const mechanism::SuperelementBody& body, const BodyState& state, const Eigen::Vector3d& gravity) {
  mechanism::SuperelementScratch scratch = mechanism::make_scratch(body);
  evaluate(body, state, gravity, scratch);
  Eigen::VectorXd r(body.boundary_size + body.modes);
  r << scratch.forces.r_B, scratch.forces.r_I;
  return r;
}

/// |a − b| / |b| in the largest component.
inline double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace tisserand::test_support
