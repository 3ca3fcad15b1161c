// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of an evaluation, and the check of its stages.
#include "mechanism/equations/evaluation.hpp"

#include "common/error.hpp"
#include "mechanism/equations/carriers.hpp"

namespace tisserand::mechanism {
namespace {

std::vector<std::array<TimeFunction, 3>> compile_loads(const Model& model) {
  std::vector<std::array<TimeFunction, 3>> functions;
  for (const Load& load : model.loads)
    functions.push_back({TimeFunction(load.components[0], model.scope), TimeFunction(load.components[1], model.scope),
                         TimeFunction(load.components[2], model.scope)});
  return functions;
}

std::vector<TimeFunction> compile_part_loads(const Model& model) {
  std::vector<TimeFunction> functions;
  for (const PartLoad& load : model.part_loads) functions.emplace_back(load.value, model.scope);
  return functions;
}

std::vector<PartLoadDirection> size_directions(const Model& model) {
  std::vector<PartLoadDirection> directions(model.part_loads.size());
  for (const ChannelUse& use : model.channel_uses) {
    if (use.owner != ChannelUse::Owner::part_load) continue;
    const PartLoad& load = model.part_loads[use.index];
    PartLoadDirection& direction = directions[use.index];
    direction.boundary.setZero(static_cast<Eigen::Index>(model.part_loads.maps[use.index].coordinates.size()));
    if (load.superelement >= 0) direction.internal.setZero(body_of(model, load.superelement).modes);
  }
  return directions;
}

std::vector<MotionFunction> compile_motions(const Model& model) {
  std::vector<MotionFunction> functions;
  for (const formats::TimeFunctionSpec& motion : model.motions)
    functions.emplace_back(motion, model.motion_spacing, model.scope);
  return functions;
}

std::vector<std::optional<TimeFunction>> compile_spring_forces(const Model& model) {
  std::vector<std::optional<TimeFunction>> functions(model.springs.size());
  for (std::size_t i = 0; i < model.springs.size(); ++i)
    if (model.springs[i].has_force) functions[i].emplace(model.springs[i].force, model.scope);
  return functions;
}

}  // namespace

Evaluation::Evaluation(const Model& model)
    : displacement(Eigen::VectorXd::Zero(model.sizes.velocities())),
      motion(model.nodes.size() + 1),
      treads(model.tyres.size()),
      joints(model.joints.size()),
      coordinates(model.coordinates.size()),
      motion_values(model.motions.size()),
      channels(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.channels.size()))),
      active(Eigen::VectorXd::Zero(model.sizes.constraints)),
      constraint(active),
      constraint_rate(active),
      frictions(model.frictions.size()),
      bushings(model.bushings.size()),
      tyres(model.tyres.size()),
      load_values(model.loads.size(), Eigen::Vector3d::Zero()),
      part_load_values(model.part_loads.size(), 0.0),
      residual(Eigen::VectorXd::Zero(model.sizes.boundary)),
      bias(active),
      tie_wrenches(model.ties.size(), Vector6d::Zero()),
      motions(compile_motions(model)),
      spring_forces(compile_spring_forces(model)),
      load_functions(compile_loads(model)),
      part_load_functions(compile_part_loads(model)),
      part_load_directions(size_directions(model)),
      carriers(make_carrier_scratch(model)) {
  for (const SuperelementBody& body : model.superelement_bodies) superelement_work.push_back(make_work(body));
  for (std::size_t i = 0; i < model.superelements.size(); ++i) superelements.push_back(make_scratch(body_of(model, i)));
  for (const ModalBody& body : model.modal_bodies) modal_bodies.push_back(make_scratch(body));
  for (const ModalNode& node : model.modal_nodes) modal_nodes.push_back(make_terms(node));
  modal_forces.assign(model.modal_nodes.size(), Vector6d::Zero());
}

void require_stage([[maybe_unused]] const Evaluation& evaluation, [[maybe_unused]] Stage stage) {
  TISSERAND_ENSURE(evaluation.stage >= stage, "stage {} of an evaluation is read after stage {}",
                   static_cast<int>(stage), static_cast<int>(evaluation.stage));
}

}  // namespace tisserand::mechanism
