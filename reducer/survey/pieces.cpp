// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that differ between neighbours in the list.
#include "reducer/survey/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "reducer/mesh/solid_faces.hpp"
#include "reducer/sources/selection.hpp"

namespace tisserand::reducer {
namespace {

/// Light colours, on which dark numbers are legible. Hues advance by the golden angle, so that a few successive ones
/// differ much.
std::array<double, 3> colour_of(std::size_t index) {
  constexpr double golden_ratio = 0.618033988749895;
  constexpr std::array<double, 3> weight{0.30, 0.59, 0.11};  // of red, green, blue in the brightness
  const double hue = std::fmod(0.58 + golden_ratio * static_cast<double>(index), 1.0);
  std::array<double, 3> colour{};
  double brightness = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double turn = std::fmod(hue + (k == 0 ? 0.0 : k == 1 ? 2.0 / 3.0 : 1.0 / 3.0), 1.0);
    colour[k] = 0.2 + 0.7 * std::clamp(std::abs(6.0 * turn - 3.0) - 1.0, 0.0, 1.0);
    brightness += weight[k] * colour[k];
  }
  const double wanted = index % 2 == 0 ? 0.80 : 0.70;
  const double white = std::max(0.25, (wanted - brightness) / (1.0 - brightness));
  for (double& part : colour) part += white * (1.0 - part);
  return colour;
}

/// Visible cells of a deck.
std::vector<Cell> deck_skin(const Mesh& deck) {
  std::vector<Cell> skin = outer_faces(deck, [](int) { return true; });
  for (const ShellElement& shell : deck.shells) skin.push_back(shell_cell(shell));
  return skin;
}

/// Piece of a face, without its cells.
FacePiece piece_of(const SurveyedFace& face, const Units& units, std::size_t index) {
  FacePiece piece;
  piece.name = face.name;
  piece.label = face.label;
  piece.form = form_text(face.facts, units);
  piece.is_flat = face.facts.form.kind == FormKind::plane;
  piece.colour = colour_of(index);
  return piece;
}

}  // namespace

std::vector<FacePiece> face_pieces(const Survey& survey) {
  std::vector<FacePiece> pieces;
  for (const SurveyedFace& face : survey.faces) {
    pieces.push_back(piece_of(face, survey.units, pieces.size()));
    pieces.back().cells = face.cells.cells;
  }
  const std::vector<Cell> skin = deck_skin(survey.deck);
  if (skin.empty()) return pieces;
  std::set<FaceKey> taken;
  const auto add = [&](FacePiece piece, const std::vector<Cell>& from) {
    for (const Cell& cell : from)
      if (taken.insert(face_key(corners_of(cell))).second) piece.cells.push_back(cell);
    if (!piece.cells.empty()) pieces.push_back(std::move(piece));
  };
  for (const SurveyedFace& set : survey.groups) add(piece_of(set, survey.units, pieces.size()), set.cells.cells);
  FacePiece rest;
  rest.name = "in no set";
  add(rest, skin);
  return pieces;
}

}  // namespace tisserand::reducer
