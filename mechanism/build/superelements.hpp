// From the uses of superelement files to bodies: one for all uses of a file with the same options.
#pragma once

#include <map>
#include <vector>

#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"
#include "mechanism/bodies/superelement/body.hpp"

namespace tisserand::mechanism {

/// Bodies that are there already, by file and options.
struct BuiltSuperelements {
  struct Entry {
    SuperelementOptions options;
    int body = 0;
  };
  std::map<const formats::LoadedSuperelement*, std::vector<Entry>> of_file;
};

/// Index among `bodies` of the body that `spec` makes from the file; built and appended if there is none. units: file
/// -> scene. Throws Error.
int find_or_build(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                  const UnitConversion& units, BuiltSuperelements& built, std::vector<SuperelementBody>& bodies);

}  // namespace tisserand::mechanism
