// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of places in the world frame, reactions, boundary forces and energies of one instant.
#include "mechanism/run/output.hpp"

#include <algorithm>
#include <limits>

#include "common/error.hpp"
#include "common/program/version.hpp"
#include "formats/results/blocks.hpp"
#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/equations/terms.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/step/redundancy.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Blanks the translations or rotations of a node that owns none.
void blank_missing(const Model& model, const Marker& marker, Eigen::Index column, formats::ResultsRow& row) {
  const auto blank = [column](auto&... values) {
    (values.col(column).setConstant(std::numeric_limits<double>::quiet_NaN()), ...);
  };
  if (!has_translation(model, marker.node)) blank(row.node_position, row.node_velocity, row.node_acceleration);
  if (!has_rotation(model, marker.node))
    blank(row.node_rotation, row.node_angular_velocity, row.node_angular_acceleration);
}

void fill_places(const Model& model, const Evaluation& evaluation, formats::ResultsRow& row) {
  for (std::size_t i = 0; i < model.places.size(); ++i) {
    const Marker& marker = model.places[i].marker;
    const NodeMotion& node = motion_of(evaluation, marker.node);
    const auto column = static_cast<Eigen::Index>(i);
    row.node_position.col(column) = model.origin + to_world(model, marker_position(marker, node));
    row.node_rotation.col(column) = wxyz(Eigen::Quaterniond(to_world(model, marker_rotation(marker, node))));
    row.node_velocity.col(column) = to_world(model, marker_velocity(marker, node));
    row.node_angular_velocity.col(column) = to_world(model, Vector3d(node.R * node.Omega));
    row.node_acceleration.col(column) = to_world(
        model,
        Vector3d(node.xdd + node.R * (node.Omegad.cross(marker.p) + node.Omega.cross(node.Omega.cross(marker.p)))));
    row.node_angular_acceleration.col(column) = to_world(model, Vector3d(node.R * node.Omegad));
    blank_missing(model, marker, column, row);
  }
}

void fill_superelements(const Model& model, Evaluation& evaluation, formats::ResultsRow& row) {
  Eigen::Index y = 0, boundary = 0, load_case = 0;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    SuperelementScratch& scratch = evaluation.superelements[i];
    const NodeView<NodeMotion> nodes = nodes_of(model, i, evaluation);
    const auto column = static_cast<Eigen::Index>(i);
    row.frame_position.col(column) = model.origin + to_world(model, scratch.motion.x0);
    const Matrix3d part_axes = body.planar ? Matrix3d(scratch.motion.R0 * body.axes.transpose()) : scratch.motion.R0;
    row.frame_rotation.col(column) = wxyz(Eigen::Quaterniond(to_world(model, part_axes)));
    const Eigen::Index count = file_coordinate_count(body);
    file_coordinates(body, scratch, row.y.segment(y, count));
    file_rates(body, scratch, nodes, row.y_rate.segment(y, count));
    if (row.y_strain.size() > 0) strain_coordinates(body, scratch, row.y_strain.segment(y, count));
    const FrameAcceleration frame =
        frame_acceleration_of(body, scratch, nodes, evaluation.load_factor * model.superelements[i].gravity);
    row.frame_acceleration.col(column) = frame.felt;
    row.frame_angular_velocity.col(column) = frame.angular_velocity;
    row.frame_angular_acceleration.col(column) = frame.angular_acceleration;
    y += count;
    const auto cases = static_cast<Eigen::Index>(body.load_cases.size());
    if (cases > 0) row.load_factor.segment(load_case, cases) = scratch.forces.loads.factors;
    load_case += cases;
    for (std::size_t j = 0; j < body.node.size(); ++j, ++boundary) {
      const SuperelementNode& node = body.node[j];
      row.boundary_force.col(boundary).setZero();
      if (node.has_translation())
        row.boundary_force.col(boundary).head<3>() =
            to_world(model, translation_at(model, scratch.forces.r_B, node.translation_row));
      if (node.has_rotation())
        row.boundary_force.col(boundary).tail<3>() =
            to_world(model, Vector3d(nodes[j].R * rotation_at(model, scratch.forces.r_B, node.rotation_row)));
    }
  }
}

/// Fills the reactions of eliminated fixed joints, after those of the joints.
void fill_ties(const Model& model, const State& state, const double* lambda, Evaluation& evaluation,
               formats::ResultsRow& row) {
  if (model.ties.empty()) return;
  evaluate_ties(model, state, lambda, evaluation);
  for (std::size_t i = 0; i < model.ties.size(); ++i) {
    const JointReaction reaction = tie_reaction(model, i, evaluation);
    const auto column = static_cast<Eigen::Index>(model.joints.size() + i);
    row.joint_force.col(column) = reaction.force;
    row.joint_moment.col(column) = reaction.moment;
  }
}

/// Reaction of the thread of a screw; after evaluate_coordinates().
JointReaction thread_reaction(const Model& model, const Joint& joint, const double* lambda,
                              const Evaluation& evaluation) {
  if (joint.thread < 0) return {};
  const Coupling& thread = model.couplings[joint.thread];
  Row12 row = Row12::Zero();
  for (const CouplingTerm& term : thread.terms)
    row += (lambda[thread.row] * term.factor) * evaluation.coordinates[term.coordinate].G;
  return reaction_of(row, markers_of(joint, evaluation));
}

/// Fills reactions and coordinates of joints, after evaluate_coordinates().
void fill_joints(const Model& model, const State& state, const double* lambda, Evaluation& evaluation,
                 formats::ResultsRow& row) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const NodeMotion& a = motion_of(evaluation, joint.a.node);
    const NodeMotion& b = motion_of(evaluation, joint.b.node);
    const JointReaction reaction = joint_reaction(joint, a, b, lambda + joint.row);
    const auto column = static_cast<Eigen::Index>(i);
    const JointReaction thread = thread_reaction(model, joint, lambda, evaluation);
    row.joint_force.col(column) = reaction.force + thread.force;
    row.joint_moment.col(column) = reaction.moment + thread.moment;
  }
  fill_ties(model, state, lambda, evaluation, row);
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    row.joint_coordinate[i] = evaluation.coordinates[i].value;
    row.joint_rate[i] = evaluation.coordinates[i].rate;
  }
}

bool is_gear(const Coupling& coupling) { return coupling.motion < 0 && !coupling.thread; }

/// Fills the forces of drives, gears and racks along their coordinates.
void fill_couplings(const Model& model, const double* lambda, formats::ResultsRow& row) {
  Eigen::Index motion = 0, gear = 0;
  for (const Coupling& coupling : model.couplings) {
    const double force = -lambda[coupling.row];
    if (coupling.motion >= 0) row.motion_force[motion++] = force * coupling.terms.front().factor;
    if (!is_gear(coupling)) continue;
    row.coupling_second_force[gear] = force * coupling.terms.front().factor;
    row.coupling_first_force[gear++] = force * coupling.terms.back().factor;
  }
}

bool has_stops(const Spring& spring) { return spring.lower || spring.upper; }

/// Fills the forces of springs and stops, after evaluate_coordinates().
void fill_springs(const Model& model, const State& state, Evaluation& evaluation, formats::ResultsRow& row) {
  Eigen::Index stops = 0;
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const Spring& spring = model.springs[i];
    const CoordinateTerms& c = evaluation.coordinates[spring.coordinate];
    const SpringForce f = spring_force(spring, c.value, c.rate, applied_force(model, i, state.load_time(), evaluation));
    row.spring_force[i] = f.Q;
    if (has_stops(spring)) row.stop_force[stops++] = f.stop;
  }
}

void fill_bushings(const Model& model, const Evaluation& evaluation, formats::ResultsRow& row) {
  for (std::size_t i = 0; i < model.bushings.size(); ++i) {
    const JointReaction reaction =
        reaction_of(evaluation.bushings[i].force.transpose(), markers_of(model.bushings[i], evaluation));
    row.bushing_force.col(i) = reaction.force;
    row.bushing_moment.col(i) = reaction.moment;
  }
}

void fill_frictions(const Model& model, const Evaluation& evaluation, formats::ResultsRow& row) {
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const Joint& joint = model.joints[model.frictions[i].joint];
    const JointReaction reaction =
        reaction_of(evaluation.frictions[i].force.transpose(), markers_of(joint, evaluation));
    row.friction_force.col(i) = reaction.force;
    row.friction_moment.col(i) = reaction.moment;
  }
}

void fill_tyres(const Model& model, const Evaluation& evaluation, formats::ResultsRow& row) {
  for (std::size_t i = 0; i < model.tyres.size(); ++i) {
    const TyreTerms& tyre = evaluation.tyres[i];
    row.tyre_force.col(i) = tyre.force;
    row.tyre_moment.col(i) = tyre.moment;
    row.tyre_contact.col(i) =
        tyre.normal.isZero(0.0) ? tyre.contact : Eigen::Vector3d(to_world(model, tyre.contact) + model.origin);
    row.tyre_normal.col(i) = to_world(model, tyre.normal);
    row.tyre_slip[i] = tyre.slip;
    row.tyre_slip_angle[i] = tyre.slip_angle;
    row.tyre_camber[i] = tyre.camber;
    row.tyre_penetration[i] = tyre.penetration;
    row.tyre_rolling_radius[i] = tyre.rolling_radius;
    row.tyre_adhesion[i] = tyre.adhesion;
    row.tyre_deflection.col(i) = evaluation.treads[i].w;
    row.tyre_deflection_rate.col(i) = evaluation.treads[i].wd;
  }
}

void fill_loads(const Model& model, const Evaluation& evaluation, formats::ResultsRow& row) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) row.load.col(i) = evaluation.load_values[i];
  for (std::size_t i = 0; i < model.part_loads.size(); ++i)
    row.load.col(model.loads.size() + i) = evaluation.part_load_values[i] * model.part_loads[i].force;
}

void add_force_names(const Model& model, formats::ResultsLayout& layout) {
  for (const Spring& spring : model.springs) {
    const Relation& relation = model.coordinates[spring.coordinate].relation;
    layout.springs.push_back({spring.name, is_length(relation)});
    if (has_stops(spring)) layout.stops.push_back(layout.springs.back());
  }
  for (const Bushing& bushing : model.bushings) layout.bushings.push_back(bushing.name);
  for (const Tyre& tyre : model.tyres) {
    layout.tyres.push_back(tyre.name);
    layout.treads = layout.treads || tyre.relaxes();
  }
  for (const Load& load : model.loads) layout.loads.push_back({load.name, load.kind == formats::LoadKind::force});
  for (const PartLoad& load : model.part_loads) layout.loads.push_back({load.name, true});
  for (const Friction& friction : model.frictions) layout.frictions.push_back(model.joints[friction.joint].name);
}

/// Nodes of a modal body. They are stored consecutively in the order of the bodies.
auto nodes_of(const Model& model, std::size_t body) {
  return std::ranges::equal_range(model.modal_nodes, static_cast<int>(body), {}, &ModalNode::body);
}

/// Name of a node within its body.
std::string own_name(const Model& model, const ModalNode& node) {
  const std::string& body = model.modal_bodies[node.body].name;
  return node.name.starts_with(body + "/") ? node.name.substr(body.size() + 1) : node.name;
}

/// Wrench on a node, [force; moment about the node] in axes of the part.
Vector6d received(const Model& model, const ModalNode& node, const Vector6d& residual, const Evaluation& evaluation) {
  const ModalBody& body = model.modal_bodies[node.body];
  const Matrix3d to_part = body.axes * motion_of(evaluation, body.node).R.transpose();
  Vector6d force;
  force.head<3>() = -(to_part * residual.head<3>());
  force.tail<3>() = -(to_part * (motion_of(evaluation, node.node).R * residual.tail<3>()));
  return force;
}

/// Adds names and offsets of modal bodies, and of those of their nodes on which something acts.
void add_modal_names(const Model& model, formats::ResultsLayout& layout) {
  layout.modal_offset = layout.modal_node_offset = {0};
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    layout.modal_bodies.push_back(body.name);
    layout.modal_offset.push_back(layout.modal_offset.back() + body.modes_in_space());
    for (const ModalNode& node : nodes_of(model, i))
      if (node.active) layout.modal_nodes.push_back(own_name(model, node));
    layout.modal_node_offset.push_back(count_of(layout.modal_nodes));
  }
}

/// Fills the motion of the frames of modal bodies in axes of their parts, after evaluate().
void fill_modal_frames(const Model& model, const Evaluation& evaluation, formats::ResultsRow& row) {
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const NodeMotion& frame = motion_of(evaluation, body.node);
    const auto column = static_cast<Eigen::Index>(i);
    row.modal.acceleration.col(column) =
        body.axes * (frame.R.transpose() * (frame.xdd - evaluation.load_factor * body.gravity));
    row.modal.angular_velocity.col(column) = body.axes * frame.Omega;
    row.modal.angular_acceleration.col(column) = body.axes * frame.Omegad;
  }
}

/// Fills the forces on nodes of modal bodies, after evaluate().
void fill_modal_forces(const Model& model, const Evaluation& evaluation, formats::ResultsRow& row) {
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < model.modal_nodes.size(); ++k)
    if (const ModalNode& node = model.modal_nodes[k]; node.active)
      row.modal.node_force.col(column++) = received(model, node, evaluation.modal_forces[k], evaluation);
}

void fill_bodies(const Model& model, const State& state, Evaluation& evaluation, formats::ResultsRow& row) {
  evaluate(model, state, evaluation);
  update_modal_nodes(model, evaluation);
  row.time = state.time();
  fill_places(model, evaluation, row);
  fill_superelements(model, evaluation, row);
  int first = 0;
  for (const ModalBody& body : model.modal_bodies) {
    const auto fill = [&](const auto& own, auto&& in_space) {
      if (body.planar)
        in_space = body.lift * own;
      else
        in_space = own;
    };
    const int modes = body.modes_in_space();
    fill(state.w().segment(body.offset, body.modes), row.w.segment(first, modes));
    fill(state.v().segment(model.sizes.first_modal() + body.offset, body.modes), row.w_rate.segment(first, modes));
    first += modes;
  }
  fill_modal_frames(model, evaluation, row);
}

/// Fills reactions, forces and energies, after evaluate() and update_modal_nodes().
void fill_actions(const Model& model, const State& state, Evaluation& evaluation, formats::ResultsRow& row) {
  evaluate_coordinates(model, state, evaluation);
  Eigen::VectorXd least;
  if (row.reactions && is_overconstrained(state)) least = least_norm_multipliers(model, evaluation, state);
  const double* lambda = least.size() > 0 ? least.data() : state.lambda().data();
  fill_joints(model, state, lambda, evaluation, row);
  fill_couplings(model, lambda, row);
  fill_springs(model, state, evaluation, row);
  fill_bushings(model, evaluation, row);
  fill_frictions(model, evaluation, row);
  fill_tyres(model, evaluation, row);
  fill_loads(model, evaluation, row);
  row.quantity = evaluation.channels;
  const Energy energy = evaluate_energy(model, evaluation);
  row.kinetic = energy.kinetic;
  row.strain = energy.strain;
  row.potential = energy.potential;
  row.total = energy.total();
  row.work = state.work();
  row.dissipated = state.dissipated();
  row.balance = row.total - state.initial_energy() - row.work + row.dissipated;
}

}  // namespace

void keep_chosen_places(const formats::Scene& scene, Model& model) {
  const std::vector<bool> chosen = formats::chosen_nodes(results_layout(model, scene), scene.file);
  std::vector<Place> places;
  std::vector<int> at(model.places.size(), -1);
  for (std::size_t i = 0; i < model.places.size(); ++i) {
    if (!chosen[i]) continue;
    at[i] = count_of(places);
    places.push_back(std::move(model.places[i]));
  }
  model.places = std::move(places);
  for (PlaceAlias& alias : model.place_aliases) alias.place = at[alias.place];
  std::erase_if(model.place_aliases, [](const PlaceAlias& alias) { return alias.place < 0; });
}

formats::ResultsLayout results_layout(const Model& model, const formats::Scene& scene) {
  formats::ResultsLayout layout;
  layout.scene = scene.name;
  layout.producer = producer("mechanism");
  layout.units = scene.units;
  for (const Place& place : model.places) layout.nodes.push_back(place.name);
  for (const PlaceAlias& alias : model.place_aliases) layout.node_aliases.push_back({alias.name, alias.place});
  layout.modes_offset = {0};
  layout.boundary_offset = {0};
  layout.load_case_offset = {0};
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    layout.superelements.push_back(model.superelements[i].name);
    layout.modes_offset.push_back(layout.modes_offset.back() + static_cast<int>(file_coordinate_count(body)));
    layout.boundary_offset.push_back(layout.boundary_offset.back() + count_of(body.node));
    for (const SuperelementNode& node : body.node) layout.boundary_nodes.push_back(node.name);
    layout.strained = layout.strained || body.second_order.stiffening;
    layout.stiffened.push_back(body.second_order.stiffening ? 1 : 0);
    for (const BodyLoadCase& load : body.load_cases) layout.load_cases.push_back(load.name);
    layout.load_case_offset.push_back(count_of(layout.load_cases));
  }
  add_modal_names(model, layout);
  for (const Joint& joint : model.joints) layout.joints.push_back(joint.name);
  for (const Tie& tie : model.ties) layout.joints.push_back(tie.name);
  for (const Coordinate& c : model.coordinates)
    layout.coordinates.push_back({c.name, c.relation.kind != RelationKind::angle});
  const auto is_length_at = [&](const CouplingTerm& term) {
    return is_length(model.coordinates[term.coordinate].relation);
  };
  for (const Coupling& coupling : model.couplings)
    if (is_gear(coupling))
      layout.couplings.push_back(
          {coupling.name, is_length_at(coupling.terms.back()), is_length_at(coupling.terms.front())});
  for (const Coupling& coupling : model.couplings)
    if (coupling.motion >= 0)
      layout.motions.push_back({scene.motions.at(static_cast<std::size_t>(coupling.motion)).name, coupling.length});
  add_force_names(model, layout);
  for (const Channel& channel : model.channels) {
    const bool is_angle = channel.coordinate >= 0 && !is_length(model.coordinates[channel.coordinate].relation);
    layout.quantities.push_back({channel.name, channel_unit(channel, is_angle, scene.units)});
  }
  layout.channels = scene.output.channels;
  layout.superelement_content_ids = model.superelement_content_ids;
  return layout;
}

void note_large_output(const formats::Scene& scene, const Model& model, double time, std::vector<std::string>& notes) {
  std::string large =
      large_output(scene, rows_to_come(scene, time), formats::bytes_of_row(results_layout(model, scene)));
  if (!large.empty()) notes.push_back(std::move(large));
}

void fill_row(const Model& model, const State& state, Evaluation& evaluation, formats::ResultsRow& row) {
  fill_bodies(model, state, evaluation, row);
  fill_actions(model, state, evaluation, row);
  fill_modal_forces(model, evaluation, row);
}

}  // namespace tisserand::mechanism
