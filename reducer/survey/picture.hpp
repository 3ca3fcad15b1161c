// `reducer groups -o`: faces in colours with their numbers, as a picture or as a page.
#pragma once

#include <string>

#include "reducer/survey/survey.hpp"

namespace tisserand::reducer {

/// Throws Error if the name ends neither in .html nor in .png or .svg.
void check_faces_output(const std::string& output);

/// Writes the picture: .png and .svg show the part from two opposite sides and tell which faces are seen from neither;
/// .html is a page in which it turns. Of a deck the sets, the rest in grey. `source` is the file that was surveyed, for
/// titles and messages. Throws Error if there are no faces, or nothing draws.
void draw_faces(const Survey& survey, const std::string& source, const std::string& output);

}  // namespace tisserand::reducer
