// The faces of a part as a page that any browser opens, in which it turns.
#pragma once

#include <string>
#include <vector>

#include "reducer/survey/pieces.hpp"

namespace tisserand::reducer {

/// The page of `reducer view`, where each face is a body with its form and colour, named where it is seen.
std::string faces_page(const Survey& survey, const std::vector<FacePiece>& pieces, const std::string& title,
                       const std::string& source);

}  // namespace tisserand::reducer
