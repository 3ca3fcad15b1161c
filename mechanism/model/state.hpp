// SPDX-License-Identifier: GPL-3.0-or-later
// State: all that changes during a run and influences later steps, in one contiguous block with a table of its fields.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tisserand::mechanism {

/// Sizes of a model. Velocity coordinates are those of nodes, then modal ones, then internal ones.
struct Sizes {
  int nodes = 0;
  int boundary = 0;       ///< velocity coordinates of nodes and modes: size of the global system
  int modal = 0;          ///< coordinates w of modal bodies and tyres with relaxation, the last of `boundary`
  int internal = 0;       ///< internal coordinates of superelements, eliminated in the element
  int constraints = 0;    ///< constraint rows, each with a multiplier λ
  int superelements = 0;  ///< number of superelements, each with a floating frame
  int hinges = 0;         ///< number of joint coordinates that are unwrapped angles
  int velocities() const { return boundary + internal; }
  int first_modal() const { return boundary - modal; }  ///< velocity coordinate of the first ẇ
};

/// One named range of the state block.
struct StateField {
  std::string name;
  int offset = 0;
  int size = 0;
};

/// State of a mechanism in one block of numbers. Positions are x (world) and a unit quaternion Q_WN [w x y z] per node,
/// modal coordinates w and internal coordinates y. Velocities, accelerations and algorithmic accelerations are [ẋ
/// world; Ω material] per node, then ẇ, then ẏ. x and Q of nodes that follow a modal body keep their initial values.
class State {
 public:
  static constexpr int version = 6;

  explicit State(const Sizes& sizes);

  const Sizes& sizes() const { return sizes_; }
  const std::vector<StateField>& fields() const { return fields_; }
  const std::vector<double>& block() const { return block_; }
  std::vector<double>& block() { return block_; }

  double& time() { return block_[scalars_ + 0]; }
  double time() const { return block_[scalars_ + 0]; }
  /// Instant at which loads are evaluated. It differs from time() only at a jump of a load, where it is on one side.
  double& load_time() { return block_[scalars_ + 1]; }
  double load_time() const { return block_[scalars_ + 1]; }
  /// Step size for which the algorithmic accelerations were built, THEORY (66).
  double& step() { return block_[scalars_ + 2]; }
  double step() const { return block_[scalars_ + 2]; }
  double& work() { return block_[scalars_ + 3]; }
  double work() const { return block_[scalars_ + 3]; }
  double& dissipated() { return block_[scalars_ + 4]; }
  double dissipated() const { return block_[scalars_ + 4]; }
  double& initial_energy() { return block_[scalars_ + 5]; }
  double initial_energy() const { return block_[scalars_ + 5]; }
  /// Running maximum of forces (`kind` 0), moments (1) or internal forces (2). The tests of Newton's iteration are
  /// relative to it.
  double& force_scale(int kind) { return block_[scalars_ + 6 + kind]; }
  double force_scale(int kind) const { return block_[scalars_ + 6 + kind]; }
  /// Power of loads at the last accepted step, for the trapezoidal rule of work().
  double& load_power() { return block_[scalars_ + 9]; }
  double load_power() const { return block_[scalars_ + 9]; }
  /// Power of damping at the last accepted step, for the trapezoidal rule of dissipated().
  double& damping_power() { return block_[scalars_ + 10]; }
  double damping_power() const { return block_[scalars_ + 10]; }
  /// Running maximum of accelerations [1/time²]. Translations count divided by the characteristic length.
  double& acceleration_scale() { return block_[scalars_ + 11]; }
  double acceleration_scale() const { return block_[scalars_ + 11]; }
  /// Angle [rad] by which bodies in loops have turned since the constraint rows were examined (step/redundancy.hpp).
  double& turned() { return block_[scalars_ + 12]; }
  double turned() const { return block_[scalars_ + 12]; }

  using Map = Eigen::Map<Eigen::VectorXd>;
  using ConstMap = Eigen::Map<const Eigen::VectorXd>;
  using Map3 = Eigen::Map<Eigen::Matrix3Xd>;
  using ConstMap3 = Eigen::Map<const Eigen::Matrix3Xd>;
  using Map4 = Eigen::Map<Eigen::Matrix4Xd>;
  using ConstMap4 = Eigen::Map<const Eigen::Matrix4Xd>;

  Map3 x() { return {block_.data() + x_, 3, sizes_.nodes}; }
  ConstMap3 x() const { return {block_.data() + x_, 3, sizes_.nodes}; }
  Map4 Q() { return {block_.data() + Q_, 4, sizes_.nodes}; }
  ConstMap4 Q() const { return {block_.data() + Q_, 4, sizes_.nodes}; }
  Map w() { return {block_.data() + w_, sizes_.modal}; }
  ConstMap w() const { return {block_.data() + w_, sizes_.modal}; }
  Map y() { return {block_.data() + y_, sizes_.internal}; }
  ConstMap y() const { return {block_.data() + y_, sizes_.internal}; }
  Map v() { return {block_.data() + v_, sizes_.velocities()}; }
  ConstMap v() const { return {block_.data() + v_, sizes_.velocities()}; }
  Map vdot() { return {block_.data() + vdot_, sizes_.velocities()}; }
  ConstMap vdot() const { return {block_.data() + vdot_, sizes_.velocities()}; }
  Map algorithmic() { return {block_.data() + a_, sizes_.velocities()}; }
  ConstMap algorithmic() const { return {block_.data() + a_, sizes_.velocities()}; }
  Map lambda() { return {block_.data() + lambda_, sizes_.constraints}; }
  ConstMap lambda() const { return {block_.data() + lambda_, sizes_.constraints}; }
  /// Rotation R₀ [w x y z] of each floating frame at the last accepted step: R_ref of THEORY (15) (4 x superelements).
  Map4 frames() { return {block_.data() + frames_, 4, sizes_.superelements}; }
  ConstMap4 frames() const { return {block_.data() + frames_, 4, sizes_.superelements}; }
  /// Flag per constraint row: 1 if it is solved for, 0 if it is redundant. The multiplier of a redundant row is 0.
  Map active() { return {block_.data() + active_, sizes_.constraints}; }
  ConstMap active() const { return {block_.data() + active_, sizes_.constraints}; }
  /// Unwrapped angle [rad] of each joint coordinate that is an angle, at the last accepted step.
  Map hinges() { return {block_.data() + hinges_, sizes_.hinges}; }
  ConstMap hinges() const { return {block_.data() + hinges_, sizes_.hinges}; }

 private:
  int add(const std::string& name, int size);

  Sizes sizes_;
  std::vector<StateField> fields_;
  std::vector<double> block_;
  int scalars_ = 0, x_ = 0, Q_ = 0, w_ = 0, y_ = 0, v_ = 0, vdot_ = 0, a_ = 0, lambda_ = 0, frames_ = 0, hinges_ = 0,
      active_ = 0;
};

/// Components [w x y z] of a quaternion.
inline Eigen::Vector4d wxyz(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
/// Quaternion with the components [w x y z].
inline Eigen::Quaterniond quaternion(const Eigen::Vector4d& Q) { return {Q[0], Q[1], Q[2], Q[3]}; }

}  // namespace tisserand::mechanism
