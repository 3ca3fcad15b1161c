// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as scene.yaml give a Scene or an Error, nothing else. A first line "#path=value" is an
// override.
#include <string>

#include "common/error.hpp"
#include "formats/scene/scene.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const std::string path = text_file(data, size);
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    std::vector<formats::Override> overrides;
    if (!text.empty() && text[0] == '#')
      overrides.push_back(formats::parse_override(text.substr(1, text.find('\n') - 1)));
    formats::check(formats::read_scene(path, overrides));
  } catch (const Error&) {
  }
  return 0;
}
