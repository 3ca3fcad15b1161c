// SPDX-License-Identifier: GPL-3.0-or-later
// Linear range of a modal body: its length, buckling load, axial force, deflection, first frequency.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Linear range of a modal body: its constants, and quantities at an evaluated state. A body with its nodes on a line
/// counts as a beam. Euler's load N of this beam between pins follows from its modes φ with stiffness K: largest 1/N =
/// max φᵀGφ/φᵀKφ. G is the work of a unit axial force on the slopes of the nodes relative to the line through the ends.
class ModalRange {
 public:
  /// Computes the constants. `body`: index in Model::modal_bodies.
  ModalRange(const Model& model, int body);

  /// Distance between the two most distant nodes.
  double span() const { return span_; }
  /// Euler's buckling load between pins [force]; 0: the body is not a beam.
  double buckling() const { return buckling_; }
  /// Half the period of the lowest mode [time].
  double lag() const { return lag_; }

  /// Largest |x − x(w = 0)| of a node, where x(w = 0) is its position in the undeformed body on the same frame.
  double deflection(const Model& model, const Evaluation& evaluation) const;
  /// Mean axial force over the length of the beam, tension positive. It contains the forces of joints, couplings,
  /// springs and loads, and the inertia and weight between them. Spring forces given as functions of time are not
  /// included.
  double axial_force(const Model& model, const State& state, const Evaluation& evaluation) const;
  /// Lowest frequency [rad/time] above `from`/1000 with the attached nodes held. If one node is attached, all its
  /// coordinates are held. If several are attached, their translations are. 0: there is none.
  double first_frequency(const Model& model, double from) const;

 private:
  /// Distance s of a node of this body along its line; 0 for nodes of other bodies.
  double distance(const Model& model, int node) const;
  void set_buckling(const Model& model);
  void find_forces(const Model& model);

  /// Indices of the items with markers a and b that are on this body.
  template <class Items>
  std::vector<int> on_body(const Model& model, const Items& items) const;
  bool carries(const Model& model, int node) const;

  int body_;
  struct Term {
    int coupling = 0;
    CouplingTerm term;
  };
  /// Indices of the joints, springs, bushings and loads that act on the body.
  std::vector<int> joints_, springs_, bushings_, loads_;
  std::vector<Term> terms_;
  std::vector<int> nodes_;  ///< indices of its nodes in Model::modal_nodes, in order along the line if it is a beam
  std::vector<bool> attached_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero(), start_ = Eigen::Vector3d::Zero();
  double span_ = 0.0, buckling_ = 0.0, lag_ = 0.0;
};

}  // namespace tisserand::mechanism
