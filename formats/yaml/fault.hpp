// What a check finds wrong in a part or scene, before it is known whether there is a file to point into.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"

namespace tisserand::formats {

/// One finding: the entry by its `where`, the key inside it ("" or "damping.ratio"), what is wrong, what to do.
struct Fault {
  std::string entry;
  std::string key;
  std::string what;
  std::string remedy;
};

/// The findings of one check, in the order in which they were made.
struct Faults {
  std::vector<Fault> list;

  void add(const std::string& entry, std::string key, std::string what, std::string remedy) {
    list.push_back({entry, std::move(key), std::move(what), std::move(remedy)});
  }

  /// Throws all of them together if there are any.
  void raise() const {
    std::vector<Error> errors;
    for (const Fault& fault : list) errors.emplace_back(fault.what, fault.entry, fault.remedy);
    if (!errors.empty()) throw merge_errors(errors);
  }
};

}  // namespace tisserand::formats
