// SPDX-License-Identifier: GPL-3.0-or-later
// Static answers that the modes of a modal body omit: to inertia loads of its frame and to forces on its nodes.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/system/partition.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Mass of a modal body: that of a node, with its arm from the node.
struct LumpedMass {
  NodalMass mass;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
};

/// Node of a modal body at which joints and forces of a scene may act.
struct NamedNode {
  std::string name;
  int node = 0;
};

/// Modal body whose static answers lumped_answers() computes.
struct AnsweredBody {
  const System& system;           ///< system of the mesh with lumped masses
  std::vector<int> held;          ///< held coordinates q of the reference; none: mean axis
  const Eigen::VectorXd& lambda;  ///< ω² of the modes
  const Eigen::MatrixXd& q;       ///< modes in coordinates q (q x m)
  std::vector<LumpedMass> masses;
  std::vector<NamedNode> nodes;
  const Eigen::Matrix3Xd& position;                  ///< positions of all nodes of the mesh
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< centre of mass
};

/// Static answers of a modal body under its reference conditions, without the share of its modes: w = K⁺ g − Φ ω⁻² Φᵀ
/// g for loads g. For a mean axis K⁺ is that of the free body under loads without resultant. Rigid accelerations
/// balance other loads, and the answer has no rigid part.
struct LumpedAnswers {
  std::vector<formats::AppliedLoad> forces;  ///< unit forces and moments on each node: three or six components
  /// Coordinates of the mesh x (12 + forces): displacements w, inertia loads first.
  Eigen::MatrixXd x;
  Eigen::MatrixXd share;  ///< m x (12 + forces): share Φᵀ g of the modes
  /// Products of the answers w to the unit forces f, as in the file of the body.
  Eigen::MatrixXd flexibility;  ///< forces x forces: flexibility fᵀ w
  Eigen::MatrixXd mass;         ///< forces x forces: wᵀ M w
  Eigen::MatrixXd coupling;     ///< 6 x forces: momentum Rᵀ M w in the rigid motions R about the centre of mass
};

LumpedAnswers lumped_answers(const AnsweredBody& body);

}  // namespace tisserand::reducer
