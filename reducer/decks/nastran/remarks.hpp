// SPDX-License-Identifier: GPL-3.0-or-later
// Remarks on a Nastran deck, which become warnings of its mesh.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace tisserand::reducer {

/// Remarks on a deck by kind. Each kind keeps its number and its first few names, and is reported in one line.
class NastranRemarks {
 public:
  void add(const std::string& kind, const std::string& name);

  /// One text per kind of remark: "<kind>: <names> (<number>)".
  std::vector<std::string> texts() const;

 private:
  struct Remark {
    std::size_t number = 0;
    std::vector<std::string> names;
  };
  std::map<std::string, Remark> remarks_;
};

}  // namespace tisserand::reducer
