// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer groups -o`: coloured faces with their numbers, as a picture or as a page.
#pragma once

#include <string>

#include "reducer/survey/survey.hpp"

namespace tisserand::reducer {

/// Throws Error if the name of the output file ends in none of .html, .png and .svg.
void check_faces_output(const std::string& output);

/// Writes the picture of the faces of a survey. .png and .svg show the part from two opposite sides and name the faces
/// that neither shows. .html is a page that turns the part. A deck is shown by its sets, with the rest in grey.
/// `source`: surveyed file, for titles and messages. Throws Error if there are no faces, or no drawing program.
void draw_faces(const Survey& survey, const std::string& source, const std::string& output);

}  // namespace tisserand::reducer
