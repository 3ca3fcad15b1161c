// SPDX-License-Identifier: GPL-3.0-or-later
// Linear range of a modal body: its length, buckling load, axial force, deflection, first frequency.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Constants of one modal body, and its quantities at an evaluated state. A body with its nodes on a line counts as a
/// beam. Euler's load N between pins follows from its modes: largest 1/N = max φᵀGφ/φᵀKφ, where G is the work of a unit
/// force on the slopes of its nodes relative to the line through the ends.
class ModalRange {
 public:
  ModalRange(const Model& model, int body);

  double span() const { return span_; }          ///< between the two most distant nodes
  double buckling() const { return buckling_; }  ///< 0: not a beam
  double lag() const { return lag_; }            ///< half the period of the lowest mode

  /// Largest |x − x(w = 0)| of a node, axes of the frame.
  double deflection(const Model& model, const Evaluation& evaluation) const;
  /// Mean axial force over the length, tension positive. It contains forces of joints, couplings, springs (without
  /// forces given as functions of time) and loads, and the inertia and weight between them.
  double axial_force(const Model& model, const State& state, const Evaluation& evaluation) const;
  /// Lowest frequency [rad/time] above `from`/1000 with the attached nodes held: all coordinates of a single node, the
  /// translations of several. 0: there is none.
  double first_frequency(const Model& model, double from) const;

 private:
  /// Distance s of a node of this body along the line; 0 for others.
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
  std::vector<int> joints_, springs_, bushings_, loads_;  ///< indices of those that act on the body
  std::vector<Term> terms_;
  std::vector<int> nodes_;  ///< indices in Model::modal_nodes, along the line if it is a beam
  std::vector<bool> attached_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero(), start_ = Eigen::Vector3d::Zero();
  double span_ = 0.0, buckling_ = 0.0, lag_ = 0.0;
};

}  // namespace tisserand::mechanism
