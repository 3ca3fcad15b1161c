// SPDX-License-Identifier: GPL-3.0-or-later
// Transfer of a state to another model of the same scene, in which a body is flexible instead of rigid, or the reverse.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Whether a state of one model is valid for the other: both have the same nodes, coordinates and constraints.
bool share_states(const Model& a, const Model& b);

/// Transfer of states from one model to another of the same scene, in which other bodies are flexible. The
/// correspondence of the models is found once. Both models must outlive this object.
class StateTransfer {
 public:
  /// Finds the correspondence. Throws Error for a node without a counterpart.
  StateTransfer(const Model& from, const Model& to);

  /// Converts `state` of the first model to `result`, a state of the other one. `now` is the evaluation at `state`.
  ///
  /// - Nodes of both models keep their motion bit for bit.
  /// - Places that become nodes, or cease to be nodes, move with the rigid body, accelerations included.
  /// - Bodies flexible in both models keep their deformation. A body that becomes flexible is undeformed.
  /// - A superelement that becomes rigid takes the pose of its floating frame. It takes the linear and angular momentum
  /// of
  ///   its mass matrix in axes of the frame.
  /// - A modal body that loses modes takes the mean pose of its mass and its momenta.
  /// - Multipliers are kept if both models have the same constraints, else they are zero.
  ///
  /// Allocates memory only if a body becomes rigid.
  void apply(const State& state, const Evaluation& now, State& result) const;

 private:
  /// Source of the motion of a node: a node, a marker of a rigid body, or a superelement that becomes rigid. Unused
  /// ones are −1 or absent.
  struct Source {
    int node = -1;
    std::optional<Marker> marker;
    int superelement = -1;
  };
  Source source_of(int node) const;
  void set_node(int index, const State& state, const Evaluation& now, State& result) const;
  void set_superelements(const State& state, State& result) const;
  void set_modal_bodies(const State& state, const Evaluation& now, State& result) const;
  void leave_modes_out(const ModalBody& body, const ModalBody& own, const ModalScratch& scratch, State& result) const;
  void set_treads(const State& state, State& result) const;
  void set_hinges(const State& state, State& result) const;

  const Model& from_;
  const Model& to_;
  std::vector<Source> sources_;     ///< source of each node of `to`
  std::vector<int> superelements_;  ///< index in `from` of each superelement of `to`; -1: it was rigid
  /// For each superelement of `to` that was rigid: index in `from` of the node of the rigid body.
  std::vector<int> frames_;
  std::vector<int> modal_bodies_;  ///< index in `from` of each modal body of `to`
  std::vector<int> turns_;         ///< index in `from` of each unwrapped angle of `to`; -1: none
};

/// Transfers `state` of model `from` to model `to`, for a start. Accelerations and multipliers are zero. A start solves
/// for them and projects positions and velocities on the constraints (mechanism/analyses/start.hpp).
State transfer(const Model& from, const State& state, const Model& to);

}  // namespace tisserand::mechanism
