// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies from the uses of superelement files: one for all uses of a file with the same options.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/companion/companion.hpp"
#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// Table of the superelement bodies that were already built, by file and options.
struct BuiltSuperelements {
  /// Options of a body and its index in the list of bodies.
  struct Entry {
    SuperelementOptions options;
    int body = 0;
  };
  std::map<const formats::LoadedSuperelement*, std::vector<Entry>> of_file;
};

/// Whether a body uses second-order terms of a companion file, or would use them if the file existed. False for a body
/// that is rigid or has `second_order: off`. Also false if it names `inertia` or `stiffening`, but neither inertia F
/// nor a stiffening other than `off`.
bool may_use_companion(const formats::SuperelementBodySpec& spec);

/// Inertia option and stiffening option of a body.
struct SecondOrderChoice {
  formats::InertiaOption inertia = formats::InertiaOption::B;
  formats::StiffeningOption stiffening = formats::StiffeningOption::off;
  bool double_curvature = false;  ///< whether the double-curvature matrices Λ of the companion file are used
  bool any() const { return inertia == formats::InertiaOption::F || stiffening != formats::StiffeningOption::off; }
};

/// Options that follow from the keys `inertia`, `stiffening` and `second_order` of the body. `companion`: its companion
/// file, or null. Throws Error for combinations that measurements showed to be wrong, and for terms of a missing
/// companion.
SecondOrderChoice choose_second_order(const formats::SuperelementBodySpec& spec, const formats::Companion* companion);

/// Text of the options: "inertia F, stiffening full, double curvature".
std::string describe(const SecondOrderChoice& choice);

/// Companion file of a superelement, as far as a body uses it.
struct CompanionUse {
  const formats::Companion* file = nullptr;   ///< companion file; null: none exists, or the body does not use it
  const formats::Companion* terms = nullptr;  ///< `file`, or null if the body uses no second-order terms of it
  /// Load cases that loads of the scene apply to any body of the file, in ascending order.
  std::vector<std::string> load_cases;
};

/// Index in `bodies` of the body that `spec` makes from the file. If there is none with the same options, it is built
/// and appended. `units`: from the units of the file to those of the scene. Throws Error.
int find_or_build(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                  const CompanionUse& companion, const UnitConversion& units, BuiltSuperelements& built,
                  std::vector<SuperelementBody>& bodies);

}  // namespace tisserand::mechanism
