// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/program/version.hpp"

namespace tisserand {

std::string version() { return TISSERAND_VERSION; }

std::string producer(std::string_view program) { return "Tisserand " + std::string(program) + " " TISSERAND_VERSION; }

std::string generator_tag(std::string_view program) {
  return "<meta name=\"generator\" content=\"" + producer(program) + "\">\n";
}

}  // namespace tisserand
