// The faults of a Nastran deck on their way to one Error, and the remarks that become warnings of the mesh.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "common/error.hpp"

namespace tisserand::reducer {

/// Collects errors; beyond 50 they are only counted.
class NastranFaults {
 public:
  void add(std::string what, std::string where, std::string remedy);
  bool empty() const { return errors_.empty(); }

  /// Throws all of them as one Error, if there are any.
  void raise() const;

 private:
  std::vector<Error> errors_;
  std::size_t more_ = 0;
};

/// Remarks of one kind: the number of times and the first few names, told in one line ("3 GRID: 1, 2, 3").
class NastranRemarks {
 public:
  void add(const std::string& kind, const std::string& name);

  /// One text for each kind: "<kind>: <names> (<number>)".
  std::vector<std::string> texts() const;

 private:
  struct Remark {
    std::size_t number = 0;
    std::vector<std::string> names;
  };
  std::map<std::string, Remark> remarks_;
};

}  // namespace tisserand::reducer
