// Loads, deformations and their sizes at the samples of a window.
#include "mechanism/switching/demand.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::VectorXd;

/// A of the header.
double amplification(double r2) {
  constexpr double most = 50.0;
  const double resonance = std::min(1.0 / std::max(std::abs(1.0 - r2), 1.0 / most), most);
  return std::max(resonance, r2 > 0.5 ? 2.0 : 1.0);
}

/// A part of nothing is nothing.
double part(double value, double whole) { return value == 0.0 ? 0.0 : value / whole; }

}  // namespace

Demand::Demand(const Model& whole, const std::vector<EffectUse>& uses, double tolerance)
    : whole_(whole), tolerance_(tolerance), bodies_(whole.superelements.size()), largest_(uses.size(), 0.0) {
  for (std::size_t k = 0; k < uses.size(); ++k) {
    const auto use = std::ranges::find(whole.superelements, uses[k].body, &SuperelementUse::name);
    TISSERAND_ENSURE(use != whole.superelements.end(), "no superelement '{}'", uses[k].body);
    Body& body = bodies_[use - whole.superelements.begin()];
    (uses[k].effect == formats::Effect::flexibility ? body.flexibility : body.stiffening) = static_cast<int>(k);
    body.compliance = &compliances_.try_emplace(use->body, whole.superelement_bodies[use->body]).first->second;
  }
}

void Demand::begin_window() {
  std::ranges::fill(largest_, 0.0);
  for (Body& body : bodies_) body.kinetic = body.strain = body.u = body.f = 0.0;
}

void Demand::forget() {
  begin_window();
  for (Body& body : bodies_) body.seen = false;
}

/// What is left over at the nodes of a body that does not deform, in axes of its frame, which its nodes have.
VectorXd Demand::load_of(std::size_t superelement, const Evaluation& now) const {
  const SuperelementBody& body = body_of(whole_, superelement);
  const SuperelementScratch& scratch = now.superelements[superelement];
  VectorXd load(body.boundary_size + body.modes);
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const SuperelementNode& local = body.node[j];
    const Node& node = whole_.nodes[whole_.superelements[superelement].nodes[j]];
    if (local.has_translation())
      load.segment<3>(local.translation_row) =
          -scratch.motion.R0.transpose() * now.residual.segment<3>(node.translation);
    if (local.has_rotation()) load.segment<3>(local.rotation_row) = -now.residual.segment<3>(node.rotation);
  }
  load.tail(body.modes) = -scratch.forces.r_I;
  return load;
}

/// ρ of the header.
double Demand::stiffening_share(std::size_t superelement, const Evaluation& now) const {
  const LocalMotion<double>& motion = now.superelements[superelement].motion;
  VectorXd y(motion.y_B.size() + motion.y_I.size());
  y << motion.y_B, motion.y_I;
  const double elastic = 2.0 * bodies_[superelement].compliance->strain_energy(y);
  return part(std::abs(y.dot(now.superelements[superelement].forces.strain.force)), elastic);
}

void Demand::sample_body(std::size_t superelement, const State& state, const Evaluation& now, bool flexible,
                         double largest_force) {
  Body& body = bodies_[superelement];
  const Compliance& compliance = *body.compliance;
  const LocalMotion<double>& motion = now.superelements[superelement].motion;
  VectorXd y(motion.y_B.size() + motion.y_I.size());
  if (flexible) {
    y << motion.y_B, motion.y_I;
    y = compliance.without_rigid_motion(y);
  } else {
    y = compliance.deformation(load_of(superelement, now));
  }
  if (body.seen && state.time() > body.time) {
    body.kinetic += compliance.kinetic_energy((y - body.y) / (state.time() - body.time));
    body.strain += compliance.strain_energy(0.5 * (y + body.y));
  }
  body.y = y;
  body.time = state.time();
  body.seen = true;
  const double r2 = part(body.kinetic, body.strain);
  body.u = std::max(body.u, compliance.displacement(y));
  body.f = std::max(body.f, compliance.force(y));
  const double u = part(body.u, tolerance_ * whole_.length), f = part(body.f, tolerance_ * largest_force);
  const auto note = [this](int use, double demand) {
    if (use >= 0) largest_[use] = std::max(largest_[use], demand);
  };
  if (flexible) {
    VectorXd acceleration(y.size());
    acceleration << motion.acceleration_B, motion.acceleration_I;
    note(body.flexibility, std::max(u, part(compliance.inertia_force(acceleration), tolerance_ * largest_force)));
  } else {
    note(body.flexibility, std::max(amplification(r2) * u, std::min(r2, 1.0) * f));
  }
  if (body.stiffening >= 0 && flexible) note(body.stiffening, stiffening_share(superelement, now) * std::max(u, f));
}

void Demand::sample(const State& state, const Evaluation& now, const std::vector<bool>& awake, double largest_force) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    if (body.compliance == nullptr) continue;
    sample_body(i, state, now, body.flexibility < 0 || awake[body.flexibility], largest_force);
  }
}

}  // namespace tisserand::mechanism
