// SPDX-License-Identifier: GPL-3.0-or-later
// Findings of checks of a part or scene, independent of whether it was read from a file.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"

namespace tisserand::formats {

/// One finding of a check: the entry by its `where`, the key inside the entry ("" or "damping.ratio"), what is wrong,
/// and the remedy.
struct Fault {
  std::string entry;
  std::string key;
  std::string what;
  std::string remedy;
};

/// List of the findings of one check, in the order in which they were made.
struct Faults {
  std::vector<Fault> list;

  void add(const std::string& entry, std::string key, std::string what, std::string remedy) {
    list.push_back({entry, std::move(key), std::move(what), std::move(remedy)});
  }

  /// Throws one Error with all findings if there are any.
  void raise() const {
    std::vector<Error> errors;
    for (const Fault& fault : list) errors.emplace_back(fault.what, fault.entry, fault.remedy);
    if (!errors.empty()) throw merge_errors(errors);
  }
};

/// Subject of a check: the entry that findings are about. Messages call it `name`. `where` is the place of the entry in
/// the file. `prefix` precedes the keys of findings.
struct Subject {
  std::string name;  ///< "spring 'k1'"; empty: the file
  std::string where;
  Faults& faults;
  std::string prefix = {};

  /// Adds a finding about the key of this entry.
  void add(const std::string& key, const std::string& what, const std::string& remedy = "") const;
  /// Adds a finding, for example "mass -1 must be positive", unless the number is finite and in the required range. An
  /// absent value is accepted.
  void positive(const std::string& key, std::optional<double> value) const;
  void not_negative(const std::string& key, std::optional<double> value) const;
  void between(const std::string& key, double value, double low, double high) const;
  void at_least(const std::string& key, std::optional<int> value, int low) const;
  /// Whether the number, vector or matrix is finite. If not, adds a finding.
  template <class Value>
  bool finite(const std::string& key, const Value& value) const {
    bool is_finite = false;
    if constexpr (requires { value.allFinite(); })
      is_finite = value.allFinite();
    else
      is_finite = std::isfinite(value);
    if (!is_finite) add(key, key + " must be finite");
    return is_finite;
  }
  /// Subject of a map inside this entry. Its name is, for example, "body 'arm': damping", and its keys are
  /// "damping.ratio".
  Subject inside(const std::string& group) const { return {name + ": " + group, where, faults, prefix + group + "."}; }
};

}  // namespace tisserand::formats
