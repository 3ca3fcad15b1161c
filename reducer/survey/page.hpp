// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of a part on an HTML page that turns the part.
#pragma once

#include <string>
#include <vector>

#include "reducer/survey/pieces.hpp"

namespace tisserand::reducer {

/// HTML page of `reducer view` on which each face is a body with its form, colour and name.
std::string faces_page(const Survey& survey, const std::vector<FacePiece>& pieces, const std::string& title,
                       const std::string& source);

}  // namespace tisserand::reducer
