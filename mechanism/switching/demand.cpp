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
  constexpr double most = 50.0, unsure = 0.1;
  const double resonance = 1.0 / std::max(std::abs(1.0 - r2) - unsure * r2, 1.0 / most);
  return std::max(resonance, r2 > 0.5 ? 2.0 : 1.0);
}

/// A part of nothing is nothing.
double part(double value, double whole) { return value == 0.0 ? 0.0 : value / whole; }

}  // namespace

Demand::Demand(const Model& whole, const std::vector<EffectUse>& uses, double tolerance, double start)
    : whole_(whole),
      tolerance_(tolerance),
      bodies_(whole.superelements.size()),
      place_(uses.size(), 0.0),
      force_(uses.size(), 0.0),
      start_(start) {
  for (std::size_t k = 0; k < uses.size(); ++k) {
    const auto use = std::ranges::find(whole.superelements, uses[k].owner, &SuperelementUse::name);
    TISSERAND_ENSURE(use != whole.superelements.end(), "no superelement '{}'", uses[k].owner);
    Body& body = bodies_[use - whole.superelements.begin()];
    (uses[k].effect == formats::Effect::flexibility ? body.flexibility : body.stiffening) = static_cast<int>(k);
    const SuperelementBody& constants = whole.superelement_bodies[use->body];
    body.compliance = &compliances_.try_emplace(use->body, constants).first->second;
    if (constants.second_order.stiffening)
      body.buckling = &buckling_.try_emplace(use->body, constants, *body.compliance).first->second;
  }
}

void Demand::begin_window() {
  std::ranges::fill(place_, 0.0);
  std::ranges::fill(force_, 0.0);
  for (Body& body : bodies_) {
    body.before = body.rate.size() > 0 ? body.rate : VectorXd(VectorXd::Zero(body.y.size()));
    body.after.resize(0);
  }
  extend_window();
}

void Demand::extend_window() {
  for (Body& body : bodies_) {
    body.rate.resize(0);
    body.change = body.tremor = {};
    body.u = body.f = body.rate_u = body.acceleration_f = body.stressed = 0.0;
  }
}

double Demand::of(std::size_t use) const {
  return std::max(place_[use], part(force_[use], tolerance_ * largest_force_));
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

/// y of the header.
VectorXd Demand::deformation_of(std::size_t superelement, const Evaluation& now, bool flexible) const {
  const Compliance& compliance = *bodies_[superelement].compliance;
  if (!flexible) return compliance.deformation(load_of(superelement, now));
  const LocalMotion<double>& motion = now.superelements[superelement].motion;
  VectorXd y(motion.y_B.size() + motion.y_I.size());
  y << motion.y_B, motion.y_I;
  return compliance.without_rigid_motion(y);
}

double Demand::bend(std::size_t superelement, const Evaluation& now) const {
  const Compliance* compliance = bodies_[superelement].compliance;
  return compliance == nullptr ? 0.0 : compliance->displacement(deformation_of(superelement, now, true));
}

std::vector<double> Demand::rates() const {
  std::vector<double> list;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const SuperelementBody& body = body_of(whole_, i);
    VectorXd rate = bodies_[i].rate;
    if (rate.size() == 0) rate.setZero(body.boundary_size + body.modes);
    list.insert(list.end(), rate.begin(), rate.end());
  }
  return list;
}

void Demand::set_rates(const std::vector<double>& rates) {
  const double* at = rates.data();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const int size = body_of(whole_, i).boundary_size + body_of(whole_, i).modes;
    bodies_[i].rate = Eigen::Map<const VectorXd>(at, size);
    at += size;
  }
}

Deformation Demand::deformation(std::size_t superelement) const {
  const Body& body = bodies_[superelement];
  const VectorXd &y = body.y, &before = body.before, &after = body.after;
  if (after.size() == 0) return {y, before};
  const VectorXd mean = 0.5 * (before + after);
  const Compliance& compliance = *body.compliance;
  if (compliance.strain_energy(after - before) < compliance.strain_energy(mean)) return {y, mean};
  return {y, compliance.strain_energy(before) < compliance.strain_energy(after) ? before : after};
}

/// To the next sample: from the second one of a window on there is a rate, from the third an acceleration.
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
    if (body.after.size() == 0) body.after = rate;
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

/// Of the bodies that sleep, which alone have to be foreseen; the others tell.
void Demand::add_carried(const Evaluation& now, CarriedInertia& inertia) {
  std::vector<VectorXd> rates, accelerations;
  for (const Body& body : bodies_) {
    rates.push_back(body.asleep ? body.rate : VectorXd());
    accelerations.push_back(body.asleep ? body.acceleration : VectorXd());
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

/// Of flexibility.
void Demand::note_asleep(const Body& body) {
  const double r2 = body.change.r2(), changing_r2 = body.tremor.r2(), frequency = body.tremor.frequency();
  const double period = frequency > 0.0 ? 1.0 / frequency : 0.0;  // over 2π
  const double u =
      std::max(amplification(r2) * body.u, body.u + (amplification(changing_r2) - 1.0) * period * body.rate_u);
  note(body.flexibility, part(u, tolerance_ * whole_.length),
       std::min(changing_r2, 1.0) * body.tremor.amplitude_of(body.acceleration_f));
}

void Demand::note(int use, double place, double force) {
  if (use < 0) return;
  place_[use] = std::max(place_[use], place);
  force_[use] = std::max(force_[use], force);
}

/// Eigenvalues only where they can decide: over a bound, and more so than before in this window.
void Demand::sample_stress(Body& body, bool flexible) {
  constexpr double allowed = 0.1, tells = 0.2, grown = 1.1;
  if (body.buckling == nullptr) return;
  const double bound = body.buckling->bound(body.y) / allowed;
  if (bound <= tells || bound <= grown * body.stressed) return;
  body.stressed = bound;
  const double demand = body.buckling->load_share(body.y) / allowed;
  note(body.flexibility, demand, 0.0);
  if (flexible) note(body.stiffening, demand, 0.0);
}

void Demand::note_body(std::size_t superelement, const Evaluation& now, bool flexible) {
  Body& body = bodies_[superelement];
  const LocalMotion<double>& motion = now.superelements[superelement].motion;
  const double u = part(body.u, tolerance_ * whole_.length);
  if (flexible) {
    VectorXd acceleration(body.y.size());
    acceleration << motion.acceleration_B, motion.acceleration_I;
    note(body.flexibility, u, body.compliance->inertia_force(acceleration));
  } else {
    note_asleep(body);
  }
  if (body.stiffening >= 0 && flexible) {
    const double share = stiffening_share(superelement, now);
    note(body.stiffening, share * u, share * body.f);
  }
  sample_stress(body, flexible);
}

void Demand::sample(const State& state, const Evaluation& now, const std::vector<bool>& awake, double largest_force,
                    CarriedInertia& inertia) {
  const double dt = state.time() - time_, elapsed = state.time() - start_;
  growing_ = (largest_force - largest_force_) * elapsed > largest_force_ * dt;
  largest_force_ = largest_force;
  time_ = state.time();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (body.compliance == nullptr) continue;
    body.asleep = body.flexibility >= 0 && !awake[body.flexibility];
    move_on(body, deformation_of(i, now, !body.asleep), state.time());
  }
  add_carried(now, inertia);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].compliance != nullptr) note_body(i, now, !bodies_[i].asleep);
}

}  // namespace tisserand::mechanism
