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

/// Mass of the body: that of a node, with its arm from the node.
struct LumpedMass {
  NodalMass mass;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
};

/// Node at which joints and forces of a scene may act.
struct NamedNode {
  std::string name;
  int node = 0;
};

/// Body whose static answers are computed.
struct AnsweredBody {
  const System& system;           ///< of the mesh with lumped masses
  std::vector<int> held;          ///< held coordinates q of the reference; none: mean axis
  const Eigen::VectorXd& lambda;  ///< ω² of the modes
  const Eigen::MatrixXd& q;       ///< modes
  std::vector<LumpedMass> masses;
  std::vector<NamedNode> nodes;
  const Eigen::Matrix3Xd& position;                  ///< of all nodes of the mesh
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< centre of mass
};

/// Static answers of the elastic body under its reference conditions, w = K⁺ g − Φ ω⁻² Φᵀ g. For a mean axis K⁺ is that
/// of the free body under loads without resultant: rigid accelerations balance the others, and the answer has no rigid
/// part.
struct LumpedAnswers {
  std::vector<formats::AppliedLoad> forces;  ///< for each node three or six components
  Eigen::MatrixXd x;                         ///< displacements of all coordinates x (12 + forces): inertia loads first
  Eigen::MatrixXd share;                     ///< m x (12 + forces): Φᵀ g
  /// Answers to the forces, as in the file of the body.
  Eigen::MatrixXd flexibility;  ///< forces x forces: fᵀ w
  Eigen::MatrixXd mass;         ///< forces x forces: wᵀ M w
  Eigen::MatrixXd coupling;     ///< 6 x forces: Rᵀ M w about the centre of mass
};

LumpedAnswers lumped_answers(const AnsweredBody& body);

}  // namespace tisserand::reducer
