// Faces as they are drawn: each in a colour of its own.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "reducer/survey/survey.hpp"

namespace tisserand::reducer {

struct FacePiece {
  std::string name;
  std::string label;  ///< empty: the rest of a deck, which is no set
  std::string form;   ///< in words
  bool is_flat = false;
  std::array<double, 3> colour{0.82, 0.82, 0.82};
  std::vector<Cell> cells;
};

/// The faces with numbers, or of a deck its sets and then the rest. A cell of several sets is of the first.
std::vector<FacePiece> face_pieces(const Survey& survey);

}  // namespace tisserand::reducer
