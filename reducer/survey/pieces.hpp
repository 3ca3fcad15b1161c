// SPDX-License-Identifier: GPL-3.0-or-later
// Faces as they are drawn, each in its own colour.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "reducer/survey/survey.hpp"

namespace tisserand::reducer {

/// Face or set of cells that a picture draws in one colour.
struct FacePiece {
  std::string name;
  std::string label;  ///< label of the face; empty: cells of a deck that are in no set
  std::string form;   ///< form of the face in words
  bool is_flat = false;
  std::array<double, 3> colour{0.82, 0.82, 0.82};
  std::vector<Cell> cells;
};

/// Faces of a survey as they are drawn, each in its own colour: faces with numbers, or the sets of a deck and then the
/// rest. A cell in several sets belongs to the first.
std::vector<FacePiece> face_pieces(const Survey& survey);

}  // namespace tisserand::reducer
