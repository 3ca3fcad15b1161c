// SPDX-License-Identifier: GPL-3.0-or-later
// Dispatch to the method, which is chosen once.
#include "mechanism/run/stepper.hpp"

namespace tisserand::mechanism {

Stepper::Stepper(const Model& model, const formats::IntegratorSpec& options) : model_(model), options_(options) {
  if (options.method == formats::Method::radau) radau_.emplace(model, options);
}

StepReport Stepper::advance(const StepEnd& end, State& state, Workspace& workspace) {
  return radau_ ? radau_->advance(end, state, workspace) : mechanism::advance(model_, options_, end, state, workspace);
}

void Stepper::interpolate(double time, State& state, Workspace& workspace) {
  radau_->interpolate(time, state, workspace);
}

void Stepper::forget(Workspace& workspace) {
  workspace.forget();
  if (radau_) radau_->forget();
}

void Stepper::pass_jump() {
  if (radau_) radau_->pass_jump();
}

SolverHealth Stepper::health(const Workspace& workspace) const {
  return radau_ ? radau_->health() : workspace.matrix.health();
}

}  // namespace tisserand::mechanism
