// SPDX-License-Identifier: GPL-3.0-or-later
// Demands from loads and deformations at the samples of a window.
#include "mechanism/switching/demand.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "mechanism/switching/deformation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::VectorXd;

/// Amplification A of the header.
double amplification(double r2) {
  constexpr double most = 50.0, unsure = 0.1;
  const double resonance = 1.0 / std::max(std::abs(1.0 - r2) - unsure * r2, 1.0 / most);
  return std::max(resonance, r2 > 0.5 ? 2.0 : 1.0);
}

/// Quotient; zero if the value is zero.
double part(double value, double whole) { return value == 0.0 ? 0.0 : value / whole; }

}  // namespace

Demand::Demand(const Model& whole, const std::vector<EffectUse>& uses, double tolerance, double start)
    : whole_(whole),
      tolerance_(tolerance),
      bodies_(deforming_bodies(whole)),
      judged_(uses.size()),
      start_(start),
      time_(start) {
  for (int k = 0; k < std::ssize(uses); ++k) {
    if (uses[k].on) continue;
    const std::size_t index = deforming_body(whole, uses[k].owner);
    TISSERAND_ENSURE(index < bodies_.size(), "no body '{}' that deforms", uses[k].owner);
    Body& body = bodies_[index];
    (uses[k].effect == formats::Effect::flexibility ? body.flexibility : body.stiffening) = k;
    if (const int modal = modal_body_of(whole, index); modal >= 0)
      body.compliance = &modal_compliances_.try_emplace(modal, whole, static_cast<std::size_t>(modal)).first->second;
    else
      add_superelement(whole.superelements[index], body);
  }
}

void Demand::add_superelement(const SuperelementUse& use, Body& body) {
  const SuperelementBody& constants = whole_.superelement_bodies[use.body];
  const SuperelementCompliance& compliance = compliances_.try_emplace(use.body, constants).first->second;
  body.compliance = &compliance;
  if (constants.second_order.stiffening)
    body.buckling = &buckling_.try_emplace(use.body, constants, compliance).first->second;
}

void Demand::begin_window() {
  for (Body& body : bodies_) {
    body.rate.resize(0);
    body.change = body.tremor = {};
    body.u = body.f = body.rate_u = body.acceleration_f = 0.0;
  }
}

double Demand::modal_force() const {
  double largest = 0.0;
  for (std::size_t i = whole_.superelements.size(); i < bodies_.size(); ++i) largest = std::max(largest, bodies_[i].f);
  return largest;
}

double Demand::of(std::size_t use, bool ended) const {
  const Judged& judged = judged_[use];
  if (!(largest_force_ > 0.0) || (growing_ && !ended)) return judged.place;  // or no force yet: round-off
  return std::max(judged.place, judged.force / (tolerance_ * largest_force_));
}

/// Load g on a body that does not deform: minus the residual at its nodes, in axes of its frame, which its nodes have,
/// and at its modes.
VectorXd Demand::load_of(std::size_t index, const Evaluation& now) const {
  VectorXd load = VectorXd::Zero(deformation_size(whole_, index));
  if (const int modal = modal_body_of(whole_, index); modal >= 0) {
    const ModalBody& body = whole_.modal_bodies[modal];
    load.tail(body.modes) = -now.residual.segment(whole_.sizes.first_modal() + body.offset, body.modes);
    return load;
  }
  const SuperelementBody& body = body_of(whole_, index);
  const SuperelementScratch& scratch = now.superelements[index];
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const SuperelementNode& local = body.node[j];
    const Node& node = whole_.nodes[whole_.superelements[index].nodes[j]];
    if (local.has_translation())
      load.segment<3>(local.translation_row) =
          -scratch.motion.R0.transpose() * now.residual.segment<3>(node.translation);
    if (local.has_rotation()) load.segment<3>(local.rotation_row) = -now.residual.segment<3>(node.rotation);
  }
  load.tail(body.modes) = -scratch.forces.r_I;
  return load;
}

/// Ratio ρ of the header.
double Demand::stiffening_share(std::size_t index, const Evaluation& now) const {
  const VectorXd y = y_of(whole_, index, now);
  const double elastic = 2.0 * bodies_[index].compliance->strain_energy(y);
  return part(std::abs(y.dot(now.superelements[index].forces.strain.force)), elastic);
}

double Demand::Change::frequency() const {
  if (!(strain > 0.0 && strain_rate > 0.0)) return 0.0;
  const double half = 0.5 * time / count;
  return std::atan(half * std::sqrt(strain_rate / strain)) / half;
}

double Demand::Change::amplitude_of(double acceleration) const {
  if (count == 0) return 0.0;
  const double half = 0.5 * time / count, sine = std::sin(half * frequency()) / half;
  return sine > 0.0 ? acceleration / (sine * sine) : 0.0;
}

double Demand::Change::r2() const {
  if (!(strain_rate > 0.0)) return part(kinetic, strain);
  return frequency() * frequency() * kinetic / strain_rate;
}

/// Deformation y of the header; for a deforming body its own deformation.
VectorXd Demand::deformation_at(std::size_t index, const Evaluation& now) const {
  const Compliance& compliance = *bodies_[index].compliance;
  if (bodies_[index].flexibility >= 0) return compliance.deformation(load_of(index, now));
  return compliance.without_rigid_motion(y_of(whole_, index, now));
}

/// Adds a sample. From the second one of a window on there is a rate, from the third an acceleration.
void Demand::move_on(Body& body, VectorXd y, double time) const {
  const Compliance& compliance = *body.compliance;
  body.acceleration.resize(0);
  const auto add = [&compliance](Change& change, const VectorXd& middle, const VectorXd& rate, double dt) {
    change.kinetic += compliance.kinetic_energy(rate);
    change.strain += compliance.strain_energy(middle);
    change.strain_rate += compliance.strain_energy(rate);
    change.time += dt;
    ++change.count;
  };
  if (body.seen && time > body.time) {
    const double dt = time - body.time, middle = 0.5 * (time + body.time);
    VectorXd rate = (y - body.y) / dt;
    add(body.change, 0.5 * (y + body.y), rate, dt);
    if (body.rate.size() > 0) {
      body.acceleration = (rate - body.rate) / (middle - body.rate_time);
      add(body.tremor, 0.5 * (rate + body.rate), body.acceleration, middle - body.rate_time);
      body.acceleration_f = std::max(body.acceleration_f, compliance.force(body.acceleration));
    }
    body.rate = std::move(rate);
    body.rate_time = middle;
    body.rate_u = std::max(body.rate_u, compliance.displacement(body.rate));
  }
  body.u = std::max(body.u, compliance.displacement(y));
  body.f = std::max(body.f, compliance.force(y));
  body.y = std::move(y);
  body.time = time;
  body.seen = true;
}

/// Adds carried inertia to bodies that do not deform. Those that deform contain it in their motion.
void Demand::add_carried(const Evaluation& now, CarriedInertia& inertia) {
  std::vector<VectorXd> rates, accelerations;
  for (const Body& body : bodies_) {
    rates.push_back(body.flexibility >= 0 ? body.rate : VectorXd());
    accelerations.push_back(body.flexibility >= 0 ? body.acceleration : VectorXd());
  }
  const auto moves = [](const std::vector<VectorXd>& list) {
    return std::ranges::any_of(list, [](const VectorXd& one) { return one.size() > 0; });
  };
  if (!moves(rates)) return;
  const std::vector<double> more = inertia.energies(rates, now);
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].change.kinetic += more[i];
  if (!moves(accelerations)) return;
  const std::vector<double> changing = inertia.energies(accelerations, now);
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].tremor.kinetic += changing[i];
}

void Demand::note(int use, double place, double force) {
  if (use < 0) return;
  Judged& judged = judged_[use];
  if (!(place > judged.place || force > judged.force)) return;
  judged.place = std::max(judged.place, place);
  judged.force = std::max(judged.force, force);
  judged.time = time_;
}

/// Computes eigenvalues only where they can decide: above a bound, and larger than before.
void Demand::sample_stress(Body& body) {
  constexpr double allowed = 0.1, reports_it = 0.2, grown = 1.1;
  if (body.buckling == nullptr) return;
  const double bound = body.buckling->bound(body.y) / allowed;
  if (bound <= reports_it || bound <= grown * body.stressed) return;
  body.stressed = bound;
  note(body.flexibility >= 0 ? body.flexibility : body.stiffening, body.buckling->load_share(body.y) / allowed, 0.0);
}

void Demand::note_body(std::size_t index, const Evaluation& now) {
  Body& body = bodies_[index];
  const double u = part(body.u, tolerance_ * whole_.length);
  if (body.flexibility >= 0) {
    const double r2 = body.change.r2(), changing_r2 = body.tremor.r2(), frequency = body.tremor.frequency();
    const double period = frequency > 0.0 ? 1.0 / frequency : 0.0;  // divided by 2π
    const double trembling = (amplification(changing_r2) - 1.0) * period * body.rate_u;
    note(body.flexibility, std::max(amplification(r2) * u, u + part(trembling, tolerance_ * whole_.length)),
         std::min(changing_r2, 1.0) * body.tremor.amplitude_of(body.acceleration_f));
  } else {
    const double share = stiffening_share(index, now);
    note(body.stiffening, share * u, share * body.f);
  }
  sample_stress(body);
}

void Demand::sample(const State& state, const Evaluation& now, double largest_force, CarriedInertia& inertia) {
  if (begins_window()) begin_window();
  const double dt = state.time() - time_, elapsed = state.time() - start_;
  growing_ = (largest_force - largest_force_) * elapsed > largest_force_ * dt;
  largest_force_ = largest_force;
  time_ = state.time();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].compliance != nullptr) move_on(bodies_[i], deformation_at(i, now), state.time());
  add_carried(now, inertia);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].compliance != nullptr) note_body(i, now);
  ++samples_;
}

}  // namespace tisserand::mechanism
