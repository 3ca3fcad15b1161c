// The state of one model as a state of another model of the same scene, in which a body is flexible or rigid.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Whether a state of one model is a state of the other as it stands: same nodes, coordinates and constraints.
bool share_states(const Model& a, const Model& b);

/// What corresponds to what, found once. Both models must stay where they are.
class StateTransfer {
 public:
  /// Throws Error for a node without a counterpart.
  StateTransfer(const Model& from, const Model& to);

  /// `state`, at which `now` was evaluated, as a state of the other model: nodes of both keep their motion to the bit,
  /// places that become nodes or stop being some move with the rigid body, with accelerations. Bodies that are flexible
  /// in both keep their deformation, one that becomes flexible is undeformed. A body that becomes rigid takes the pose
  /// of its floating frame and the linear and angular momentum that its mass matrix has in axes of the frame; a modal
  /// body that loses modes takes the mean pose of its mass, and its momenta.
  /// Multipliers are kept where both models have the same constraints, else they are zero. No heap allocation where no
  /// body becomes rigid.
  void apply(const State& state, const Evaluation& now, State& result) const;

 private:
  /// Where the motion of a node comes from: a node, a marker of a rigid body, or a superelement that becomes rigid.
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
  std::vector<Source> sources_;     ///< of each node
  std::vector<int> superelements_;  ///< of each of `to`: the one of `from`, -1: it was rigid
  std::vector<int> frames_;         ///< of each of `to` that was rigid: the node of the rigid body
  std::vector<int> modal_bodies_;   ///< of each of `to`: the one of `from`
  std::vector<int> turns_;          ///< of each angle of `to`: the one of `from`, -1: it has none
};

/// The same at once, for a start: accelerations and multipliers are zero, a start solves for them and puts positions
/// and velocities onto the constraints (mechanism/analyses/start.hpp).
State transfer(const Model& from, const State& state, const Model& to);

}  // namespace tisserand::mechanism
