// SPDX-License-Identifier: GPL-3.0-or-later
// The truss that NASTRAN computed, written as a deck in each format: the matrices of its bars by hand.
#include <gtest/gtest.h>

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "reducer/elements/beam/beam.hpp"
#include "tests/reducer/decks/nastran_deck.hpp"
#include "tests/support/meshes/small_model.hpp"

namespace tisserand::testing::nastran_truss_test {
namespace {

using nlohmann::json;
using namespace reducer;

json component() {
  std::ifstream file(TISSERAND_REFERENCES "/truss/model.json");
  return json::parse(file).at("inboard");
}

enum class Format { small, large, free };

/// A card of fields, eight per line.
std::string card(Format format, const std::string& name, const std::vector<std::string>& fields) {
  std::string text;
  const std::size_t per_line = format == Format::large ? 4 : 8;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i % per_line == 0) {
      const std::string first =
          i > 0 ? (format == Format::large ? "*" : "") : name + (format == Format::large ? "*" : "");
      text += (i > 0 ? "\n" : "") + (format == Format::free ? first : fmt::format("{:8}", first));
    }
    text +=
        format == Format::free ? "," + fields[i] : fmt::format("{:>{}}", fields[i], format == Format::large ? 16 : 8);
  }
  return text + "\n";
}

std::string number(const json& value) {
  std::string text = fmt::format("{}", value.get<double>());
  if (text.size() > 7) text = fmt::format("{:.3e}", value.get<double>());
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text.find('.') == std::string::npos ? text + "." : text;
  return text.substr(0, e) + text.substr(e + 1);  // 2.740-06
}

std::string deck(Format format) {
  const json model = component();
  std::string text = card(format, "PARAM", {"COUPMASS", "1"});
  for (const auto& [id, m] : model.at("mat1").items())
    text += card(format, "MAT1", {id, number(m.at("E")), number(m.at("G")), "", number(m.at("rho"))});
  for (const auto& [id, s] : model.at("pbar").items())
    text += card(format, "PBAR",
                 {id, s.at("mat").get<std::string>(), number(s.at("A")), number(s.at("I1")), number(s.at("I2")),
                  number(s.at("J"))});
  for (const auto& [id, x] : model.at("grid").items())
    text += card(format, "GRID", {id, "", number(x[0]), number(x[1]), number(x[2])});
  for (const json& bar : model.at("cbar"))
    text += card(format, "CBAR",
                 {std::to_string(bar.at("id").get<int>()), bar.at("pid").get<std::string>(),
                  bar.at("ga").get<std::string>(), bar.at("gb").get<std::string>(), "1.", "2.", "3.5"});
  return text;
}

/// Bars of round sections without shear flexibility: any orientation, consistent mass without rotary inertia of
/// bending.
Mesh by_hand(const Deck& deck) {
  const json model = component();
  Mesh mesh;
  mesh.position = deck.mesh.position;
  for (const json& bar : model.at("cbar")) {
    const json& s = model.at("pbar").at(bar.at("pid").get<std::string>());
    const json& m = model.at("mat1").at(s.at("mat").get<std::string>());
    BeamProperty property;
    formats::Section& section = property.data.section;
    section.area = s.at("A");
    section.second_moment_y = s.at("I2");
    section.second_moment_z = s.at("I1");
    section.torsion_constant = s.at("J");
    section.polar_moment = section.second_moment_y + section.second_moment_z;
    property.data.material = {"", m.at("E"), m.at("E").get<double>() / (2.0 * m.at("G").get<double>()) - 1.0,
                              m.at("rho"), ""};
    property.data.rotary_inertia = RotaryInertia::without;
    property.data.theory = formats::BeamTheory::euler_bernoulli;
    BeamElement beam;
    beam.first = deck.node_of_id.at(std::stol(bar.at("ga").get<std::string>()));
    beam.second = deck.node_of_id.at(std::stol(bar.at("gb").get<std::string>()));
    beam.property = static_cast<int>(mesh.beam_properties.size());
    beam.R_PE = *beam_axes(mesh.position.col(beam.second) - mesh.position.col(beam.first), {-3.0, 1.0, 0.5});
    mesh.beam_properties.push_back(property);
    mesh.beams.push_back(beam);
  }
  return mesh;
}

TEST(NastranTruss, EveryFormatGivesTheMatricesByHand) {
  for (const Format format : {Format::small, Format::large, Format::free}) {
    const Deck read = read_deck(deck(format));
    ASSERT_EQ(read.mesh.beams.size(), component().at("cbar").size());
    const SmallMatrices ours = assemble_small(read.mesh), expected = assemble_small(by_hand(read));
    // Round-off of E I/L³ times the number of bars at a node; numbers of the reference have at most eight characters.
    EXPECT_LT((ours.S - expected.S).norm(), 1e-12 * expected.S.norm());
    EXPECT_LT((ours.M - expected.M).norm(), 1e-12 * expected.M.norm());
  }
}

}  // namespace
}  // namespace tisserand::testing::nastran_truss_test
