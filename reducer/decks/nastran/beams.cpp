// SPDX-License-Identifier: GPL-3.0-or-later
// Beams of the mesh from CBAR, CBEAM, CROD, CTUBE and CONROD of a Nastran deck.
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"
#include "reducer/elements/beam/beam.hpp"

namespace tisserand::reducer {
namespace {

/// BAROR or BEAMOR: values for blank fields.
struct BeamDefaults {
  std::optional<CardFields> card;
};

/// Frames of OFFT: first letter for the orientation (G: CD of GA, B: basic), then for the offsets (G: CD, O: element).
struct OffsetFrames {
  char orientation = 'G', first = 'G', second = 'G';
};

OffsetFrames read_offt(CardFields& f, const BeamDefaults& defaults) {
  std::string word = capitals(f.text(7));
  if (word.empty() && defaults.card) word = capitals(defaults.card->text(7));
  if (word.empty() || word == "0" || word == "1" || word == "2") return {};  // numbers: F of old decks, X or G0
  const auto either = [](char c, char a, char b) { return c == a || c == b; };
  if (word.size() != 3 || !either(word[0], 'G', 'B') || !either(word[1], 'G', 'O') || !either(word[2], 'G', 'O')) {
    f.fault(fmt::format("OFFT '{}' is not understood", word), "give three letters: G or B, then G or O, then G or O");
    return {};
  }
  return {word[0], word[1], word[2]};
}

/// Vector v in part axes: to the grid point G0, or X1, X2, X3 in the frame of OFFT.
Eigen::Vector3d orientation(NastranModel& model, CardFields& f, const BeamDefaults& defaults, int first, char frame) {
  const bool own = !(f.blank(4) && f.blank(5) && f.blank(6));
  CardFields from = own || !defaults.card ? f : *defaults.card;
  const bool by_grid = parse_integer(from.text(4)).value_or(0) > 0 && from.blank(5) && from.blank(6);
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  if (by_grid) {
    const int node = model.node(from, 4, "G0");
    if (node >= 0) v = model.position(node) - model.position(first);
  } else {
    v = from.vector(4, "X");
    if (frame == 'G') v = model.displacement_axes(first) * v;
  }
  if (own || !defaults.card) f = from;
  return v;
}

std::optional<Eigen::Matrix3d> axes_or_fault(CardFields& f, const Eigen::Vector3d& axis, const Eigen::Vector3d& v) {
  if (!f.ok()) return std::nullopt;
  if (!(axis.norm() > 0.0)) return f.refuse("the ends of the axis coincide", "correct the grid points or the offsets");
  const std::optional<Eigen::Matrix3d> axes = v.norm() > 0.0 ? beam_axes(axis, v) : std::nullopt;
  if (!axes)
    f.fault(fmt::format("orientation ({:g}, {:g}, {:g}) is zero or parallel to the axis", v.x(), v.y(), v.z()),
            "give X1, X2, X3 or G0 so that the vector is not parallel to the axis");
  return axes;
}

void add_beam(NastranModel& model, CardFields& f, const BeamDefaults& defaults) {
  BeamElement beam;
  beam.id = model.element_id(f);
  long pid = f.id_or_none(1, "PID");
  if (pid == 0 && defaults.card) pid = CardFields(*defaults.card).id_or_none(1, "PID");
  if (pid == 0) pid = beam.id;
  beam.first = model.node(f, 2, "GA");
  beam.second = model.node(f, 3, "GB");
  const OffsetFrames frames = read_offt(f, defaults);
  const Components PA = f.components(8, "PA", 0), PB = f.components(9, "PB", 0);
  if (!f.ok()) return;
  const Eigen::Vector3d v = orientation(model, f, defaults, beam.first, frames.orientation);
  if (!f.ok()) return;
  const Eigen::Vector3d between = model.position(beam.second) - model.position(beam.first);
  Eigen::Matrix3d plain = Eigen::Matrix3d::Identity();  // axes of the element without offsets
  if (frames.first == 'O' || frames.second == 'O') {
    const std::optional<Eigen::Matrix3d> axes = axes_or_fault(f, between, v);
    if (!axes) return;
    plain = *axes;
  }
  const auto to_part = [&](const Eigen::Vector3d& w, int node, char frame) -> Eigen::Vector3d {
    if (w.isZero(0.0)) return w;
    return (frame == 'O' ? plain : model.displacement_axes(node)) * w;
  };
  beam.first_offset = to_part(f.vector(10, "WA"), beam.first, frames.first);
  beam.second_offset = to_part(f.vector(13, "WB"), beam.second, frames.second);
  const std::optional<Eigen::Matrix3d> axes = axes_or_fault(f, between + beam.second_offset - beam.first_offset, v);
  if (!axes) return;
  beam.R_PE = *axes;
  beam.released = static_cast<std::uint16_t>(PA | (PB << 6));
  if (f.id_or_none(16, "SA") + f.id_or_none(17, "SB") > 0)
    model.remarks.add("warping degrees of freedom SA, SB are ignored", f.label());
  beam.property = beam_property(model, f, pid);
  if (beam.property < 0) return;
  model.of_property[pid].beams.push_back(add_row(model.deck.mesh.beams, beam));
}

BeamDefaults read_defaults(NastranModel& model, const char* name) {
  BeamDefaults defaults;
  model.for_each(name, [&](CardFields& f) {
    if (defaults.card) f.fault(fmt::format("a deck can have only one {}", name), "remove the others");
    defaults.card = f;
  });
  return defaults;
}

struct Rod {
  BeamElement beam;
  long pid = 0;  ///< 0: CONROD
};

/// Sets axes with x along the rod and any y.
bool set_rod_axes(NastranModel& model, CardFields& f, BeamElement& beam) {
  if (!f.ok()) return false;
  const Eigen::Vector3d axis = model.position(beam.second) - model.position(beam.first);
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const std::optional<Eigen::Matrix3d> axes = axes_or_fault(f, axis, Eigen::Vector3d::Unit(least));
  if (axes) beam.R_PE = *axes;
  return axes.has_value();
}

std::vector<Rod> read_rods(NastranModel& model) {
  std::vector<Rod> rods;
  for (const char* name : {"CROD", "CTUBE"})
    model.for_each(name, [&](CardFields& f) {
      for (const int at : {0, 4}) {  // a card has one or two
        if (at > 0 && f.blank(at) && f.blank(at + 1) && f.blank(at + 2) && f.blank(at + 3)) break;
        Rod rod;
        rod.beam.id = model.element_id(f, at);
        rod.pid = f.blank(at + 1) ? rod.beam.id : f.id(at + 1, "PID");
        rod.beam.first = model.node(f, at + 2, "G1");
        rod.beam.second = model.node(f, at + 3, "G2");
        if (!set_rod_axes(model, f, rod.beam)) return;
        rod.beam.property = rod_property(model, f, rod.pid);
        if (rod.beam.property >= 0) rods.push_back(rod);
      }
    });
  model.for_each("CONROD", [&](CardFields& f) {
    Rod rod;
    rod.beam.id = model.element_id(f);
    rod.beam.first = model.node(f, 1, "G1");
    rod.beam.second = model.node(f, 2, "G2");
    const RodConstants constants{f.real(4, "A"), f.real(5, "J", 0.0), f.real(7, "NSM", 0.0)};
    if (!set_rod_axes(model, f, rod.beam)) return;
    rod.beam.property = add_rod_property(model, f, 3, constants);
    if (rod.beam.property >= 0) rods.push_back(rod);
  });
  return rods;
}

}  // namespace

void add_beams(NastranModel& model) {
  const BeamDefaults bar = read_defaults(model, "BAROR"), beam = read_defaults(model, "BEAMOR");
  model.for_each("CBAR", [&](CardFields& f) { add_beam(model, f, bar); });
  model.for_each("CBEAM", [&](CardFields& f) { add_beam(model, f, beam); });
}

void add_rods(NastranModel& model) {
  const std::vector<Rod> rods = read_rods(model);
  if (rods.empty()) return;
  Mesh& mesh = model.deck.mesh;
  const std::vector<Components> attached = attachments(mesh);
  const auto turns = [&](int node) { return (attached[node] & rotations_only) != 0; };
  std::map<int, int> without_torsion;
  for (const Rod& rod : rods) {
    BeamElement beam = rod.beam;
    const BeamProperty property = mesh.beam_properties[beam.property];
    if (property.data.section.torsion_constant > 0.0 && !(turns(beam.first) && turns(beam.second))) {
      const auto [row, fresh] = without_torsion.try_emplace(beam.property, count_of(mesh.beam_properties));
      if (fresh) {
        mesh.beam_properties.push_back(property);
        mesh.beam_properties.back().data.section.torsion_constant = 0.0;
      }
      beam.property = row->second;
      model.remarks.add("torsion of rods is ignored where no other element has rotations at an end",
                        fmt::format("{}", beam.id));
    }
    const int row = add_row(mesh.beams, beam);
    if (rod.pid > 0) model.of_property[rod.pid].beams.push_back(row);
  }
}

}  // namespace tisserand::reducer
