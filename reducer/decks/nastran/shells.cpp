// SPDX-License-Identifier: GPL-3.0-or-later
// Shells of the mesh from CQUAD4, CQUADR, CTRIA3 and CTRIAR of a Nastran deck.
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

/// THETA (real) turns from the side G1-G2. MCID (integer) projects the first axis of a coordinate system at the middle.
void read_material_axis(NastranModel& model, CardFields& f, int index, ShellElement& shell) {
  if (f.blank(index) || !f.ok()) return;
  const Eigen::Vector3d n = normal_of(model.deck.mesh, shell).normalized();
  if (const std::optional<long> id = parse_integer(f.text(index)); id) {
    const int row = model.frame(f, index, "MCID");
    if (row < 0) return;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int node : nodes_of(shell)) middle += model.position(node) / shell.corners();
    shell.material_x = frame_axes_at(model.frames.frames[row], middle).col(0);
    if (!(shell.material_x.cross(n).norm() > 1e-6))
      f.fault(fmt::format("the x axis of coordinate system {} is perpendicular to the element", *id),
              "choose another MCID");
    return;
  }
  const double angle = f.real(index, "THETA") * degree;
  if (angle == 0.0 || !f.ok()) return;
  const Eigen::Vector3d side = model.position(shell.nodes[1]) - model.position(shell.nodes[0]);
  const Eigen::Vector3d e = (side - n * n.dot(side)).normalized();
  shell.material_x = std::cos(angle) * e + std::sin(angle) * n.cross(e);
}

/// T of the PSHELL; 0 for other properties.
double property_thickness(NastranModel& model, long pid) {
  const auto card = model.properties.shell.card.find(pid);
  if (card == model.properties.shell.card.end()) return 0.0;
  return parse_real(model.cards.field(model.cards.cards[card->second], 2)).value_or(0.0);
}

/// Mean of T1 to T4 (TFLAG 1: of fractions of the property's T); 0 if all are blank.
double read_thickness(NastranModel& model, CardFields& f, long pid, int corners) {
  if (f.size() <= 10) return 0.0;
  bool given = false;
  for (int i = 0; i < corners; ++i) given = given || !f.blank(10 + i);
  if (!given) return 0.0;
  const double property = property_thickness(model, pid);
  const double unit = f.integer(9, "TFLAG", 0) == 1 ? property : 1.0;
  double sum = 0.0, least = 0.0, most = 0.0;
  for (int i = 0; i < corners && f.ok(); ++i) {
    const double t = f.blank(10 + i) ? property : unit * f.real(10 + i, fmt::format("T{}", i + 1));
    if (!(t > 0.0)) f.fault(fmt::format("T{} {:g} must be positive", i + 1, t), "give the thickness");
    sum += t;
    least = i == 0 ? t : std::min(least, t);
    most = i == 0 ? t : std::max(most, t);
  }
  if (f.ok() && most > least * (1.0 + 1e-9))
    model.remarks.add("shells with different thickness at their corners get the mean thickness", f.label());
  return sum / corners;
}

void add_shell(NastranModel& model, CardFields& f, int corners) {
  ShellElement shell;
  shell.id = model.element_id(f);
  const long pid = f.blank(1) ? shell.id : f.id(1, "PID");
  for (int i = 0; i < corners; ++i) shell.nodes[i] = model.node(f, 2 + i, "G");
  if (!f.ok()) return;
  for (int i = 0; i < corners; ++i)
    for (int j = 0; j < i; ++j)
      if (shell.nodes[i] == shell.nodes[j])
        return f.fault(fmt::format("GRID {} is at two corners", f.text(2 + i)), "give each corner its own grid point");
  read_material_axis(model, f, 2 + corners, shell);
  shell.offset = f.real(3 + corners, "ZOFFS", 0.0);
  const double thickness = read_thickness(model, f, pid, corners);
  if (!f.ok()) return;
  const PropertyRow property = shell_property(model, f, pid, thickness);
  if (property.row < 0) return;
  shell.property = property.row;
  shell.offset += property.offset;
  model.of_property[pid].shells.push_back(add_row(model.deck.mesh.shells, shell));
}

}  // namespace

void add_shells(NastranModel& model) {
  for (const char* name : {"CQUAD4", "CQUADR"}) model.for_each(name, [&](CardFields& f) { add_shell(model, f, 4); });
  for (const char* name : {"CTRIA3", "CTRIAR"}) model.for_each(name, [&](CardFields& f) { add_shell(model, f, 3); });
}

}  // namespace tisserand::reducer
