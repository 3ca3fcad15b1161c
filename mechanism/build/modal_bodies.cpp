// Constants of modal bodies in the units of the scene.
#include "mechanism/build/modal_bodies.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;

int count_modes(const formats::ModalBody& file, const formats::ModalBodySpec& spec, const UnitConversion& units) {
  const int all = static_cast<int>(file.modes());
  if (spec.modes && *spec.modes > all)
    throw Error(fmt::format("body '{}': {} modes are asked for, the file has {}", spec.name, *spec.modes, all),
                spec.where, "ask for fewer, or write a file with more");
  if (static_cast<int>(spec.damping.ratios.size()) > all)
    throw Error(fmt::format("body '{}': damping: {} ratios for {} modes", spec.name, spec.damping.ratios.size(), all),
                spec.where, "give one ratio per mode at most");
  if (spec.modes) return *spec.modes;
  if (!spec.cutoff) return all;
  const double limit = 2.0 * std::numbers::pi * *spec.cutoff * units.time;
  int count = 0;
  while (count < all && std::sqrt(file.omega2[count]) < limit) ++count;
  return count;
}

void set_integrals(const formats::ModalIntegrals& sums, const UnitConversion& units, ModalBody& body) {
  const Index m = body.modes;
  const double root = std::sqrt(units.mass), l = units.length;
  body.mass = units.mass * sums.mass;
  body.c0 = units.mass * l * sums.c0;
  body.C1 = root * sums.C1.leftCols(m);
  body.P0 = units.mass * l * l * sums.P0;
  body.P1 = root * l * sums.P1.head(9 * m);
  body.P2 = sums.P2.topLeftCorner(9 * m, m);
  body.J_mu = units.mass * l * l * sums.J_mu;
  body.N_mu = root * l * sums.N_mu.leftCols(m);
}

void set_stiffness(const formats::ModalBody& file, const formats::Damping& damping, const UnitConversion& units,
                   ModalBody& body) {
  body.stiffness = file.omega2.head(body.modes) / (units.time * units.time);
  body.damping.resize(body.modes);
  for (Index j = 0; j < body.modes; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const double ratio = file.zeta[j] + (at < damping.ratios.size() ? damping.ratios[at] : damping.ratio);
    body.damping[j] = damping.mass + damping.stiffness * body.stiffness[j] + 2.0 * ratio * std::sqrt(body.stiffness[j]);
  }
}

/// Whether the rotation of node k is known: it has rows, or it is held in all three by the reference conditions.
bool node_turns(const formats::ModalBody& file, std::size_t k) {
  if (file.modes() == 0 || !file.X[k].bottomRows<3>().isZero(0.0)) return true;
  int held = 0;
  for (std::size_t i = 0; i < file.reference_node.size(); ++i)
    if (file.reference_node[i] == static_cast<int>(k) && file.reference_component[i] >= 3) ++held;
  return held == 3;
}

}  // namespace

BuiltModalBody build_modal_body(const formats::ModalBody& file, const formats::ModalBodySpec& spec,
                                const UnitConversion& units) {
  BuiltModalBody built;
  ModalBody& body = built.body;
  body.name = spec.name;
  body.modes = count_modes(file, spec, units);
  set_integrals(file.integrals, units, body);
  set_stiffness(file, spec.damping, units, body);
  if (!spec.terms.damping) body.damping.setZero();
  const double root = std::sqrt(units.mass);
  for (std::size_t k = 0; k < file.node_name.size(); ++k) {
    ModalNode node;
    node.name = file.node_name[k];
    node.turns = node_turns(file, k);
    node.x = units.length * file.node_position.row(k).transpose();
    node.Xd = file.X[k].topRows<3>().leftCols(body.modes) / root;
    node.Xt = file.X[k].bottomRows<3>().leftCols(body.modes) / (root * units.length);
    built.nodes.push_back(std::move(node));
  }
  built.frame_position = units.length * file.frame_position;
  const Eigen::Vector4d& q = file.frame_orientation;
  built.frame_rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return built;
}

}  // namespace tisserand::mechanism
