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

/// Bodies that were already built, by file and options.
struct BuiltSuperelements {
  struct Entry {
    SuperelementOptions options;
    int body = 0;
  };
  std::map<const formats::LoadedSuperelement*, std::vector<Entry>> of_file;
};

/// Whether second-order terms of a companion are used, or would be if there were one. False for a body that is rigid,
/// has second_order: off, or names an inertia other than F and no stiffening.
bool may_use_companion(const formats::SuperelementBodySpec& spec);

/// Inertia and stiffening of a body with a given companion, or null without one.
struct SecondOrderChoice {
  formats::InertiaOption inertia = formats::InertiaOption::B;
  formats::StiffeningOption stiffening = formats::StiffeningOption::off;
  bool double_curvature = false;  ///< use the companion's Λ
  bool any() const { return inertia == formats::InertiaOption::F || stiffening != formats::StiffeningOption::off; }
};

/// Combined choice from `inertia`, `stiffening` and `second_order`. Throws Error for combinations that measurements
/// showed to be wrong, and for terms of a missing companion.
SecondOrderChoice choose_second_order(const formats::SuperelementBodySpec& spec, const formats::Companion* companion);

/// Text "inertia F, stiffening full, double curvature".
std::string describe(const SecondOrderChoice& choice);

/// Companion data that a body uses.
struct CompanionUse {
  const formats::Companion* file = nullptr;   ///< null: none exists, or the body does not use it
  const formats::Companion* terms = nullptr;  ///< `file`, or null if the body does not use second-order terms
  std::vector<std::string> load_cases;        ///< load cases that loads name for any body of the file, ascending
};

/// Index in `bodies` of the body that `spec` makes from the file. A missing one is built and appended. units:
/// file -> scene. Throws Error.
int find_or_build(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                  const CompanionUse& companion, const UnitConversion& units, BuiltSuperelements& built,
                  std::vector<SuperelementBody>& bodies);

}  // namespace tisserand::mechanism
